//! A side that takes another torque from an instant on, until the recording ends: something drags on it, or its motor changed. Ground
//! lies under both sides, and drive trains warm up on both.

use inference::robust::{NINETY, mean, median};
use robot_model::effects::{coulomb_side, torque_constant_side};
use verdict::{LoadChange, Loads, SideChange, Word};

use crate::pieces::{GRADE, pieces};
use crate::run::SpeedRun;
use crate::settings::{CHANGES, MEASURING, changes::OneSide};
use crate::straight::is_straight;

const ONE_SIDE: OneSide = CHANGES.one_side;

/// A short stretch of straight driving: from, until, s, and the torque of each side in the direction of travel, N m.
#[derive(Debug, Clone, Copy)]
struct Stretch {
    interval: [f64; 2],
    torque: [f64; 2],
}

impl Stretch {
    fn difference(&self) -> f64 {
        self.torque[1] - self.torque[0]
    }

    fn middle(&self) -> f64 {
        f64::midpoint(self.interval[0], self.interval[1])
    }
}

/// Finds it in these recordings, and marks the rows from there on, whose straight load is that of the change; torques are known as well
/// as the torque per current, one sigma, relative.
pub(crate) fn mark(runs: &mut [SpeedRun], torque_sigma: f64) -> Vec<SideChange> {
    let mut out = Vec::new();
    for run in runs {
        let Some(mut found) = change(run) else { continue };
        let [before, after] = found.torque;
        found.half = found.half.hypot(NINETY * torque_sigma * (after - before));
        for (changed, t) in run.changed.iter_mut().zip(&run.time) {
            *changed |= *t >= found.onset[0];
        }
        out.push(found);
    }
    out
}

/// Drops what was found in the same rows by their loads alone.
pub(crate) fn drop_what_shows_it(loads: &mut Loads) {
    let sides = loads.side_changes.clone();
    let is_in = |recording: &str, from: f64| {
        sides.iter().any(|s| s.recording == recording && from >= s.onset[0] - ONE_SIDE.stretch)
    };
    loads.turning_changes.retain(|c| !is_in(&c.recording, c.interval[0]));
    loads.grounds.retain(|g| !is_in(&g.recording, g.interval[0]));
    let is_slope = |c: &LoadChange| c.causes == [GRADE] && !c.relative;
    loads.changes.found.retain(|c| is_slope(c) || !is_in(&c.recording, c.interval[0]));
}

fn change(run: &SpeedRun) -> Option<SideChange> {
    let all = stretches(run);
    let least = (ONE_SIDE.least / ONE_SIDE.stretch).ceil() as usize;
    let candidates = least..(all.len() + 1).saturating_sub(least);
    let scatter = |part: &[Stretch]| -> f64 {
        let middle = mean(part.iter().map(Stretch::difference)).unwrap_or(0.0);
        part.iter().map(|s| (s.difference() - middle).powi(2)).sum()
    };
    let left = |k: &usize| scatter(&all[..*k]) + scatter(&all[*k..]);
    let at = candidates.min_by(|a, b| left(a).total_cmp(&left(b)))?;

    // By how much each side changes; what both do is another speed, or the ground.
    let [before, after] = [&all[..at], &all[at..]];
    let of = |part: &[Stretch], side: usize| mean(part.iter().map(|s| s.torque[side])).unwrap_or(0.0);
    let by = [0, 1].map(|side| of(after, side) - of(before, side));
    let difference = by[1] - by[0];
    let usual = median(before.iter().map(|s| s.torque[0].abs() + s.torque[1].abs()))?;
    let sigma = (left(&at) / (all.len() - 2) as f64).sqrt().max(ONE_SIDE.floor * usual);
    if difference.abs() < (ONE_SIDE.clear * sigma).max(ONE_SIDE.share * usual) {
        return None;
    }
    let side = usize::from(by[1].abs() > by[0].abs());
    if by[1 - side].abs() > ONE_SIDE.other * by[side].abs() {
        return None;
    }
    let error = sigma * (1.0 / before.len() as f64 + 1.0 / after.len() as f64).sqrt();
    Some(SideChange {
        recording: run.name.clone(),
        side: ["left", "right"][side].into(),
        // A stretch in which it begins is counted before or after.
        onset: [before.last()?.middle(), after.first()?.middle()],
        until: after.last()?.interval[1],
        // What both sides do is another speed.
        torque: [of(before, side), of(after, side) - by[1 - side]],
        half: NINETY * error,
        causes: causes([of(before, side), of(after, side)]),
    })
}

/// What makes a side take another torque: a brake takes more, and a motor gives another torque for its current.
fn causes([before, after]: [f64; 2]) -> Vec<Word> {
    let [least, most] = torque_constant_side::SPEC.parameters[0].bounds;
    let is_motor = before * after > 0.0 && (least..=most).contains(&(before / after - 1.0));
    let brake = (after > before).then(|| coulomb_side::SPEC.id.into());
    let all: Vec<Word> = brake.into_iter().chain(is_motor.then(|| torque_constant_side::SPEC.id.into())).collect();
    // A brake that lets go takes less.
    if all.is_empty() { vec![coulomb_side::SPEC.id.into()] } else { all }
}

/// Straight driving in which both sides read, cut into short stretches.
fn stretches(run: &SpeedRun) -> Vec<Stretch> {
    let reads = |i: &usize| {
        !run.standing[*i]
            && (0..2).all(|side| run.reads(*i, side))
            && is_straight(run, *i, MEASURING.straight.hold_of_means)
    };
    let period = run.period();
    let rows = ((ONE_SIDE.stretch / period.max(f64::EPSILON)).round() as usize).max(1);
    let torque = |i: usize, side: usize| {
        let torque = run.torque[side][i];
        if run.magnitude_only { torque.abs() } else { torque * run.speed[side][i].signum() }
    };
    let all = pieces(&run.time, (0..run.time.len()).filter(reads), MEASURING.stretches.gap);
    let of = |rows: &[usize]| -> Option<Stretch> {
        let torque = [0, 1].map(|side| mean(rows.iter().map(|&i| torque(i, side))));
        Some(Stretch {
            interval: [run.time[*rows.first()?], run.time[*rows.last()?]],
            torque: [torque[0]?, torque[1]?],
        })
    };
    all.iter().flat_map(|piece| piece.chunks_exact(rows)).filter_map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{Leg, drive};

    /// Straight driving, turns between it; the right side takes more from 100 s on.
    fn dragged(by: f64, until: f64) -> SpeedRun {
        let turn = Leg { speed: [0.15, 0.3], ..Leg::straight(8.0) };
        let legs = [Leg::straight(22.0), turn].repeat(6);
        let mut run = drive(&legs, false);
        for i in 0..run.time.len() {
            if (100.0..until).contains(&run.time[i]) {
                run.torque[1][i] += by;
            }
        }
        run
    }

    #[test]
    fn a_side_that_drags_until_the_end_is_found_with_its_instant_and_torque() {
        let found = change(&dragged(6.0, 1e9)).expect("a change");
        assert_eq!((found.side.as_ref(), found.until > 170.0), ("right", true));
        assert!(found.onset[0] > 96.0 && found.onset[1] < 104.0, "{found:?}");
        assert!(found.onset[0] <= 100.0 && 100.0 <= found.onset[1], "{found:?}");
        let by = found.torque[1] - found.torque[0];
        assert!((by - 6.0).abs() < 0.5, "{found:?}");

        let mut runs = [dragged(6.0, 1e9)];
        assert_eq!(mark(&mut runs, 0.0), [found]);
        assert!(
            runs[0]
                .changed
                .iter()
                .zip(&runs[0].time)
                .all(|(changed, t)| *changed == (*t > 98.0) || (96.0..104.0).contains(t))
        );
    }

    #[test]
    fn nothing_is_found_where_nothing_changes_or_both_sides_do_or_it_passes() {
        assert_eq!(change(&dragged(0.0, 1e9)), None);
        assert_eq!(change(&dragged(6.0, 130.0)), None);
        // The other side by half as much.
        let (mut both, half) = (dragged(12.0, 1e9), dragged(6.0, 1e9));
        both.torque[0].clone_from(&half.torque[1]);
        assert_eq!(change(&both), None);
    }
}
