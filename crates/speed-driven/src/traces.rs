//! Torques of each recording beside those that its speeds predict, with everything fitted on the other recordings.

use inference::experiment::{self, Comparison, Experiment, Forecast, Standing};
use inference::hypothesis::Dose;
use robot_model::Robot;
use robot_model::tunable::{tunables, tuned};
use verdict::{Compared, Correction, FreeRun, Trace, instant, rounded};

use crate::SteadyCase;
use crate::comparison;
use crate::model::{Measured, Rows, Tuned, predicted_rows, tune};
use crate::name::{Difference, Named, Naming};
use crate::run::SpeedRun;

/// All that a recording's forecast is fitted with.
pub(crate) struct Fits<'a> {
    pub(crate) case: &'a SteadyCase,
    pub(crate) robot: &'a Robot<f64>,
    /// Loads of the references.
    pub(crate) known: &'a [Measured],
    pub(crate) differences: &'a [Difference],
    pub(crate) calibrated: &'a Tuned,
    pub(crate) naming: Option<&'a Naming>,
}

/// A robot with effects.
pub(crate) struct Model {
    robot: Robot<f64>,
    doses: Vec<Dose>,
}

/// A recording's torques by four simulations.
type Simulated = Forecast<Model, Rows>;

/// What the forecasts of recordings left out of the fit say.
pub(crate) struct Forecasts<'a> {
    pub(crate) free_runs: Vec<FreeRun>,
    pub(crate) traces: Vec<Trace>,
    /// How the correction stands on them; `None` without one, or with a lone recording.
    pub(crate) standing: Option<Standing>,
    /// The best wrong cause.
    pub(crate) placebo: Option<&'a Named>,
}

impl Experiment for Fits<'_> {
    type Model = Model;
    type Response = Rows;

    fn blocks(&self) -> usize {
        self.case.recordings.len()
    }

    fn fitted_without(&self, block: usize) -> Option<Comparison<Model>> {
        let Some(best) = self.best() else { return Some(self.fitted()) };
        let left_out = &self.case.recordings[block].name;
        let others: Vec<Difference> = self.differences.iter().filter(|d| d.recording != *left_out).cloned().collect();
        if others.is_empty() {
            return None;
        }

        let data: Vec<Measured> =
            self.known.iter().copied().chain(others.iter().filter(|d| !d.is_track()).map(|d| d.here)).collect();
        let retuned = tune(self.robot, &self.case.sigma, &data)?;
        let comparison = comparison::Comparison::new(&others, self.robot, &self.case.sigma, self.calibrated);
        let refitted = |named: &Named| {
            let fitted = comparison.as_ref().and_then(|c| c.refit(named));
            self.calibrated_with(fitted.map_or_else(Vec::new, |fitted| fitted.doses()))
        };
        Some(Comparison {
            nominal: Model { robot: *self.robot, doses: Vec::new() },
            retuned: Model { robot: tuned(self.robot, &self.case.sigma, &retuned.theta), doses: Vec::new() },
            corrected: Some(refitted(best)),
            placebo: self.placebo().map(refitted),
        })
    }

    fn fitted(&self) -> Comparison<Model> {
        let with = |named: &Named| self.calibrated_with(named.doses());
        Comparison {
            nominal: Model { robot: *self.robot, doses: Vec::new() },
            retuned: self.calibrated_with(Vec::new()),
            corrected: self.best().map(with),
            placebo: self.placebo().map(with),
        }
    }

    fn response(&self, model: &Model, block: usize) -> Rows {
        predicted_rows(&self.case.recordings[block], &model.robot, &model.doses)
    }

    fn quantities(&self) -> Vec<String> {
        vec!["torque of a side, N m".to_owned()]
    }

    fn errors(&self, response: &Rows, block: usize) -> Vec<Vec<f64>> {
        vec![response.residuals(&self.case.recordings[block])]
    }
}

impl<'a> Fits<'a> {
    /// The likeliest effects, if they earned their keep.
    fn best(&self) -> Option<&'a Named> {
        self.naming.and_then(|n| n.effects.first()).filter(|e| e.score > 0.0)
    }

    /// The best hypothesis that shares no effect with these and is no larger.
    fn placebo(&self) -> Option<&'a Named> {
        let best = self.best()?;
        let shared = |e: &Named| e.effects().any(|id| best.effects().any(|own| own == id));
        let wrong = |e: &&Named| e.causes() <= best.causes() && !shared(e);
        self.naming?.effects.iter().find(wrong)
    }

    fn calibrated_with(&self, doses: Vec<Dose>) -> Model {
        Model { robot: tuned(self.robot, &self.case.sigma, &self.calibrated.theta), doses }
    }

    /// Errors of the forecasts, and recordings beside them.
    pub(crate) fn forecasts(&self) -> Forecasts<'a> {
        let usual = self.usual();
        let simulated = experiment::leave_out(self);
        let of_recording = |(run, s): (&SpeedRun, &Simulated)| trace(run, s, usual);
        let traces = self.case.recordings.iter().zip(&simulated).map(of_recording).collect();
        let free_runs = if self.best().is_some() {
            experiment::free_runs(self, &simulated, |block| self.case.recordings[block].name.clone())
        } else {
            Vec::new()
        };
        Forecasts { standing: Standing::new(&free_runs), free_runs, traces, placebo: self.placebo() }
    }

    /// The robot calibrated and, with the likeliest effects that earned their keep, corrected.
    pub(crate) fn correction(&self) -> Correction {
        let tunings = tunables::<f64>().into_iter().zip(self.case.sigma).zip(self.calibrated.theta);
        let effects = self
            .best()
            .into_iter()
            .flat_map(|e| (0..e.parts.len()).map(|k| e.parts[k].at(e.of(k).0, &Vec::new(), &[])));
        let drift = self.naming.and_then(|naming| naming.drift);
        let effects = effects.chain(drift.map(|(variant, share)| variant.at(&[share], &Vec::new(), &[])));
        Correction {
            tuning: tunings.map(|((t, sigma), x)| (t.id.to_owned(), sigma * x)).collect(),
            effects: effects.collect(),
            ..Correction::default()
        }
    }

    /// Root mean squared error of the calibrated robot on its references, N m.
    fn usual(&self) -> Option<f64> {
        let model = tuned(self.robot, &self.case.sigma, &self.calibrated.theta);
        let squares: Vec<f64> =
            self.case.references.iter().map(|r| predicted_rows(r, &model, &[]).rms(r).powi(2)).collect();
        (!squares.is_empty()).then(|| (squares.iter().sum::<f64>() / squares.len() as f64).sqrt())
    }
}

fn trace(run: &SpeedRun, simulated: &Simulated, usual: Option<f64>) -> Trace {
    let simulations = &simulated.responses;
    let short = |values: &[Option<f64>]| values.iter().map(|v| v.map(rounded)).collect::<Vec<_>>();
    let corrected = |of: &dyn Fn(&Rows) -> Vec<Option<f64>>| simulations.corrected.as_ref().map_or_else(Vec::new, of);
    let mut channels: Vec<Compared> = (0..2)
        .map(|j| {
            let of = |rows: &Rows| short(&rows.torque[j]);
            Compared {
                signal: format!("{} torque", inference::words::side(j)).into(),
                unit: "N m".into(),
                side: Some(inference::words::side(j).into()),
                recorded: run.torque[j].iter().map(|t| Some(rounded(*t)).filter(|t| t.is_finite())).collect(),
                nominal: of(&simulations.nominal),
                retuned: of(&simulations.retuned),
                corrected: corrected(&of),
                usual: usual.map(rounded),
            }
        })
        .collect();
    if let Some(yaw) = &run.yaw_rate {
        let of = |rows: &Rows| short(&rows.yaw_rate);
        channels.push(Compared {
            signal: "yaw rate".into(),
            unit: "rad/s".into(),
            recorded: yaw.iter().map(|w| Some(rounded(*w)).filter(|w| w.is_finite())).collect(),
            nominal: of(&simulations.nominal),
            retuned: of(&simulations.retuned),
            corrected: corrected(&of),
            ..Compared::default()
        });
    }
    let over_usual = |rows: &Rows| {
        let mismatch = |i| Some(rounded(rows.square(run, i)? / usual?.powi(2).max(1e-12)));
        (0..run.time.len()).map(mismatch).collect()
    };
    Trace {
        recording: run.name.clone(),
        left_out: simulated.left_out,
        time: run.time.iter().copied().map(instant).collect(),
        restarts: Vec::new(),
        channels,
        path: Vec::new(),
        before: over_usual(&simulations.nominal),
        after: over_usual(simulations.best()),
    }
}
