//! Wheels that are commanded to turn the robot while its body does not turn: dug in, or spinning free; and wheels that are held.
//!
//! Looked for before anything else is measured: a body that stands has neither loads nor a track.

use inference::robust::{mean, median, quantile, sorted};
use robot_model::Robot;
use verdict::{Quantity, Standstill};

use crate::model::{Operating, predicted};
use crate::pieces::pieces;
use crate::run::SpeedRun;
use crate::settings::{CHANGES, MEASURING, changes::Stuck, measuring::Turns};

const STUCK: Stuck = CHANGES.standstill;
const TURNS: Turns = MEASURING.turns;

/// The effective track that the robot file predicts for a turn on the spot, m.
pub(crate) fn track_of_file(robot: &Robot<f64>) -> f64 {
    let speed = [-TURNS.difference, TURNS.difference];
    predicted(robot, &[], Operating { quantity: Quantity::EffectiveTrack, speed, right_outer: 1.0 }).exp()
}

/// Stretches of a recording in which the body stood although the wheels were commanded to turn it;
/// `track` in m.
pub(crate) fn standstills(run: &SpeedRun, track: f64) -> Vec<Standstill> {
    let Some(yaw) = &run.yaw_rate else { return Vec::new() };
    // Of rows whose speeds are wrong nobody knows.
    let commanded = |i: usize| run.difference(i).abs() > STUCK.turn && !run.standing[i];
    let share = |i: usize| yaw[i] * track / run.difference(i);
    // What was commanded one way for a while, and what came of it.
    let answered = |i: usize| {
        let way = run.difference(i).signum();
        let begin = run.time.partition_point(|t| *t < run.time[i] - STUCK.mean);
        let whole = run.time[i] - run.time[0] >= STUCK.mean;
        let same = |k: usize| commanded(k) && run.difference(k) * way > 0.0;
        (whole && (begin..=i).all(same)).then(|| {
            let sum = |f: &dyn Fn(usize) -> f64| (begin..=i).map(f).sum::<f64>();
            sum(&|k| yaw[k]) * track / sum(&|k| run.difference(k))
        })
    };
    let answers: Vec<Option<f64>> = (0..run.time.len()).map(answered).collect();
    let stands = |i: &usize| answers[*i].is_some_and(|share| share.abs() < STUCK.share);
    let turns = |i: usize| answers[i].is_some_and(|share| share.abs() >= STUCK.share);

    let mut found: Vec<[usize; 2]> = Vec::new();
    for piece in pieces(&run.time, (0..run.time.len()).filter(stands), STUCK.mean) {
        let last = piece[piece.len() - 1];
        // It stood from the command on, before that could be told.
        let mut first = piece[0];
        while first > 0 && commanded(first - 1) && share(first - 1).abs() < STUCK.share {
            first -= 1;
        }
        match found.last_mut() {
            Some([_, end]) if run.time[first] - run.time[*end] <= STUCK.bridge && !(*end..first).any(turns) => {
                *end = last;
            }
            _ => found.push([first, last]),
        }
    }

    found.retain(|[first, last]| run.time[*last] - run.time[*first] >= STUCK.least_seconds);
    let told = |[first, last]: [usize; 2]| {
        let rows: Vec<usize> = (first..=last).filter(|&i| commanded(i)).collect();
        let mean = |f: &dyn Fn(usize) -> f64| rows.iter().map(|&i| f(i)).sum::<f64>() / rows.len().max(1) as f64;
        Standstill {
            recording: run.name.clone(),
            interval: [run.time[first], run.time[last]],
            share: Some(mean(&share)),
            wheels: None,
            side: None,
            straight: straight(run),
            load: mean(&|i| run.torque[0][i].abs().max(run.torque[1][i].abs())),
            is_off: false,
        }
    };
    found.into_iter().map(told).collect()
}

/// Stretches in which wheels hardly turn although they are commanded to, those of both sides or of one, at torques above those of
/// driving, or next to none: motors that are switched off.
fn held_wheels(run: &SpeedRun) -> Vec<Standstill> {
    let mut out = held_of(run, &[0, 1]);
    for side in 0..2 {
        let is_new =
            |s: &Standstill| out.iter().all(|o| o.interval[1] < s.interval[0] || s.interval[1] < o.interval[0]);
        let found: Vec<Standstill> = held_of(run, &[side]).into_iter().filter(is_new).collect();
        out.extend(found.into_iter().map(|s| Standstill { side: Some(["left", "right"][side].into()), ..s }));
    }
    out
}

/// The same where all of these sides are held.
fn held_of(run: &SpeedRun, sides: &[usize]) -> Vec<Standstill> {
    let Some(commanded) = &run.commanded else { return Vec::new() };
    let most = |of: &[Vec<f64>; 2], i: usize| sides.iter().map(|&j| of[j][i].abs()).fold(0.0, f64::max);
    let asked = |i: usize| most(commanded, i) > STUCK.commanded;
    let share = |i: usize| {
        let sum = |of: &[Vec<f64>; 2]| sides.iter().map(|&j| of[j][i].abs()).sum::<f64>();
        sum(&run.speed) / sum(commanded)
    };
    let driving = (0..run.time.len()).filter(|&i| asked(i) && share(i) > STUCK.follows).map(|i| most(&run.torque, i));
    let Some(usual) = median(driving) else { return Vec::new() };

    let held = (0..run.time.len()).filter(|&i| asked(i) && share(i) < STUCK.wheels);
    // Between two commands that change their sign wheels turn as commanded: no stretch reaches across that.
    let stretches = pieces(&run.time, held, STUCK.mean);
    let told = |rows: Vec<usize>| {
        let interval = [run.time[*rows.first()?], run.time[*rows.last()?]];
        let load = mean(rows.iter().map(|&i| most(&run.torque, i)))?;
        let wheels = mean(rows.iter().map(|&i| share(i)))?;
        let lasts = rows.len() as f64 * run.period() >= STUCK.least_seconds;
        (lasts && (load > usual || load < STUCK.off * usual)).then(|| Standstill {
            recording: run.name.clone(),
            interval,
            share: None,
            wheels: Some(wheels),
            side: None,
            load,
            is_off: false,
            straight: straight(run),
        })
    };
    stretches.into_iter().filter_map(told).collect()
}

/// Torque of a side in straight driving with motors that are not switched off, median, N m.
fn straight(run: &SpeedRun) -> Option<f64> {
    let is_straight =
        |i: &usize| run.forward(*i).abs() > CHANGES.pieces.driving && run.difference(*i).abs() < MEASURING.turns.steady;
    let rows = (0..run.time.len()).filter(is_straight);
    let torques: Vec<f64> = rows.flat_map(|i| [run.torque[0][i].abs(), run.torque[1][i].abs()]).collect();
    let large = quantile(&sorted(torques.clone()), STUCK.large)?;
    median(torques.into_iter().filter(|torque| *torque >= STUCK.off * large))
}

/// A stretch in which motors give no torque begins and ends with that, whatever else shows it.
fn while_off(run: &SpeedRun, s: Standstill) -> Standstill {
    let Some(least) = s.straight.map(|straight| STUCK.off * straight).filter(|least| s.load < *least) else { return s };
    let is_off = |i: &usize| (0..2).all(|j| run.torque[j][*i].abs() < least);
    let off = pieces(&run.time, (0..run.time.len()).filter(is_off), STUCK.mean);
    let shared = |[from, until]: [f64; 2]| until.min(s.interval[1]) - from.max(s.interval[0]);
    let ends = off.iter().filter_map(|rows| Some([run.time[*rows.first()?], run.time[*rows.last()?]]));
    let longest = ends.filter(|ends| shared(*ends) > 0.0).max_by(|a, b| shared(*a).total_cmp(&shared(*b)));
    let [from, until] = longest.unwrap_or(s.interval);
    Standstill { interval: [from.min(s.interval[0]), until.max(s.interval[1])], is_off: true, ..s }
}

/// Finds where the bodies of these recordings stand, and marks the rows: they leave all else.
pub(crate) fn mark(runs: &mut [SpeedRun], track: f64) -> Vec<Standstill> {
    let mut out = Vec::new();
    for run in runs {
        let mut found = standstills(run, track);
        found.extend(held_wheels(run));
        let mut found: Vec<Standstill> = found.into_iter().map(|s| while_off(run, s)).collect();
        found.dedup_by(|next, s| next.interval == s.interval);
        let stands = |t: f64| found.iter().any(|s| s.interval[0] <= t && t <= s.interval[1]);
        for (standing, t) in run.standing.iter_mut().zip(&run.time) {
            *standing |= stands(*t);
        }
        out.extend(found);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::tests::{CONSTANT, GROUND, Ground, RADIUS, recording};
    use crate::testing::{Leg, drive, value};

    const SPIN: [f64; 2] = [-0.2, 0.2];
    const AHEAD: [f64; 2] = [0.5, 0.5];

    fn run(track: f64, legs: &[([f64; 2], f64)]) -> SpeedRun {
        SpeedRun::new(&recording(Ground { track, ..GROUND }, legs, None), RADIUS, CONSTANT).expect("a run")
    }

    #[test]
    fn a_body_that_does_not_turn_is_told_from_one_that_does() {
        let legs = [(AHEAD, 5.0), (SPIN, 8.0), (AHEAD, 5.0)];
        assert_eq!(standstills(&run(GROUND.track, &legs), GROUND.track), []);
        // A third of the expected rate is what dug-in wheels drag a body along with.
        for (track, share) in [(100.0, 0.05), (GROUND.track / 0.3, 0.31)] {
            let found = standstills(&run(track, &legs), GROUND.track);
            assert_eq!(found.len(), 1, "{found:?}");
            let [from, until] = found[0].interval;
            assert!((4.8..5.6).contains(&from) && (12.5..13.1).contains(&until), "{found:?}");
            assert!(found[0].share.is_some_and(|s| s < share));
        }
        assert_eq!(standstills(&run(GROUND.track / 0.4, &legs), GROUND.track), []);
    }

    #[test]
    fn what_is_driven_between_two_vain_turns_stands_too_and_a_turn_that_succeeds_ends_it() {
        let legs = [(AHEAD, 5.0), (SPIN, 5.0), (AHEAD, 3.0), ([0.2, -0.2], 5.0), (AHEAD, 5.0)];
        let found = standstills(&run(100.0, &legs), GROUND.track);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(found[0].interval[1] > 17.0, "{found:?}");
    }

    #[test]
    fn wheels_that_are_held_and_motors_that_are_off_are_found_by_their_commands() {
        let mut run = drive(&[Leg::straight(30.0), Leg::straight(10.0), Leg::straight(30.0)], false);
        let still = |t: f64| (30.0..40.0).contains(&t);
        run.commanded = Some(run.speed.clone());
        for i in 0..run.time.len() {
            if still(run.time[i]) {
                run.speed.iter_mut().for_each(|side| side[i] *= 0.05);
                run.torque.iter_mut().for_each(|side| side[i] *= 8.0);
            }
        }
        let found = held_wheels(&run);
        assert_eq!(found.len(), 1, "{found:?}");
        let [from, until] = found[0].interval;
        assert!((29.9..30.5).contains(&from) && (39.5..40.1).contains(&until), "{found:?}");
        assert!(found[0].wheels.is_some_and(|share| (share - 0.05).abs() < 0.01) && found[0].load > 30.0, "{found:?}");
        let marked = &mut [run.clone()];
        assert_eq!(mark(marked, GROUND.track).len(), 1);
        assert!(marked[0].standing.iter().zip(&marked[0].time).all(|(stands, t)| !still(*t) || *stands));

        // Wheels of one side that are held are told with that side.
        let mut one = run.clone();
        if let Some([left, _]) = &one.commanded {
            one.speed[0].clone_from(left);
        }
        let found = held_wheels(&one);
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!(found[0].side.as_deref(), Some("right"), "{found:?}");

        let mut off = run.clone();
        for i in 0..off.time.len() {
            off.torque.iter_mut().for_each(|side| side[i] *= if still(off.time[i]) { 0.0 } else { 1.0 });
        }
        let found = mark(&mut [off], GROUND.track);
        assert!(found.len() == 1 && found[0].is_off, "{found:?}");
        assert_eq!(held_wheels(&SpeedRun { commanded: None, ..run }), []);
    }

    #[test]
    fn motors_that_are_off_are_told_from_the_first_to_the_last_row_without_torque() {
        let legs = [(AHEAD, 10.0), (SPIN, 8.0), (AHEAD, 10.0)];
        let mut off = run(100.0, &legs);
        let is_off = |t: f64| (6.0..25.0).contains(&t);
        for i in 0..off.time.len() {
            off.torque.iter_mut().for_each(|side| side[i] *= if is_off(off.time[i]) { 0.0 } else { 1.0 });
        }
        let found = mark(&mut [off], GROUND.track);
        assert!(found.len() == 1 && found[0].is_off, "{found:?}");
        let [from, until] = found[0].interval;
        assert!((5.9..6.3).contains(&from) && (24.7..25.1).contains(&until), "{found:?}");
    }

    #[test]
    fn rows_of_a_body_that_stands_leave_loads_and_track() {
        let turning = [(AHEAD, 10.0), (SPIN, 8.0), (AHEAD, 10.0), ([0.2, -0.2], 8.0), (AHEAD, 10.0)];
        let mut both = run(GROUND.track, &turning);
        let until = both.time.partition_point(|t| *t < 30.0);
        // In its first turn the body stands, and the wheels dig with three times the torque.
        for i in 0..until {
            if both.difference(i) > 0.1 {
                if let Some(yaw) = both.yaw_rate.as_mut() {
                    yaw[i] *= 0.1;
                }
                both.torque.iter_mut().for_each(|side| side[i] *= 3.0);
            }
        }
        let spin = 0.5 * GROUND.straight + GROUND.turning;
        assert!(value(&both, Quantity::SpinSum).is_some_and(|s| s > 1.5 * spin));
        let mut runs = [both];
        assert_eq!(mark(&mut runs, GROUND.track).len(), 1);
        assert!(value(&runs[0], Quantity::SpinSum).is_some_and(|s| (s / spin - 1.0).abs() < 0.01));
        assert!(value(&runs[0], Quantity::EffectiveTrack).is_none_or(|b| (b / GROUND.track - 1.0).abs() < 0.05));
    }
}
