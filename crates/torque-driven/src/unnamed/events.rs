//! When no law fits: at which instants something acts, where, and how strongly.
//!
//! Places are told apart by the evidence of an arbitrary input there. At the best one, windows whose input stands out of its
//! interval are kept and solved once more, all others zero; what is left of them, joined where windows follow one another, are
//! events. What counts in the end is the free run with these inputs.

use std::sync::Arc;

use law::{Input, Place};
use statrs::function::factorial::ln_binomial;
use verdict::{Event, FoundEvents};

use super::acting::{Acting, Inputs};
use super::gate::{References, Standing};
use super::operator::{Operator, usual};
use super::rank::Ranking;
use super::series::{Kept, Series, Solved};
use super::shared::shared;
use crate::decide::fault_free_cost;
use crate::fit::{Fitted, Hypothesis, Point, Problem};
use crate::judged::Judged;
use crate::settings::law::{Events, SETTINGS};

const EVENTS: Events = SETTINGS.events;

/// Where events may act; on both sides, each has a series of its own.
const PLACES: [Place; 8] = [
    Place::TorqueLeft,
    Place::TorqueRight,
    Place::TorqueBoth,
    Place::ForceForward,
    Place::YawMoment,
    Place::GripLeft,
    Place::GripRight,
    Place::GripAll,
];

/// A window with an input that stands out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Instant {
    /// Index among the inputs of its place.
    pub(super) input: usize,
    pub(super) run: usize,
    /// Window in its recording.
    pub(super) window: usize,
    /// Mean and sigma, in usual sizes.
    pub(super) value: [f64; 2],
}

/// Windows with events at a place, after the second solution.
struct Found {
    place: Place,
    inputs: Vec<Input>,
    size: f64,
    /// Evidence of an arbitrary input at this place, nats.
    evidence: f64,
    /// Log Bayes factor of the events alone less what choosing their windows costs, nats.
    score: f64,
    instants: Vec<Instant>,
    /// Share of the windows with an event.
    filled: f64,
}

/// The events of the recordings; `None` where there are none, or too many to be events.
pub(super) fn find(
    judged: &Judged<'_>,
    ranking: &Ranking<'_>,
    retuned: &Fitted,
    references: Option<&References<'_>>,
) -> Option<FoundEvents> {
    // What is far off must not count less: events are outliers.
    let wide = Problem { outlier_scale: SETTINGS.refit.outlier_scale, ..judged.problem.clone() };
    let at = |place| found(&wide, ranking.base, &ranking.operator, place, &EVENTS.sizes);
    let mut all: Vec<Found> = PLACES.into_iter().filter_map(at).collect();
    all.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
    let best = all.first()?;
    let name = judged.decision.scored.first().map_or(0.0, |s| s.score);
    let recordings = (0..wide.cuts.len()).filter(|run| best.instants.iter().any(|i| i.run == *run)).count();
    let events = events(&wide, best);
    let is_list = events.len() >= EVENTS.least
        && recordings >= SETTINGS.gates.recordings.min(wide.cuts.len())
        && best.filled < EVENTS.filled
        && best.score > SETTINGS.gates.score
        && best.score > name + SETTINGS.gates.above_name;
    let references = references.filter(|_| is_list)?;
    let (left, misfit) = left(judged, retuned, best);
    let share = references.share(best)?;
    if left > EVENTS.left || share > SETTINGS.gates.in_references * best.filled {
        return None;
    }

    let class = SETTINGS.gates.class * misfit;
    let alike = all[1..].iter().filter(|f| best.evidence - f.evidence < class).map(|f| f.place.name().to_owned()).collect();
    Some(FoundEvents {
        place: best.place.name().to_owned(),
        places_alike: alike,
        shared: shared(&ranking.signals, &best.inputs, &best.instants),
        events,
        filled: best.filled,
        in_references: share / best.filled,
        left,
        score: best.score,
    })
}

/// Events at a place.
fn found(
    problem: &Problem<'_>,
    base: &Fitted,
    operator: &Operator,
    place: Place,
    sizes: &[f64],
) -> Option<Found> {
    let inputs = inputs_of(place);
    let series = Series::new(problem, base, operator, &inputs)?;
    let everywhere = series.everywhere();
    let with = |size: &f64| Some((*size, series.solve(&everywhere, *size)?));
    let (size, all) = sizes.iter().filter_map(with).max_by(|a, b| a.1.evidence.total_cmp(&b.1.evidence))?;

    let mut kept = standing_out(&everywhere, &all);
    let mut solved = series.solve(&kept, size)?;
    for _ in 1..EVENTS.rounds {
        kept = standing_out(&kept, &solved);
        solved = series.solve(&kept, size)?;
    }
    let mut instants = Vec::new();
    for (run, segments) in kept.iter().enumerate() {
        for (s, indices) in segments.iter().enumerate() {
            for (index, value) in indices.iter().zip(&solved.values[run][s]) {
                let (input, window) = series.place(run, s, *index);
                instants.push(Instant { input, run, window: operator.first(run, s) + window, value: *value });
            }
        }
    }
    instants.sort_by_key(|i| (i.run, i.input, i.window));
    let windows: usize = everywhere.iter().flatten().map(Vec::len).sum();
    let filled = instants.len() as f64 / windows.max(1) as f64;
    let score = solved.evidence - ln_binomial(windows as u64, instants.len() as u64);
    Some(Found { place, inputs, size, evidence: all.evidence, score, instants, filled })
}

fn inputs_of(place: Place) -> Vec<Input> {
    Input::ALL.into_iter().filter(|input| place.acts_on(*input)).collect()
}

/// The windows whose input stands out of its interval.
fn standing_out(kept: &Kept, solved: &Solved) -> Kept {
    let stands = |[mean, sigma]: &[f64; 2]| mean.abs() > EVENTS.sigmas * sigma;
    let of_segment = |(indices, values): (&Vec<usize>, &Vec<[f64; 2]>)| {
        indices.iter().zip(values).filter(|(_, value)| stands(value)).map(|(index, _)| *index).collect()
    };
    let of_run = |(run, values): (&Vec<Vec<usize>>, &Vec<Vec<[f64; 2]>>)| run.iter().zip(values).map(of_segment).collect();
    kept.iter().zip(&solved.values).map(of_run).collect()
}

/// Windows that follow one another with one sign, as events, in the order of recordings and times.
fn events(problem: &Problem<'_>, found: &Found) -> Vec<Event> {
    let follows = |a: &Instant, b: &Instant| {
        a.run == b.run && a.input == b.input && b.window == a.window + 1 && (a.value[0] > 0.0) == (b.value[0] > 0.0)
    };
    let mut out: Vec<Event> = found
        .instants
        .chunk_by(follows)
        .map(|windows| {
            let (first, last) = (windows[0], windows[windows.len() - 1]);
            let (cut, input) = (&problem.cuts[first.run], found.inputs[first.input]);
            let at = |window: usize| cut.time((window * cut.rows_per_window) as f64);
            let (unit, n) = (usual(problem, input), windows.len() as f64);
            let mean = windows.iter().map(|i| i.value[0]).sum::<f64>() / n;
            let variance = windows.iter().map(|i| i.value[1].powi(2)).sum::<f64>() / (n * n);
            Event {
                recording: cut.name.clone(),
                from: at(first.window),
                until: at(last.window + 1),
                input: words(input).to_owned(),
                size: unit * mean,
                half: SETTINGS.proof.interval * SETTINGS.proof.curvature * unit * variance.sqrt(),
                unit: found.place.unit().to_string(),
            }
        })
        .collect();
    out.sort_by(|a, b| a.recording.cmp(&b.recording).then(a.from.total_cmp(&b.from)));
    out
}

/// The input in words.
fn words(input: Input) -> &'static str {
    match input {
        Input::Torque(0) => "torque, left",
        Input::Torque(_) => "torque, right",
        Input::Force(_) => "force",
        Input::Moment => "yaw moment",
        Input::Grip(0) => "grip, left",
        Input::Grip(_) => "grip, right",
        Input::LateralGrip => "lateral grip",
        Input::Radius(_) => "radius",
        Input::Slope(_) => "slope",
    }
}

/// Share of the excess cost that free runs with the events leave, and how many times what a fault-free drive costs.
fn left(judged: &Judged<'_>, retuned: &Fitted, found: &Found) -> (f64, f64) {
    let p = judged.problem;
    let series = |k: usize| -> Vec<Vec<f64>> {
        let unit = usual(p, found.inputs[k]);
        let mut out: Vec<Vec<f64>> =
            p.cuts.iter().map(|cut| vec![0.0; cut.torque.len() / cut.rows_per_window.max(1) + 1]).collect();
        for i in found.instants.iter().filter(|i| i.input == k) {
            if let Some(u) = out[i.run].get_mut(i.window) {
                *u = unit * i.value[0];
            }
        }
        out
    };
    let inputs: Inputs = found.inputs.iter().enumerate().map(|(k, input)| (*input, series(k))).collect();
    let acting = Some(Acting::Given { inputs: Arc::new(inputs), times: 1.0, unit: 1.0 });
    let h = Hypothesis { acting, ..Hypothesis::default() };
    let start = p.begin(&h, Point { effects: vec![1.0], ..p.origin() }, None);
    let fitted = p.refine(&h, start, SETTINGS.refit.steps, None);
    let fault_free = fault_free_cost(p, &judged.calibration.regimes.scatter);
    (Standing::left_of(fitted.cost, retuned.cost, fault_free), (fitted.cost / fault_free.max(1.0)).max(1.0))
}

impl References<'_> {
    /// Share of the windows of the references with such events.
    fn share(&self, like: &Found) -> Option<f64> {
        let wide = Problem { outlier_scale: SETTINGS.refit.outlier_scale, ..self.problem.clone() };
        let operator = Operator::of(&wide, &self.base, &like.inputs);
        found(&wide, &self.base, &operator, like.place, &[like.size]).map(|f| f.filled)
    }
}
