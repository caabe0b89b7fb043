//! A pull along the body that is no slope: a rope, a hose, a trailer, or friction that differs between forward and backward.
//!
//! It holds the robot back by `P` whenever it goes forward and drives it on whenever it goes backward, whatever its heading: straight loads
//! are `S + P r` forward and `S − P r` backward. A slope does the same to drives there and back on one line; other headings, or an
//! accelerometer, tell it.

use std::collections::BTreeMap;

use inference::robust::{NINETY, mean};
use robot_model::effects::{constant_pull, grade};
use verdict::{BodyPull, Cause};

use crate::directed_pull::{Stretch, on_level_ground, on_two_grounds, onset, ratios_tried};
use crate::heading::stays_off_slope_ahead;
use crate::pieces::Usual;
use crate::plane::{costs_of_slopes, stretches};
use crate::run::SpeedRun;
use crate::settings::{CHANGES, changes::Plane, changes::Pull};
use crate::slope_pull::take_off_row;
use crate::words::recordings;

const PULL: Pull = CHANGES.pull;
const PLANE: Plane = CHANGES.plane;

/// Finds a pull along the body under all driving and takes it off the torques; `weight` is `m g r`, N m, with the share by which torques
/// may be off against it, and `radius` that of the wheels, m.
pub(crate) fn take_off(
    references: &[SpeedRun],
    runs: &mut [SpeedRun],
    usual: &Usual,
    (weight, radius): ((f64, f64), f64),
) -> Option<BodyPull> {
    let usually = of(references, usual).map(|found| found.pull);
    let found = of(runs, usual)?;
    // How this robot rolls both ways is no pull.
    let (pull, least) = usually.map_or((found.pull, PULL.unknown), |own| (found.pull - own, PULL.least));
    let any = usual.any()?;
    if pull.abs() < least * any || found.gain < PLANE.least_gain {
        return None;
    }

    let is_slope = slope_rivals(runs, usual, weight.0, &found);
    if is_slope == Rivals::Better {
        return None;
    }
    let may_be_slope = (is_slope == Rivals::Alike).then(|| least_slope(pull.abs(), weight.0));
    let mut intervals = BTreeMap::new();
    for (run, from) in runs.iter_mut().zip(&found.from) {
        let Some(from) = *from else { continue };
        for i in run.time.partition_point(|t| *t < from)..run.time.len() {
            let is_spin = run.speed[0][i] * run.speed[1][i] <= 0.0;
            if !is_spin {
                take_off_row(run, i, pull, usual);
            }
        }
        let until = run.time.last().copied().unwrap_or(from);
        intervals.insert(run.name.clone(), vec![[from.max(run.time[0]), until]]);
    }
    Some(BodyPull {
        intervals: if found.is_of_all() { BTreeMap::new() } else { intervals },
        pull: pull / radius,
        half: (found.half / radius).hypot(NINETY * weight.1 * pull / radius),
        ratios: found.ratios,
        stretches: found.stretches,
        may_be_slope,
    })
}

/// The likeliest pull, N m at the wheels, with half its 90 % interval; by how much it beats level ground, soft ground and two grounds,
/// nats; mean loads over the usual ones forward and backward; from when on it pulls in each recording, s.
struct Found {
    pull: f64,
    half: f64,
    gain: f64,
    ratios: [f64; 2],
    stretches: usize,
    from: Vec<Option<f64>>,
}

impl Found {
    /// Whether it pulls in all recordings from their beginning on.
    fn is_of_all(&self) -> bool {
        self.from.iter().all(|from| *from == Some(f64::NEG_INFINITY))
    }
}

fn of(runs: &[SpeedRun], usual: &Usual) -> Option<Found> {
    let is_unsigned = runs.iter().any(|run| run.magnitude_only);
    let all: Vec<Vec<Stretch>> = runs.iter().map(|run| stretches(run, usual)).collect();
    let (any, spread) = (usual.any()?, usual.unequal.ln());
    let on = |pull: f64, ratio: f64| on_level_ground(&all, is_unsigned, spread, (ratio, pull));
    let steps = (PULL.most / PULL.step).round() as i32;
    let pulls: Vec<f64> = (-steps..=steps).map(|k| PULL.step * f64::from(k) * any).collect();
    let onsets = |pull: f64| all.iter().map(move |own| onset(own, is_unsigned, spread, pull));
    let begins = |own: &[Stretch], k: usize| match k {
        0 => Some(f64::NEG_INFINITY),
        k => own.get(k).map(|s| s.from),
    };
    let costs: Vec<f64> = pulls.iter().map(|pull| onsets(*pull).map(|(cost, _)| cost).sum()).collect();
    let best = (0..pulls.len()).min_by(|&a, &b| costs[a].total_cmp(&costs[b]))?;
    let cost = costs[best] + PLANE.per_number;
    let level = std::iter::once(on(0.0, 1.0)).chain(ratios_tried().map(|ratio| on(0.0, ratio) + PLANE.per_number));
    let patches = ratios_tried().map(|ratio| on_two_grounds(&all, is_unsigned, spread, ratio) + PLANE.per_number);
    let gain = level.chain(patches).fold(f64::MAX, f64::min) - cost;

    let holds = |k: &usize| costs[*k] <= costs[best] + 0.5 * NINETY * NINETY;
    let below = (0..best).rev().take_while(holds).last().unwrap_or(best);
    let above = (best..pulls.len()).take_while(holds).last().unwrap_or(best);
    let from: Vec<Option<f64>> = all.iter().zip(onsets(pulls[best])).map(|(own, (_, k))| begins(own, k)).collect();
    let pulled: Vec<&Stretch> = all
        .iter()
        .zip(&from)
        .flat_map(|(own, from)| own.iter().filter(move |s| from.is_some_and(|from| from <= s.from)))
        .collect();
    let ratio = |way: f64| -> Vec<f64> { pulled.iter().filter(|s| s.way == way).map(|s| s.load / s.usual).collect() };
    let [ahead, back] = [ratio(1.0), ratio(-1.0)];
    if ahead.len().min(back.len()) < PULL.least_stretches {
        return None;
    }
    Some(Found {
        pull: pulls[best],
        half: (0.5 * (pulls[above] - pulls[below])).max(PULL.step * any),
        gain,
        ratios: [mean(ahead)?, mean(back)?],
        stretches: pulled.len(),
        from,
    })
}

/// The least slope that pulls as much, rad: it goes along the line of driving.
fn least_slope(pull: f64, weight: f64) -> f64 {
    (pull / weight).clamp(-1.0, 1.0).asin()
}

/// How a slope explains the loads beside a pull.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Rivals {
    Worse,
    Alike,
    Better,
}

fn slope_rivals(runs: &[SpeedRun], usual: &Usual, weight: f64, found: &Found) -> Rivals {
    let is_unsigned = runs.iter().any(|run| run.magnitude_only);
    let pulled = || runs.iter().zip(&found.from).filter_map(|(run, from)| Some((run, (*from)?)));
    let of_run = |(run, from): (&SpeedRun, f64)| -> Vec<Stretch> {
        stretches(run, usual).into_iter().filter(|s| from <= s.from).collect()
    };
    let all: Vec<Vec<Stretch>> = pulled().map(of_run).collect();
    let by_pull = on_level_ground(&all, is_unsigned, usual.unequal.ln(), (1.0, found.pull)) + PLANE.per_number;
    let gain = costs_of_slopes(&all, is_unsigned, usual, weight).into_iter().fold(f64::MAX, f64::min) - by_pull;
    // A body whose accelerometer shows no slope ahead stands on none.
    let ahead = least_slope(found.pull, weight);
    let is_level = pulled().any(|(run, from)| stays_off_slope_ahead(run, from, ahead));
    if gain >= PLANE.least_gain || is_level {
        Rivals::Worse
    } else if gain > -PLANE.least_gain {
        Rivals::Alike
    } else {
        Rivals::Better
    }
}

/// Its causes: a pull, or a slope where drives do not tell the two apart.
pub(crate) fn causes(p: &BodyPull, probability: f64) -> Vec<Cause> {
    let intervals = Some(p.intervals.clone()).filter(|all| !all.is_empty());
    let of_slope = if p.may_be_slope.is_some() { PULL.slope * probability } else { 0.0 };
    let pull = Cause {
        magnitude: Some(p.pull),
        sigma: Some(p.half / NINETY),
        unit: constant_pull::SPEC.parameters[0].unit.into(),
        intervals: intervals.clone(),
        ..Cause::plain(constant_pull::SPEC.id, constant_pull::SPEC.name, probability - of_slope)
    };
    let slope = p.may_be_slope.map(|angle| Cause {
        magnitude: Some(angle),
        sigma: Some(angle * p.half / (NINETY * p.pull.abs())),
        unit: inference::words::unit(&grade::SPEC).into(),
        intervals: intervals.clone(),
        ..Cause::plain(grade::SPEC.id, grade::SPEC.name, of_slope)
    });
    slope.into_iter().chain([pull]).collect()
}

/// What is said of it, and what to do.
pub(crate) fn told(p: &BodyPull, theirs: &str) -> String {
    let [ahead, back] = p.ratios;
    let towards = if p.pull > 0.0 { "rear" } else { "front" };
    let when = |(name, all): (&String, &Vec<[f64; 2]>)| {
        let [from, until] = all.first().copied().unwrap_or_default();
        format!("{} from {from:.1} s until {until:.1} s", recordings(name))
    };
    let stretches: Vec<String> = p.intervals.iter().map(when).collect();
    let place =
        if stretches.is_empty() { "under all driving".to_owned() } else { format!("in {}", stretches.join(", in ")) };
    let loads = format!(
        "{place}: the straight load is {ahead:.2} times {theirs} forward and {back:.2} times backward ({} stretches)",
        p.stretches
    );
    let force = format!("a force of {:.0} ± {:.0} N (90 %) towards the {towards} of the robot", p.pull.abs(), p.half);
    match p.may_be_slope {
        None => format!(
            "Pull {loads}, as by {force}, in every heading, so that it is no slope: a rope, a hose, a trailer, or a drive train that runs \
             harder one way. It is taken off all loads below."
        ),
        Some(angle) => format!(
            "Slope or pull {loads}, as on a slope of {:.1}° that all of these drives go up and down, or by {force}; they do not tell the \
             two apart. To find out, drive forward and backward across that line, too, or record an accelerometer. It is taken off all \
             loads below.",
            angle.to_degrees()
        ),
    }
}

#[cfg(test)]
mod tests {
    use std::slice;

    use super::*;
    use crate::testing::{Leg, STRAIGHT, WEIGHT, drive, levelled};

    const RADIUS: f64 = 0.1651;
    const USUAL: Usual = Usual { load: [Some(STRAIGHT), None, None], unequal: CHANGES.pieces.alike };
    const BACK: Leg = Leg { speed: [-0.24; 2], ..Leg::straight(8.0) };

    /// Forward and backward, three times, with turns between if so; what holds the robot back along its body, degrees of a slope.
    fn driven(degrees: [f64; 6], turn: bool) -> SpeedRun {
        let pair = |k: usize| {
            let straight = if k.is_multiple_of(2) { Leg::straight(8.0) } else { BACK };
            let turn = Leg::turn(if turn { 6.0 } else { 0.0 });
            [straight.slope(degrees[k]), turn]
        };
        let mut run = drive(&(0..6).flat_map(pair).collect::<Vec<_>>(), false);
        run.dead_band = 0.0;
        run
    }

    fn found(references: &[SpeedRun], mut runs: Vec<SpeedRun>) -> (Option<BodyPull>, Vec<SpeedRun>) {
        let told = take_off(references, &mut runs, &USUAL, ((WEIGHT, 0.0), RADIUS));
        (told, runs)
    }

    #[test]
    fn a_pull_is_told_with_its_force_and_taken_off_and_a_slope_or_level_ground_is_none() {
        let level = driven([0.0; 6], true);
        assert_eq!(found(slice::from_ref(&level), vec![level.clone()]).0, None);
        let (told, runs) = found(slice::from_ref(&level), vec![driven([3.0; 6], true)]);
        let pull = told.expect("a pull");
        let truth = WEIGHT * 3.0_f64.to_radians().sin() / RADIUS;
        assert!((pull.pull - truth).abs() < pull.half.max(0.15 * truth) && pull.may_be_slope.is_none(), "{pull:?}");
        assert_eq!(found(slice::from_ref(&level), runs).0, None, "it was taken off");
        // As references have it, it is how this robot rolls.
        assert_eq!(found(&[driven([3.0; 6], true)], vec![driven([3.0; 6], true)]).0, None);
    }

    #[test]
    fn a_pull_that_begins_inside_a_drive_is_told_from_there_on() {
        let level = driven([0.0; 6], true);
        let mut run = drive(
            &(0..12)
                .flat_map(|k| {
                    let straight = if k % 2 == 0 { Leg::straight(8.0) } else { BACK };
                    [straight.slope(if k < 6 { 0.0 } else { 3.0 }), Leg::turn(6.0)]
                })
                .collect::<Vec<_>>(),
            false,
        );
        run.dead_band = 0.0;
        let begins = run.time[level.time.len()];
        let pull = found(slice::from_ref(&level), vec![run]).0.expect("a pull");
        let [from, _] = pull.intervals["run"][0];
        assert!((from - begins).abs() < 2.5, "{pull:?} from {begins}");
        assert!(pull.may_be_slope.is_none() && pull.ratios[0] > 1.4 && pull.ratios[1] < 0.6, "{pull:?}");
    }

    #[test]
    fn there_and_back_on_one_line_a_pull_may_be_a_slope_and_an_accelerometer_tells() {
        let level = driven([0.0; 6], false);
        let line = driven([3.0; 6], false);
        let pull = found(slice::from_ref(&level), vec![line.clone()]).0.expect("a pull");
        assert!(pull.may_be_slope.is_some_and(|angle| (angle.to_degrees() - 3.0).abs() < 0.6), "{pull:?}");
        let ids: Vec<String> = causes(&pull, 0.9).into_iter().map(|c| c.effect).collect();
        assert_eq!(ids, ["grade", "constant_pull"]);
        let seen = |degrees: f64| {
            let mut run = line.clone();
            let rates = levelled(&[Leg::straight(48.0).slope(degrees)], 0.0).body_rates;
            run.body_rates = rates;
            found(slice::from_ref(&level), vec![run]).0.expect("a pull").may_be_slope
        };
        assert_eq!(seen(0.0), None);
        assert!(seen(3.0).is_some());
    }
}
