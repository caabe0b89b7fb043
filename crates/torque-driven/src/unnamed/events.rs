//! When no law fits: at which instants something acts, where, and how strongly.
//!
//! Places are told apart by the evidence of an arbitrary input there, or, where events are too rare for it, in few windows. At
//! the best place windows get an input one after another while each is worth more than choosing it costs. Windows whose input
//! stands out of its interval, joined where they follow one another, are events. Responses are linear about a free run, so
//! that windows are chosen anew about the free run with what was found, while its cost falls.

use law::Input;
use statrs::function::factorial::ln_binomial;
use verdict::{Event, FoundEvents};

use super::acting::Inputs;
use super::arbitrary::{Acts, Instant, Standing, few, given};
use super::gate::References;
use super::series::{Ground, Seen, Series, Solved};
use super::shared::{opposed, shared};
use super::signals::Signals;
use crate::decide::fault_free_cost;
use crate::fit::{Fitted, Problem};
use crate::judged::Judged;
use crate::settings::law::{Events, SETTINGS};

const EVENTS: Events = SETTINGS.events;

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

/// The events of the recordings; `None` where there are none, or too many to be events. `all`: places, the likeliest first.
pub(super) fn find(
    judged: &Judged<'_>,
    ground: &Ground<'_>,
    all: &[Acts],
    signals: &Signals,
    retuned: &Fitted,
    references: Option<&References<'_>>,
) -> Option<FoundEvents> {
    let (best, others) = all.split_first()?;
    let fault_free = fault_free_cost(ground.problem, &judged.calibration.regimes.scatter);
    let found = best.events(ground, fault_free)?;
    let recordings = (0..ground.problem.cuts.len()).filter(|run| found.instants.iter().any(|i| i.run == *run)).count();
    let events = events(ground.problem, best, &found);
    if events.len() < EVENTS.least
        || recordings < SETTINGS.gates.recordings.min(ground.problem.cuts.len())
        || found.filled > EVENTS.filled
    {
        return None;
    }

    let standing = Standing::new(judged, retuned, &found.inputs);
    let n = found.instants.len();
    let score = standing.gain - ln_binomial(found.windows as u64, n as u64) - SETTINGS.prices.shape * n as f64;
    let name = judged.decision.scored.first().map_or(0.0, |s| s.score);
    let is_better = score > SETTINGS.gates.score && score > name + SETTINGS.gates.above_name;
    if !is_better || standing.left > EVENTS.left {
        return None;
    }
    let in_references = match references {
        Some(references) => Some(references.share(best)? / found.filled),
        None => None,
    };
    let is_elsewhere = in_references.is_some_and(|share| share > SETTINGS.gates.in_references);
    (!is_elsewhere).then(|| FoundEvents {
        place: best.place.name().to_owned(),
        places_alike: standing.alike(best, others),
        shared: shared(signals, &best.inputs, &found.instants),
        opposed: opposed(signals, &best.inputs, &found.instants),
        events,
        filled: found.filled,
        in_references,
        left: standing.left,
        score,
    })
}

impl Acts {
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

    fn chosen(
        &self,
        ground: &Ground<'_>,
        series: &Series,
        solved: &Solved,
        dispersion: f64,
    ) -> Option<(Found, Solved)> {
        let (kept, solved) = few(series, solved, self.size, dispersion)?;
        let windows: usize = series.everywhere().iter().flatten().map(Vec::len).sum();
        let instants = self.instants(ground, &kept, &solved, dispersion);
        let filled = instants.len() as f64 / windows.max(1) as f64;
        let inputs = self.inputs_at(ground.problem, &instants);
        let cost = ground.problem.misfit(&given(ground.problem, ground.base, &inputs));
        Some((Found { instants, windows, filled, inputs, cost }, solved))
    }
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

impl References<'_> {
    /// Share of the windows of the references with such events.
    fn share(&self, like: &Acts) -> Option<f64> {
        self.at(like, |ground, acts| Some(acts.events(ground, f64::INFINITY)?.filled))
    }
}

#[cfg(test)]
mod tests {
    use law::Place;
    use testing::robot;

    use super::super::operator::Operator;
    use super::*;
    use crate::fit::Hypothesis;
    use crate::testing::{cutting, driven, problem};
    use crate::windows::{Cut, cut};

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
