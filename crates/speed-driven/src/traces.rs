//! Torques of each recording beside those that its speeds predict, with everything fitted on the other recordings.

use robot_model::Robot;
use robot_model::tunable::tunables;
use verdict::{Compared, Correction, FreeRun, Trace, instant, rounded};

use crate::SteadyCase;
use crate::model::{Measured, Rows, Tuned, predicted_rows, tune};
use crate::name::{Comparison, Difference, Naming};
use crate::run::SpeedRun;
use inference::hypothesis::Dose;
use robot_model::tunable::tuned;

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

/// A recording's torques by three models.
struct Simulations {
    nominal: Rows,
    retuned: Rows,
    corrected: Option<Rows>,
    left_out: bool,
}

impl Fits<'_> {
    /// Errors of the forecasts, and recordings beside them.
    pub(crate) fn forecasts(&self) -> (Vec<FreeRun>, Vec<Trace>) {
        let usual = self.usual();
        let mut free_runs = Vec::new();
        let mut traces = Vec::new();
        for run in &self.case.recordings {
            let simulations = self.simulate(run);
            if let Some(corrected) = simulations.corrected.as_ref().filter(|_| simulations.left_out) {
                free_runs.push(FreeRun {
                    recording: run.name.clone(),
                    quantity: "torque of a side, N m".to_owned(),
                    nominal: simulations.nominal.rms(run),
                    retuned: simulations.retuned.rms(run),
                    corrected: corrected.rms(run),
                    placebo: None,
                });
            }
            traces.push(trace(run, &simulations, usual));
        }
        (free_runs, traces)
    }

    /// The robot calibrated and, with the likeliest effects that earned their keep, corrected.
    pub(crate) fn correction(&self) -> Correction {
        let tunings = tunables::<f64>().into_iter().zip(self.case.sigma).zip(self.calibrated.theta);
        let best = self.naming.and_then(|n| n.effects.first()).filter(|e| e.score > 0.0);
        let effects =
            best.into_iter().flat_map(|e| (0..e.parts.len()).map(|k| e.parts[k].at(e.of(k).0, &Vec::new(), &[])));
        Correction {
            tuning: tunings.map(|((t, sigma), x)| (t.id.to_owned(), sigma * x)).collect(),
            effects: effects.collect(),
            response: None,
        }
    }

    fn simulate(&self, run: &SpeedRun) -> Simulations {
        let rows = |robot: &Robot<f64>, doses: &[Dose]| predicted_rows(run, robot, doses);
        let model = tuned(self.robot, &self.case.sigma, &self.calibrated.theta);
        let nominal = rows(self.robot, &[]);
        let best = self.naming.and_then(|n| n.effects.first()).filter(|e| e.score > 0.0);
        let others: Vec<Difference> = self.differences.iter().filter(|d| d.recording != run.name).cloned().collect();
        let Some(best) = best else {
            return Simulations { nominal, retuned: rows(&model, &[]), corrected: None, left_out: true };
        };
        let data: Vec<Measured> = self.known.iter().copied().chain(others.iter().map(|d| d.here)).collect();
        let retuned = tune(self.robot, &self.case.sigma, &data).filter(|_| !others.is_empty());
        let Some(retuned) = retuned else {
            let corrected = Some(rows(&model, &best.doses()));
            return Simulations { nominal, retuned: rows(&model, &[]), corrected, left_out: false };
        };
        let refitted = Comparison::new(&others, self.robot, &self.case.sigma, self.calibrated)
            .and_then(|c| c.fit(&best.parts, None));
        let corrected = refitted.map_or_else(|| rows(&model, &[]), |e| rows(&model, &e.doses()));
        let retuned = rows(&tuned(self.robot, &self.case.sigma, &retuned.theta), &[]);
        Simulations { nominal, retuned, corrected: Some(corrected), left_out: true }
    }

    /// Root mean squared error of the calibrated robot on its references, N m.
    fn usual(&self) -> Option<f64> {
        let model = tuned(self.robot, &self.case.sigma, &self.calibrated.theta);
        let squares: Vec<f64> =
            self.case.references.iter().map(|r| predicted_rows(r, &model, &[]).rms(r).powi(2)).collect();
        (!squares.is_empty()).then(|| (squares.iter().sum::<f64>() / squares.len() as f64).sqrt())
    }
}

fn trace(run: &SpeedRun, simulations: &Simulations, usual: Option<f64>) -> Trace {
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
        left_out: simulations.left_out,
        time: run.time.iter().copied().map(instant).collect(),
        restarts: Vec::new(),
        channels,
        path: Vec::new(),
        before: over_usual(&simulations.nominal),
        after: over_usual(simulations.corrected.as_ref().unwrap_or(&simulations.retuned)),
    }
}
