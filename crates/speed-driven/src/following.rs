//! Sides that do not turn as they are commanded to, while the body moves with them: motors that give too little torque.
//!
//! Steady loads are measured at the speeds that were driven, so that they stay right; but a drive that does not do what it is told is
//! a finding of its own. Where its torque is the same in all these stretches and larger nowhere, the motor is at its limit: folded back
//! for heat, limited by its controller, or fed by too low a voltage. A side that hardly turns at all is held (`standstill`), and an
//! encoder that shows a speed that the body does not have is wrong (`encoders`); both have been marked before.

use std::collections::BTreeMap;

use catalogue::answer::UNKNOWN;
use inference::robust::{MAD_TO_SIGMA, NINETY, median, median_absolute_deviation, quantile, sorted};
use robot_model::effects::torque_saturation;
use verdict::{Cause, Unfollowed};

use crate::encoders::{followed, usual};
use crate::pieces::pieces;
use crate::run::SpeedRun;
use crate::settings::{CHANGES, changes::Following};
use crate::words::recordings;

const FOLLOWING: Following = CHANGES.following;

/// Sides of the recordings that do not follow, though those of the references do; torques may be off by a share `scale_sigma`. Without references only a motor at its limit counts.
pub(crate) fn unfollowed(references: &[SpeedRun], recordings: &[SpeedRun], scale_sigma: f64) -> Vec<Unfollowed> {
    let usual = usual(if references.is_empty() { recordings } else { references });
    let share_of = |runs: &[SpeedRun], side: usize| {
        let settled: usize =
            runs.iter().map(|run| (0..run.time.len()).filter(|&i| followed(run, i).is_some()).count()).sum();
        let off: usize = runs.iter().map(|run| rows(run, side, usual).len()).sum();
        off as f64 / settled.max(1) as f64
    };
    let is_new = |side: &usize| share_of(references, *side) <= FOLLOWING.usual * share_of(recordings, *side);
    let told = |side: usize| {
        of_side(recordings, side, (usual, scale_sigma)).filter(|u| u.is_limited || !references.is_empty())
    };
    (0..2).filter(is_new).filter_map(told).collect()
}

/// Rows at which what is commanded has settled and a side turns otherwise.
fn rows(run: &SpeedRun, side: usize, usual: f64) -> Vec<usize> {
    let is_off = |i: &usize| followed(run, *i).is_some_and(|shares| (shares[side] / usual - 1.0).abs() > FOLLOWING.off);
    (0..run.time.len()).filter(is_off).collect()
}

fn of_side(runs: &[SpeedRun], side: usize, (usual, scale_sigma): (f64, f64)) -> Option<Unfollowed> {
    let all: Vec<(&SpeedRun, Vec<Vec<usize>>)> =
        runs.iter().map(|run| (run, pieces(&run.time, rows(run, side, usual).into_iter(), FOLLOWING.apart))).collect();
    let off = || all.iter().flat_map(|(run, stretches)| stretches.iter().flatten().map(move |&i| (*run, i)));
    let seconds: f64 = off().map(|(run, _)| run.period()).sum();
    if seconds < FOLLOWING.least {
        return None;
    }

    // A limit is one torque in all stretches, and none beside them is larger from the first of them on.
    let torques: Vec<f64> = off().map(|(run, i)| run.torque[side][i].abs()).collect();
    let torque = median(torques.iter().copied())?;
    let scatter = MAD_TO_SIGMA * median_absolute_deviation(&torques)?;
    let is_largest = all.iter().all(|(run, stretches)| {
        let ends = stretches.first().and_then(|s| s.first()).zip(stretches.last().and_then(|s| s.last()));
        let Some((&first, &last)) = ends else { return true };
        let given = quantile(&sorted(run.torque[side][first..=last].iter().map(|t| t.abs())), CHANGES.standstill.large);
        given.is_none_or(|given| given <= FOLLOWING.most * torque)
    });

    let share = |(run, i): (&SpeedRun, usize)| followed(run, i).map(|shares| shares[side] / usual);
    let shares = sorted(off().filter_map(share));
    let mut intervals: BTreeMap<String, Vec<[f64; 2]>> = BTreeMap::new();
    for (run, stretches) in all.iter().filter(|(_, stretches)| !stretches.is_empty()) {
        let ends = stretches.iter().filter_map(|rows| Some([run.time[*rows.first()?], run.time[*rows.last()?]]));
        intervals.insert(run.name.clone(), ends.collect());
    }
    Some(Unfollowed {
        intervals,
        seconds,
        side: inference::words::side(side).into(),
        share: [quantile(&shares, 1.0 - FOLLOWING.shares)?, quantile(&shares, FOLLOWING.shares)?],
        torque,
        // Rows of one second say the same.
        half: NINETY * (scatter / seconds.max(1.0).sqrt()).hypot(scale_sigma * torque),
        is_limited: torque > 0.0 && scatter <= FOLLOWING.level * torque && is_largest,
    })
}

/// Its cause: a motor at its limit, or none that is listed.
pub(crate) fn cause(u: &Unfollowed, probability: f64) -> Cause {
    let (id, name) = if u.is_limited {
        (torque_saturation::SPEC.id, format!("{}: {}", torque_saturation::SPEC.name, u.side))
    } else {
        (UNKNOWN.id, UNKNOWN.name.to_owned())
    };
    Cause {
        magnitude: u.is_limited.then_some(u.torque),
        sigma: u.is_limited.then_some(u.half / NINETY),
        unit: torque_saturation::SPEC.parameters[0].unit.into(),
        side: Some(u.side.clone()),
        intervals: Some(u.intervals.clone()),
        ..Cause::plain(id, &name, probability)
    }
}

/// What is said of it, and what to do.
pub(crate) fn told(u: &Unfollowed) -> String {
    let Unfollowed { side, share: [least, most], torque, half, seconds, .. } = u;
    let stretches = u.intervals.iter().map(|(name, all)| {
        let all: Vec<String> = all.iter().map(|[from, until]| format!("{from:.1}-{until:.1} s")).collect();
        format!("{} {}", recordings(name), all.join(", "))
    });
    let stretches: Vec<String> = stretches.collect();
    let why = if u.is_limited {
        "that is the same in all of these stretches, and it gives no more beside them: the motor is at a limit (of its \
         controller, by heat, or by a low supply). Look at the drive; the simulation needs this limit, not another ground"
    } else {
        "which is no one value: look at the drive, at what it pushes against, and at whether something else commanded it, before you change \
         the simulation"
    };
    format!(
        "Commands are not followed: in {} the {side} side turns at {least:.2} to {most:.2} times the speed that is commanded, {seconds:.0} s in \
         all, which the references do not show. Its torque is {torque:.2} ± {half:.2} N m (90 %), {why}.",
        stretches.join("; in ")
    )
}

#[cfg(test)]
mod tests {
    use std::slice;

    use super::*;
    use crate::testing::{Leg, drive};

    /// Straight on, turns both ways, straight on; the left side gives so much torque at most, N m, and turns slower where it needs more.
    fn limited(most: f64) -> SpeedRun {
        let right = Leg { speed: [0.3, 0.15], ..Leg::straight(12.0) };
        let legs = [Leg::straight(20.0), Leg::turn(12.0), Leg::straight(12.0), right, Leg::straight(20.0)];
        let mut run = drive(&legs, false);
        run.commanded = Some(run.speed.clone());
        for i in 0..run.time.len() {
            if run.torque[0][i] > most {
                run.torque[0][i] = most + 0.1 * [1.0, -1.0, 0.0][i % 3];
                run.speed[0][i] *= 0.4;
            }
        }
        run
    }

    #[test]
    fn a_motor_at_its_limit_is_told_with_its_torque_and_one_that_follows_is_not() {
        let free = limited(f64::INFINITY);
        assert_eq!(unfollowed(slice::from_ref(&free), slice::from_ref(&free), 0.05), []);
        let found = unfollowed(slice::from_ref(&free), &[limited(9.0)], 0.05);
        let [u] = &found[..] else { panic!("{found:?}") };
        assert_eq!((u.side.as_ref(), u.is_limited), ("left", true), "{found:?}");
        assert!((u.torque - 9.0).abs() < 0.2 && (u.share[0] - 0.4).abs() < 0.05, "{found:?}");
        assert_eq!(cause(u, 0.9).effect, "torque_saturation");
        // Without references a limit is one all the same; as references have it, it is how this robot drives.
        assert_eq!(unfollowed(&[], &[limited(9.0)], 0.05), found);
        assert_eq!(unfollowed(&[limited(9.0)], &[limited(9.0)], 0.05), []);
    }

    #[test]
    fn a_side_that_does_not_follow_at_any_torque_is_told_without_a_cause_and_only_beside_references() {
        let free = limited(f64::INFINITY);
        let mut slow = free.clone();
        let straight = |i: &usize| (5.0..15.0).contains(&free.time[*i]);
        for i in (0..free.time.len()).filter(straight) {
            slow.speed[0][i] *= 0.5;
        }
        let found = unfollowed(&[free], &[slow.clone()], 0.05);
        assert!(matches!(&found[..], [u] if !u.is_limited && cause(u, 0.9).effect == UNKNOWN.id), "{found:?}");
        assert_eq!(unfollowed(&[], &[slow], 0.05), []);
    }
}
