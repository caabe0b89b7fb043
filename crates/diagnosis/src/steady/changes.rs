//! When inside a recording the straight load changes, and whether a slope or the ground does it.
//!
//! From currents alone: the straight load as a piecewise constant course ([`level`](super::level)). With all three
//! turning rates: the slope under the robot ([`attitude`](super::attitude)), and what of the load is left after it.

use serde::Serialize;

use crate::steady::attitude::{Attitude, attitude};
use crate::steady::compare::NINETY;
use crate::steady::extract::CLASSES;
use crate::steady::level::levels;
use crate::steady::name::UNNAMED_STRAIGHT;
use crate::steady::run::SpeedRun;
use crate::steady::straight::{Reading, readings, reads_nothing};

/// A change of the straight load inside a recording. Times in s on the clock of the loads.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LoadChange {
    /// Name of the recording.
    pub recording: String,
    /// From the first to the last row that shows it.
    pub interval: [f64; 2],
    /// Between these it begins; apart where turns or stops hide it.
    pub onset: [f64; 2],
    /// Between these it ends.
    pub end: [f64; 2],
    /// Straight driving that shows it, s.
    pub seconds: f64,
    /// Straight load over that of the rest; at most this if `bound`. `None` where the slope was seen by the gyro.
    pub ratio: Option<f64>,
    /// Slope that does it, uphill in the direction of travel positive, degrees; at most this if `bound`.
    pub slope: f64,
    /// Half of its 90 % interval, degrees.
    pub slope_half: f64,
    /// The currents sit in their dead band: ratio and slope are upper bounds.
    pub bound: bool,
    /// Ids of the effects that may be the cause; one if it is decided.
    pub causes: Vec<&'static str>,
    /// What decided, or why nothing did.
    pub reason: &'static str,
}

/// What a recording shows of changes.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Changes {
    /// Changes of the load.
    pub found: Vec<LoadChange>,
    /// Driving in which no change could have been seen (turns, stops), s.
    pub hidden: Vec<Hidden>,
}

/// A stretch of driving in which no change could have been seen.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Hidden {
    /// Name of the recording.
    pub recording: String,
    /// From, until, s.
    pub interval: [f64; 2],
}

const GRADE: &str = "grade";
const ROLLING: &str = "rolling_resistance";

/// Rows that show the same change are at most this far apart, s.
const APART: f64 = 8.0;
/// A change shorter than this is not told, s of straight driving by currents, of driving by the gyro.
const LEAST: f64 = 1.5;
const LEAST_SLOPE: f64 = 3.0;
/// Gaps in the sight of a slope that do not end it, s.
const SLOPE_GAP: f64 = 2.0;
/// The load of a level stretch is known after so many seconds.
const KNOWN: f64 = 10.0;
/// A slope that is told, degrees: seen by the gyro, or as a jump of the load.
const SLOPE: f64 = 1.6;
const JUMP: f64 = 1.9;
/// No friction falls to this share of the usual load: the robot runs downhill.
const BELOW_FRICTION: f64 = 0.35;
const BELOW_SECONDS: f64 = 1.0;
/// Driving at least, m/s.
const DRIVING: f64 = 0.05;
/// Clocks are aligned to about this, s: added to where a slope begins and ends.
const CLOCK: f64 = 0.35;

/// Straight load known from elsewhere, N m, by speed class; `None` where no reference was driven at such a speed.
pub(crate) type Usual = [Option<f64>; CLASSES.len() - 1];

/// The class of a speed.
fn class(speed: f64) -> usize {
    CLASSES.windows(2).position(|c| speed < c[1]).unwrap_or(CLASSES.len() - 2)
}

/// Consecutive indices at most `gap` seconds apart.
fn pieces(time: &[f64], rows: impl Iterator<Item = usize>, gap: f64) -> Vec<Vec<usize>> {
    let mut out: Vec<Vec<usize>> = Vec::new();
    for i in rows {
        match out.last_mut() {
            Some(piece) if piece.last().is_some_and(|&k| time[i] - time[k] <= gap) => piece.push(i),
            _ => out.push(vec![i]),
        }
    }
    out
}

/// The load of most of the run at each speed class: its own where that is plausible beside the references', theirs
/// otherwise.
fn usual_of(run: &SpeedRun, readings: &[Option<Reading>], level: &[f64], usual: &Usual) -> Usual {
    let known = usual.iter().flatten().next().copied();
    let plausible =
        |l: f64, reference: Option<f64>| reference.is_none_or(|r| l < r * UNNAMED_STRAIGHT && l > r / UNNAMED_STRAIGHT);
    // Median of the class's levels, if there is enough of it.
    let median = |c: usize, keep: &dyn Fn(f64) -> bool| {
        let exact = |i: &usize| readings[*i].is_some_and(Reading::is_exact) && class(run.forward(*i).abs()) == c;
        let mut all: Vec<f64> = (0..level.len()).filter(exact).map(|i| level[i]).filter(|l| keep(*l)).collect();
        all.sort_by(f64::total_cmp);
        (all.len() as f64 * run.period() >= KNOWN).then(|| all[all.len() / 2])
    };
    let references: Usual = usual.map(|own| own.or(known));
    let like: Usual = std::array::from_fn(|c| median(c, &|l| plausible(l, references[c])));
    // A run of which no part is like the references is compared with itself: the whole of it is told elsewhere.
    let alike = like.iter().any(Option::is_some);
    std::array::from_fn(|c| {
        let own = like[c].or_else(|| if alike { references[c] } else { median(c, &|_| true) });
        own.or(references[c])
    })
}

/// Changes of the straight load in a recording. `usual` are the references' loads, `weight` is `m g r`, N m.
pub(crate) fn changes(run: &SpeedRun, usual: &Usual, weight: f64) -> Changes {
    let readings = readings(run);
    let Some(any) = usual.iter().flatten().next().copied() else { return Changes::default() };
    let period = run.period();
    let level = levels(&readings, any, period);
    let usual = usual_of(run, &readings, &level, usual);
    let slope = attitude(run, &readings, any, weight, period);
    let found = match &slope {
        Some(slope) => {
            // What the slope explains is no change of the ground.
            let rest: Vec<Option<Reading>> = (0..readings.len())
                .map(|i| {
                    let pull = weight * slope.pitch[i] * run.forward(i).signum();
                    readings[i].map(|r| match r {
                        Reading::Exact(x) => Reading::Exact(x - pull),
                        Reading::AtMost(x) => Reading::AtMost(x - pull),
                    })
                })
                .collect();
            let mut found = slopes(run, slope);
            let level = levels(&rest, any, period);
            found.extend(jumps(run, &rest, &level, &usual, weight, true));
            found
        }
        None => jumps(run, &readings, &level, &usual, weight, false),
    };
    // With a gyro, a slope shows in turns as well.
    let hidden = if slope.is_some() { Vec::new() } else { hidden(run, &readings) };
    Changes { found, hidden }
}

/// Driving that shows no straight load for a while.
fn hidden(run: &SpeedRun, readings: &[Option<Reading>]) -> Vec<Hidden> {
    let seen = |i: &usize| readings[*i].is_some();
    let ends = [0, run.time.len() - 1];
    let mut marks: Vec<usize> = (0..readings.len()).filter(seen).chain(ends).collect();
    marks.sort_unstable();
    let moves = |from: usize, until: usize| (from..until).any(|i| (0..2).any(|j| run.speed[j][i].abs() > DRIVING));
    let gaps = marks.windows(2).filter(|w| run.time[w[1]] - run.time[w[0]] > APART && moves(w[0], w[1]));
    gaps.map(|w| Hidden { recording: run.name.clone(), interval: [run.time[w[0]], run.time[w[1]]] }).collect()
}

/// Jumps of the load, from currents. `after_slope`: what a slope does was taken away.
fn jumps(
    run: &SpeedRun,
    readings: &[Option<Reading>],
    level: &[f64],
    usual: &Usual,
    weight: f64,
    after_slope: bool,
) -> Vec<LoadChange> {
    let period = run.period();
    let base = |i: usize| usual[class(run.forward(i).abs())].unwrap_or(level[i]);
    let step = weight * JUMP.to_radians();
    let changed = |i: &usize| (level[*i] - base(*i)).abs() > step.max((1.0 - 1.0 / UNNAMED_STRAIGHT) * base(*i));
    let seen: Vec<usize> = (0..level.len()).filter(|&i| readings[i].is_some()).collect();
    let mut out = Vec::new();
    for piece in pieces(&run.time, seen.iter().copied().filter(changed), APART) {
        // A piece has one direction.
        for piece in piece.chunk_by(|&a, &b| (level[a] > base(a)) == (level[b] > base(b))) {
            let seconds = piece.len() as f64 * period;
            if seconds < LEAST {
                continue;
            }
            let exact: Vec<usize> =
                piece.iter().copied().filter(|&i| readings[i].is_some_and(Reading::is_exact)).collect();
            let bound = 2 * exact.len() < piece.len();
            let of = if bound { piece } else { &exact };
            let mean = |f: &dyn Fn(usize) -> f64| of.iter().map(|&i| f(i)).sum::<f64>() / of.len() as f64;
            let load = mean(&|i| readings[i].map_or(0.0, Reading::value));
            let from = mean(&base);
            // What the currents only bound from above may be anything between.
            if bound && load > from / UNNAMED_STRAIGHT {
                continue;
            }
            let (first, last) = (piece[0], piece[piece.len() - 1]);
            let own = |i: usize| level[i] - base(i);
            let before = seen.iter().rev().find(|&&i| i < first).copied();
            let after = seen.iter().find(|&&i| i > last).copied();
            // Cold drive trains differ from the references, but do not jump at one speed.
            let jumped = [before, after].into_iter().flatten().any(|i| {
                class(run.forward(i).abs()) == class(run.forward(first).abs()) && own(i).abs() < 0.5 * own(first).abs()
            });
            if !jumped && load > from / UNNAMED_STRAIGHT && load < from * UNNAMED_STRAIGHT * (1.0 + SCATTER) {
                continue;
            }
            let slope = ((load - from) / weight).clamp(-1.0, 1.0).asin().to_degrees();
            let nothing = piece.iter().filter(|&&i| reads_nothing(run, i)).count() as f64 * period;
            let below = load < BELOW_FRICTION * from || nothing >= BELOW_SECONDS && load < from / UNNAMED_STRAIGHT;
            let (causes, reason) = if after_slope {
                (vec![ROLLING], "the gyro shows no slope that would do it")
            } else if below {
                (vec![GRADE], "less than any friction: it runs downhill")
            } else {
                (vec![GRADE, ROLLING], "a straight drive one way cannot tell them apart")
            };
            out.push(LoadChange {
                recording: run.name.clone(),
                interval: [run.time[first], run.time[last]],
                onset: [before.map_or(run.time[0], |i| run.time[i]), run.time[first]],
                end: [run.time[last], after.map_or(run.time[run.time.len() - 1], |i| run.time[i])],
                seconds,
                ratio: Some(load / from),
                slope,
                slope_half: NINETY * SCATTER * from / weight * 180.0 / std::f64::consts::PI,
                bound,
                causes,
                reason,
            });
        }
    }
    if !after_slope {
        decide_by_heading(run, &mut out);
    }
    out
}

/// Scatter of the straight load along one floor, as a share.
const SCATTER: f64 = 0.15;
/// Headings this far apart tell a slope from the ground, rad; a way back, rad.
const OTHER_HEADING: f64 = std::f64::consts::FRAC_PI_3;
const WAY_BACK: f64 = 2.6;

/// A slope depends on the heading, the ground does not: changes driven both ways tell them apart.
fn decide_by_heading(run: &SpeedRun, found: &mut [LoadChange]) {
    let Some(yaw) = &run.yaw_rate else { return };
    let mut heading = vec![0.0; yaw.len()];
    for i in 1..yaw.len() {
        heading[i] = heading[i - 1] + 0.5 * (yaw[i] + yaw[i - 1]) * (run.time[i] - run.time[i - 1]);
    }
    // Direction of travel in the middle of a change.
    let direction = |c: &LoadChange| {
        let i = run.time.partition_point(|t| *t < 0.5 * (c.interval[0] + c.interval[1])).min(heading.len() - 1);
        heading[i] + if run.forward(i) < 0.0 { std::f64::consts::PI } else { 0.0 }
    };
    // A bound says neither that loads are alike nor that they are opposite.
    let seen: Vec<(f64, f64)> = found.iter().filter(|c| !c.bound).map(|c| (direction(c), c.slope)).collect();
    for change in found.iter_mut().filter(|c| c.causes.len() > 1 && !c.bound) {
        let (own, slope) = (direction(change), change.slope);
        let apart = |other: f64| (other - own).sin().atan2((other - own).cos()).abs();
        let way_back = seen.iter().any(|o| apart(o.0) > WAY_BACK && o.1 * slope < 0.0);
        let whichever = seen.iter().any(|o| apart(o.0) > OTHER_HEADING && (o.1 / slope - 1.0).abs() < SCATTER);
        if way_back {
            change.causes = vec![GRADE];
            change.reason = "the way back shows the opposite";
        } else if whichever {
            change.causes = vec![ROLLING];
            change.reason = "it is the same in another heading";
        }
    }
}

/// Slopes that the gyro and the load show together.
fn slopes(run: &SpeedRun, attitude: &Attitude) -> Vec<LoadChange> {
    let drives = |i: usize| run.forward(i).abs() > DRIVING;
    let certain = |i: usize| {
        drives(i)
            && attitude.pitch[i].abs() > SLOPE.to_radians()
            && attitude.pitch[i].abs() > NINETY * attitude.sigma[i]
    };
    // What is certain somewhere goes on to where it is no slope.
    let mut steep: Vec<bool> = (0..run.time.len()).map(certain).collect();
    let goes_on = |i: usize, k: usize| {
        let (here, there) = (attitude.pitch[i], attitude.pitch[k]);
        drives(i) && here * there > 0.0 && here.abs() > SLOPE.to_radians()
    };
    for i in 1..steep.len() {
        steep[i] = steep[i] || (steep[i - 1] && goes_on(i, i - 1));
    }
    for i in (1..steep.len()).rev() {
        steep[i - 1] = steep[i - 1] || (steep[i] && goes_on(i - 1, i));
    }
    let mut out = Vec::new();
    for piece in pieces(&run.time, (0..run.time.len()).filter(|&i| steep[i]), SLOPE_GAP) {
        for piece in piece.chunk_by(|&a, &b| attitude.pitch[a] * attitude.pitch[b] > 0.0) {
            let (first, last) = (piece[0], piece[piece.len() - 1]);
            let [from, until] = [run.time[first], run.time[last]];
            if until - from < LEAST_SLOPE {
                continue;
            }
            let n = piece.len() as f64;
            let along = |i: usize| attitude.pitch[i] * run.forward(i).signum();
            let mean = piece.iter().map(|&i| along(i)).sum::<f64>() / n;
            let sigma = piece.iter().map(|&i| attitude.sigma[i]).sum::<f64>() / n;
            if mean.abs() < NINETY * sigma {
                continue;
            }
            out.push(LoadChange {
                recording: run.name.clone(),
                interval: [from, until],
                onset: [from - CLOCK, from + CLOCK],
                end: [until - CLOCK, until + CLOCK],
                seconds: n * run.period(),
                ratio: None,
                slope: mean.to_degrees(),
                slope_half: (NINETY * sigma).to_degrees(),
                bound: false,
                causes: vec![GRADE],
                reason: "the gyro tilts with it",
            });
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::steady::testing::{Leg, STRAIGHT, WEIGHT, drive};

    const USUAL: Usual = [Some(STRAIGHT), None, None];

    fn found(legs: &[Leg], gyro: bool) -> Vec<LoadChange> {
        changes(&drive(legs, gyro), &USUAL, WEIGHT).found
    }

    fn near([a, b]: [f64; 2], moment: f64) -> bool {
        b - a < 1.0 && a - 1.0 < moment && moment < b + 1.0
    }

    #[test]
    fn a_climb_is_found_with_its_slope_and_both_causes() {
        let all = found(&[Leg::straight(30.0), Leg::straight(15.0).slope(3.0), Leg::straight(30.0)], false);
        assert_eq!(all.len(), 1, "{all:?}");
        let c = &all[0];
        assert!(near(c.onset, 30.0) && near(c.end, 45.0), "{c:?}");
        assert!(!c.bound && (c.slope - 3.0).abs() < 0.5 && c.slope_half > 0.5, "{c:?}");
        assert_eq!(c.causes, [GRADE, ROLLING]);
    }

    #[test]
    fn a_descent_into_the_dead_band_is_a_bound_and_no_friction() {
        let all = found(&[Leg::straight(30.0), Leg::straight(15.0).slope(-6.0), Leg::straight(30.0)], false);
        assert_eq!(all.len(), 1, "{all:?}");
        let c = &all[0];
        assert!(near(c.onset, 30.0) && near(c.end, 45.0), "{c:?}");
        assert!(c.bound && c.slope < -2.0 && c.slope > -6.0, "{c:?}");
        assert_eq!(c.causes, [GRADE]);
    }

    #[test]
    fn a_cold_drive_train_and_a_dearer_turn_are_no_change() {
        let cold = |leg: Leg| Leg { straight: 1.35 * STRAIGHT, ..leg };
        assert_eq!(found(&[cold(Leg::straight(40.0))], false), []);
        let turns = [Leg::straight(20.0), Leg { scrub: 40.0, ..Leg::turn(10.0) }, Leg::straight(20.0)];
        let out = changes(&drive(&turns, false), &USUAL, WEIGHT);
        assert_eq!(out.found, []);
        let hidden: Vec<[f64; 2]> = out.hidden.iter().map(|h| h.interval).collect();
        assert_eq!(hidden.len(), 1);
        assert!((hidden[0][0] - 20.0).abs() < 0.5 && (hidden[0][1] - 31.0).abs() < 0.6, "{hidden:?}");
    }

    #[test]
    fn what_begins_in_a_turn_is_bracketed() {
        let all =
            found(&[Leg::straight(30.0), Leg::turn(10.0), Leg::straight(15.0).slope(4.0), Leg::straight(20.0)], false);
        assert_eq!(all.len(), 1, "{all:?}");
        let [a, b] = all[0].onset;
        assert!(a < 30.1 && b > 40.0, "{all:?}");
    }

    #[test]
    fn the_way_back_decides() {
        let back = Leg { speed: [-0.24, -0.24], ..Leg::straight(15.0) };
        let legs = [
            Leg::straight(30.0),
            Leg::straight(15.0).slope(2.6),
            Leg::straight(20.0),
            back.slope(2.6),
            Leg::straight(20.0),
        ];
        let all = found(&legs, false);
        assert_eq!(all.len(), 2, "{all:?}");
        assert!(all[0].slope > 2.0 && all[1].slope < -1.0, "{all:?}");
        assert_eq!(all[0].causes, [GRADE], "{all:?}");
    }

    #[test]
    fn with_a_gyro_slope_and_ground_are_told_apart() {
        let slope = found(&[Leg::straight(30.0), Leg::straight(15.0).slope(4.0), Leg::straight(30.0)], true);
        assert_eq!(slope.len(), 1, "{slope:?}");
        assert_eq!(slope[0].causes, [GRADE]);
        assert!(
            (slope[0].slope - 4.0).abs() < 0.6 && near(slope[0].onset, 30.0) && near(slope[0].end, 45.0),
            "{slope:?}"
        );
        let soft = Leg { straight: 2.0 * STRAIGHT, ..Leg::straight(15.0) };
        let ground = found(&[Leg::straight(30.0), soft, Leg::straight(30.0)], true);
        assert_eq!(ground.len(), 1, "{ground:?}");
        assert_eq!(ground[0].causes, [ROLLING]);
        assert!(near(ground[0].onset, 30.0), "{ground:?}");
        assert_eq!(found(&[Leg::straight(60.0)], true), []);
    }
}
