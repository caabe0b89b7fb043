//! Where something acts, whatever it is: an arbitrary input, another number in every window of 0.1 s, at each of the places.

use std::sync::Arc;

use law::{Input, Place};
use statrs::function::factorial::ln_binomial;

use super::acting::{Acting, Inputs};
use super::gate;
use super::operator::usual;
use super::series::{Ground, Kept, Series, Solved};
use crate::decide::fault_free_cost;
use crate::fit::{Fitted, Hypothesis, Point, Problem};
use crate::judged::Judged;
use crate::settings::law::{Events, SETTINGS};
use crate::simulate::Response;
use crate::windows::Cut;

const EVENTS: Events = SETTINGS.events;

/// Where something may act; what acts on both sides or along both axes has a series for each.
const PLACES: [Place; 10] = [
    Place::TorqueLeft,
    Place::TorqueRight,
    Place::TorqueBoth,
    Place::ForceForward,
    Place::ForceBoth,
    Place::YawMoment,
    Place::GripLeft,
    Place::GripRight,
    Place::GripAll,
    Place::LateralGrip,
];

/// A place with the evidence that something acts there.
pub(super) struct Acts {
    pub(super) place: Place,
    pub(super) inputs: Vec<Input>,
    /// Usual size of what acts, in what is usual at the place.
    pub(super) size: f64,
    /// Log Bayes factor over none of an input in every window; or, where that is below zero at every place, of an input in few
    /// windows, less what choosing them costs, nats.
    pub(super) evidence: f64,
    /// The second of these.
    of_few: f64,
    pub(super) series: Series,
    pub(super) solved: Solved,
}

impl Acts {
    /// With the usual size that has most evidence.
    pub(super) fn new(ground: &Ground<'_>, place: Place, sizes: &[f64]) -> Option<Self> {
        let inputs = inputs_of(place);
        let series = Series::new(ground, &inputs, None)?;
        let everywhere = series.everywhere();
        let with = |size: &f64| {
            let solved = series.solve(&everywhere, *size)?;
            let (kept, few) = few(&series, &solved, *size, 1.0)?;
            let windows = |kept: &Kept| kept.iter().flatten().map(|s| s.len() as u64).sum::<u64>();
            let of_few = few.evidence - ln_binomial(windows(&everywhere), windows(&kept));
            Some((solved.evidence.max(of_few), *size, of_few, solved))
        };
        let (_, size, of_few, solved) = sizes.iter().filter_map(with).max_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(Self { place, inputs, size, evidence: solved.evidence, of_few, series, solved })
    }

    /// All places, the likeliest first.
    pub(super) fn everywhere(ground: &Ground<'_>) -> Vec<Self> {
        let mut all: Vec<Self> = PLACES.into_iter().filter_map(|p| Self::new(ground, p, &EVENTS.sizes)).collect();
        if all.iter().all(|a| a.evidence < 0.0) {
            for place in &mut all {
                place.evidence = place.of_few;
            }
        }
        all.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
        all
    }
}

/// A window with an input.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Instant {
    /// Index among the inputs of its place.
    pub(super) input: usize,
    pub(super) run: usize,
    /// Window in its recording.
    pub(super) window: usize,
    /// Mean and sigma, in the unit of the input.
    pub(super) size: f64,
    pub(super) sigma: f64,
}

impl Acts {
    /// What a solution has in each window, sigmas `dispersion` times as large.
    pub(super) fn instants(&self, ground: &Ground<'_>, kept: &Kept, solved: &Solved, dispersion: f64) -> Vec<Instant> {
        let mut out = Vec::new();
        for (run, segments) in kept.iter().enumerate() {
            for (s, indices) in segments.iter().enumerate() {
                for (index, value) in indices.iter().zip(&solved.values[run][s]) {
                    let (input, window) = self.series.place(run, s, *index);
                    let window = ground.operator.first(run, s) + window;
                    let [size, sigma] = value.map(|v| v * usual(ground.problem, self.inputs[input]));
                    out.push(Instant { input, run, window, size, sigma: dispersion * sigma });
                }
            }
        }
        out.sort_by_key(|i| (i.run, i.input, i.window));
        out
    }

    /// The inputs of every window, zero but at the instants.
    pub(super) fn inputs_at(&self, p: &Problem<'_>, instants: &[Instant]) -> Inputs {
        let of = |(k, input): (usize, &Input)| {
            let windows = |cut: &Cut| cut.torque.len() / cut.rows_per_window.max(1) + 1;
            let mut out: Vec<Vec<f64>> = p.cuts.iter().map(|cut| vec![0.0; windows(cut)]).collect();
            for i in instants.iter().filter(|i| i.input == k) {
                if let Some(u) = out[i.run].get_mut(i.window) {
                    *u = i.size;
                }
            }
            (*input, out)
        };
        self.inputs.iter().enumerate().map(of).collect()
    }
}

/// The problem in which something is looked for: what is far off must not count less.
pub(super) fn wide<'a>(problem: &Problem<'a>) -> Problem<'a> {
    Problem { outlier_scale: SETTINGS.refit.outlier_scale, ..problem.clone() }
}

/// How free runs with inputs stand.
pub(super) struct Standing {
    /// Share of the excess cost that is left.
    pub(super) left: f64,
    /// How many times what a fault-free drive costs.
    pub(super) misfit: f64,
    /// Fall of the cost below "re-tune only", nats.
    pub(super) gain: f64,
}

impl Standing {
    pub(super) fn new(judged: &Judged<'_>, retuned: &Fitted, inputs: &Inputs) -> Self {
        let p = judged.problem;
        let h = hypothesis(inputs);
        let start = p.begin(&h, Point { effects: vec![1.0], ..p.origin() }, None);
        let fitted = p.refine(&h, start, SETTINGS.refit.steps, None);
        let fault_free = fault_free_cost(p, &judged.calibration.regimes.scatter);
        Self {
            left: gate::left(fitted.cost, retuned.cost, fault_free),
            misfit: (fitted.cost / fault_free.max(1.0)).max(1.0),
            gain: retuned.cost - fitted.cost,
        }
    }

    /// Places with these that are told together with the likeliest.
    pub(super) fn alike(&self, best: &Acts, others: &[Acts]) -> Vec<String> {
        let class = SETTINGS.gates.class * self.misfit;
        others.iter().filter(|o| best.evidence - o.evidence < class).map(|o| o.place.name().to_owned()).collect()
    }
}

/// Given inputs as a hypothesis.
pub(super) fn hypothesis(inputs: &Inputs) -> Hypothesis {
    let acting = Some(Acting::Given { inputs: Arc::new(inputs.clone()), times: 1.0, unit: 1.0 });
    Hypothesis { acting, ..Hypothesis::default() }
}

/// The free run with given inputs.
pub(super) fn given(p: &Problem<'_>, base: &Fitted, inputs: &Inputs) -> Response {
    p.response(&Point { effects: vec![1.0], ..base.point.clone() }, &hypothesis(inputs))
}

fn inputs_of(place: Place) -> Vec<Input> {
    Input::ALL.into_iter().filter(|input| place.acts_on(*input)).collect()
}

/// Windows that earn an input of this usual size, each standing out of its interval, with the solution that holds these alone.
pub(super) fn few(series: &Series, solved: &Solved, size: f64, dispersion: f64) -> Option<(Kept, Solved)> {
    let windows: usize = series.everywhere().iter().flatten().map(Vec::len).sum();
    let kept = series.greedy(solved, size, (windows.max(1) as f64).ln())?;
    let kept = standing_out(&kept, &series.solve(&kept, size)?, dispersion);
    let solved = series.solve(&kept, size)?;
    Some((kept, solved))
}

/// The windows whose input stands out of its interval.
fn standing_out(kept: &Kept, solved: &Solved, dispersion: f64) -> Kept {
    let stands = |[mean, sigma]: &[f64; 2]| mean.abs() > EVENTS.sigmas * dispersion * sigma;
    let of_segment = |(indices, values): (&Vec<usize>, &Vec<[f64; 2]>)| {
        indices.iter().zip(values).filter(|(_, value)| stands(value)).map(|(index, _)| *index).collect()
    };
    let of_run =
        |(run, values): (&Vec<Vec<usize>>, &Vec<Vec<[f64; 2]>>)| run.iter().zip(values).map(of_segment).collect();
    kept.iter().zip(&solved.values).map(of_run).collect()
}
