//! When no law fits: at which instants something acts, where, and how strongly.
//!
//! Places are told apart by the evidence of an arbitrary input there, or, where events are too rare for it, in few windows. At
//! the best place windows get an input one after another while each is worth more than choosing it costs. Windows whose input stands out of its interval, joined where they follow one another,
//! are events. Responses are linear about a free run, so that windows are chosen anew about the free run with what was found, while
//! its cost falls.

use std::sync::Arc;

use law::{Input, Place};
use statrs::function::factorial::ln_binomial;
use verdict::{Event, FoundEvents};

use super::acting::{Acting, Inputs};
use super::gate::{self, References};
use super::operator::{Operator, usual};
use super::rank::Ranking;
use super::series::{Ground, Kept, Seen, Series, Solved};
use super::shared::{opposed, shared};
use crate::decide::fault_free_cost;
use crate::fit::{Fitted, Hypothesis, Point, Problem};
use crate::judged::Judged;
use crate::settings::law::{Events, SETTINGS};
use crate::simulate::Response;
use crate::windows::Cut;

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
    /// Mean and sigma, in the unit of the input.
    pub(super) size: f64,
    pub(super) sigma: f64,
}

/// A place with the evidence that something acts there.
struct Acts {
    place: Place,
    inputs: Vec<Input>,
    /// Usual size of what acts, in what is usual at the place.
    size: f64,
    /// Log Bayes factor over none of an input in every window; or, where that is below zero at every place, of an input in few
    /// windows, less what choosing them costs, nats.
    evidence: f64,
    /// The second of these.
    of_few: f64,
    series: Series,
    solved: Solved,
}

/// Events at a place.
struct Found {
    instants: Vec<Instant>,
    /// Windows, and the share of them with an event.
    windows: usize,
    filled: f64,
    /// The free run with these events.
    inputs: Inputs,
    cost: f64,
}

/// The events of the recordings; `None` where there are none, or too many to be events.
pub(super) fn find(
    judged: &Judged<'_>,
    ranking: &Ranking<'_>,
    retuned: &Fitted,
    references: Option<&References<'_>>,
) -> Option<FoundEvents> {
    let references = references?;
    // What is far off must not count less: events are outliers.
    let wide = Problem { outlier_scale: SETTINGS.refit.outlier_scale, ..judged.problem.clone() };
    let ground = Ground { problem: &wide, base: ranking.base, operator: &ranking.operator };
    let all = Acts::everywhere(&ground);
    let (best, others) = all.split_first()?;
    let fault_free = fault_free_cost(&wide, &judged.calibration.regimes.scatter);
    let found = best.events(&ground, fault_free)?;

    let name = judged.decision.scored.first().map_or(0.0, |s| s.score);
    let recordings = (0..wide.cuts.len()).filter(|run| found.instants.iter().any(|i| i.run == *run)).count();
    let events = events(&wide, best, &found);
    let is_list = events.len() >= EVENTS.least
        && recordings >= SETTINGS.gates.recordings.min(wide.cuts.len())
        && found.filled < EVENTS.filled;
    let Standing { left, misfit, score } = found.standing(judged, retuned);
    let is_better = score > SETTINGS.gates.score && score > name + SETTINGS.gates.above_name;
    if !is_list || !is_better || left > EVENTS.left {
        return None;
    }
    let share = references.share(best)?;
    if share > SETTINGS.gates.in_references * found.filled {
        return None;
    }

    let class = SETTINGS.gates.class * misfit;
    let alike = others.iter().filter(|o| best.evidence - o.evidence < class);
    Some(FoundEvents {
        place: best.place.name().to_owned(),
        places_alike: alike.map(|o| o.place.name().to_owned()).collect(),
        shared: shared(&ranking.signals, &best.inputs, &found.instants),
        events,
        filled: found.filled,
        opposed: opposed(&ranking.signals, &best.inputs, &found.instants),
        in_references: share / found.filled,
        left,
        score,
    })
}

impl Acts {
    /// With the usual size that has most evidence.
    fn new(ground: &Ground<'_>, place: Place, sizes: &[f64]) -> Option<Self> {
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
    fn everywhere(ground: &Ground<'_>) -> Vec<Self> {
        let mut all: Vec<Self> = PLACES.into_iter().filter_map(|p| Self::new(ground, p, &EVENTS.sizes)).collect();
        if all.iter().all(|a| a.evidence < 0.0) {
            all.iter_mut().for_each(|a| a.evidence = a.of_few);
        }
        all.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
        all
    }

    /// The windows that earn an input, and the free run with it: about that, they are chosen anew while it gets better.
    ///
    /// Where free runs with them still cost more than `fault_free`, intervals are wider by that (dispersion), and what does not
    /// stand out of them is left out.
    fn events(&self, ground: &Ground<'_>, fault_free: f64) -> Option<Found> {
        let mut best = self.chosen(ground, &self.series, &self.solved, 1.0)?;
        let mut last = None;
        for _ in 1..EVENTS.rounds {
            let response = given(ground.problem, ground.base, &best.0.inputs);
            let seen = Seen { response: &response, inputs: &best.0.inputs };
            let series = Series::new(ground, &self.inputs, Some(&seen))?;
            let next = self.chosen(ground, &series, &best.1, 1.0)?;
            last = Some(series);
            if next.0.cost >= best.0.cost {
                break;
            }
            best = next;
        }
        let dispersion = (best.0.cost / fault_free.max(1.0)).max(1.0).sqrt();
        self.chosen(ground, last.as_ref().unwrap_or(&self.series), &best.1, dispersion).map(|(found, _)| found)
    }

    fn chosen(&self, ground: &Ground<'_>, series: &Series, solved: &Solved, dispersion: f64) -> Option<(Found, Solved)> {
        let p = ground.problem;
        let (kept, solved) = few(series, solved, self.size, dispersion)?;
        let windows: usize = series.everywhere().iter().flatten().map(Vec::len).sum();
        let mut instants = Vec::new();
        for (run, segments) in kept.iter().enumerate() {
            for (s, indices) in segments.iter().enumerate() {
                for (index, value) in indices.iter().zip(&solved.values[run][s]) {
                    let (input, window) = series.place(run, s, *index);
                    let window = ground.operator.first(run, s) + window;
                    let [size, sigma] = value.map(|v| v * usual(p, self.inputs[input]));
                    instants.push(Instant { input, run, window, size, sigma: dispersion * sigma });
                }
            }
        }
        instants.sort_by_key(|i| (i.run, i.input, i.window));
        let filled = instants.len() as f64 / windows.max(1) as f64;
        let inputs = self.series_of(p, &instants);
        let cost = p.misfit(&given(p, ground.base, &inputs));
        Some((Found { instants, windows, filled, inputs, cost }, solved))
    }

    /// The inputs of every window, zero but at the instants.
    fn series_of(&self, p: &Problem<'_>, instants: &[Instant]) -> Inputs {
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

/// Given inputs as a hypothesis.
fn hypothesis(inputs: &Inputs) -> Hypothesis {
    let acting = Some(Acting::Given { inputs: Arc::new(inputs.clone()), times: 1.0, unit: 1.0 });
    Hypothesis { acting, ..Hypothesis::default() }
}

/// The free run with given inputs.
fn given(p: &Problem<'_>, base: &Fitted, inputs: &Inputs) -> Response {
    p.response(&Point { effects: vec![1.0], ..base.point.clone() }, &hypothesis(inputs))
}

fn inputs_of(place: Place) -> Vec<Input> {
    Input::ALL.into_iter().filter(|input| place.acts_on(*input)).collect()
}

/// Windows that earn an input of this usual size, each standing out of its interval, with the solution that holds these alone.
fn few(series: &Series, solved: &Solved, size: f64, dispersion: f64) -> Option<(Kept, Solved)> {
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
    let of_run = |(run, values): (&Vec<Vec<usize>>, &Vec<Vec<[f64; 2]>>)| run.iter().zip(values).map(of_segment).collect();
    kept.iter().zip(&solved.values).map(of_run).collect()
}

/// Windows that follow one another with one sign, as events, in the order of recordings and times.
fn events(problem: &Problem<'_>, acts: &Acts, found: &Found) -> Vec<Event> {
    let follows = |a: &Instant, b: &Instant| {
        a.run == b.run && a.input == b.input && b.window == a.window + 1 && (a.size > 0.0) == (b.size > 0.0)
    };
    let mut out: Vec<Event> = found
        .instants
        .chunk_by(follows)
        .map(|windows| {
            let (first, last) = (windows[0], windows[windows.len() - 1]);
            let (cut, input) = (&problem.cuts[first.run], acts.inputs[first.input]);
            let at = |window: usize| cut.time((window * cut.rows_per_window) as f64);
            let n = windows.len() as f64;
            let variance = windows.iter().map(|i| i.sigma.powi(2)).sum::<f64>() / (n * n);
            Event {
                recording: cut.name.clone(),
                from: at(first.window),
                until: at(last.window + 1),
                input: words(input).to_owned(),
                size: windows.iter().map(|i| i.size).sum::<f64>() / n,
                half: SETTINGS.proof.interval * SETTINGS.proof.curvature * variance.sqrt(),
                unit: acts.place.unit().to_string(),
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

/// How events stand in free run.
struct Standing {
    /// Share of the excess cost that is left.
    left: f64,
    /// How many times what a fault-free drive costs.
    misfit: f64,
    /// Fall of the cost below "re-tune only", less what choosing the windows and a number for each cost, nats.
    score: f64,
}

impl Found {
    fn standing(&self, judged: &Judged<'_>, retuned: &Fitted) -> Standing {
        let p = judged.problem;
        let h = hypothesis(&self.inputs);
        let start = p.begin(&h, Point { effects: vec![1.0], ..p.origin() }, None);
        let fitted = p.refine(&h, start, SETTINGS.refit.steps, None);
        let fault_free = fault_free_cost(p, &judged.calibration.regimes.scatter);
        let n = self.instants.len();
        let price = ln_binomial(self.windows as u64, n as u64) + SETTINGS.prices.shape * n as f64;
        Standing {
            left: gate::left(fitted.cost, retuned.cost, fault_free),
            misfit: (fitted.cost / fault_free.max(1.0)).max(1.0),
            score: retuned.cost - fitted.cost - price,
        }
    }
}

impl References<'_> {
    /// Share of the windows of the references with such events.
    fn share(&self, like: &Acts) -> Option<f64> {
        let wide = Problem { outlier_scale: SETTINGS.refit.outlier_scale, ..self.problem.clone() };
        let operator = Operator::of(&wide, &self.base, &like.inputs);
        let ground = Ground { problem: &wide, base: &self.base, operator: &operator };
        Some(Acts::new(&ground, like.place, &[like.size])?.events(&ground, f64::INFINITY)?.filled)
    }
}

#[cfg(test)]
mod tests {
    use testing::robot;

    use super::*;
    use crate::testing::{cutting, driven, problem};
    use crate::windows::cut;

    /// Windows of each recording in which the right drive is held back, and by how much, N m.
    const HIDDEN: [&[usize]; 2] = [&[12, 13, 47, 71, 72, 73], &[33, 90, 91, 120]];
    const HELD: f64 = -4.0;

    /// Drives of the plant whose right drive is held back in these windows.
    fn cuts(windows: [&[usize]; 2]) -> Vec<Cut> {
        let robot = robot();
        let mut cuts = [12.0, 16.0].map(|seconds| cut(&driven(&robot, &[], seconds), &cutting()));
        let held: Vec<Vec<f64>> = windows
            .iter()
            .map(|of_run| (0..170).map(|w| if of_run.contains(&w) { HELD } else { 0.0 }).collect())
            .collect();
        let p = problem(&robot, &cuts);
        let base = p.begin(&Hypothesis::default(), p.origin(), None);
        let shown = given(&p, &base, &vec![(Input::Torque(1), held)]);
        // What the free run gets wrong without them stays as it is.
        for (run, cut) in cuts.iter_mut().enumerate() {
            for (s, segment) in cut.segments.iter_mut().enumerate() {
                for (w, observed) in segment.observed.iter_mut().enumerate() {
                    for c in crate::channel::Channel::ALL {
                        observed[c] += shown[run][s][w][c] - base.response[run][s][w][c];
                    }
                }
            }
        }
        cuts.into()
    }

    fn likeliest(windows: [&[usize]; 2]) -> (Place, Found) {
        let (robot, cuts) = (robot(), cuts(windows));
        let p = problem(&robot, &cuts);
        let base = p.begin(&Hypothesis::default(), p.origin(), None);
        let operator = Operator::new(&p, &base);
        let ground = Ground { problem: &p, base: &base, operator: &operator };
        let all = Acts::everywhere(&ground);
        let best = all.first().expect("a place");
        let found = best.events(&ground, f64::INFINITY).expect("a solution");
        (best.place, found)
    }

    #[test]
    fn a_drive_that_is_held_back_now_and_then_is_found_where_and_when_it_is() {
        let (place, found) = likeliest(HIDDEN);
        assert_eq!(place, Place::TorqueRight);
        let told: Vec<(usize, usize)> = found.instants.iter().map(|i| (i.run, i.window)).collect();
        let hidden: Vec<(usize, usize)> =
            HIDDEN.iter().enumerate().flat_map(|(run, all)| all.iter().map(move |w| (run, *w))).collect();
        assert_eq!(told, hidden);
        for i in &found.instants {
            assert!((i.size - HELD).abs() < 0.8, "{i:?}");
        }
    }

    #[test]
    fn a_robot_that_lacks_nothing_has_no_events() {
        let (place, found) = likeliest([&[], &[]]);
        assert!(found.instants.is_empty(), "{place:?}: {:?}", found.instants);
    }
}
