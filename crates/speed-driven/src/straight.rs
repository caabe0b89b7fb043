//! What each row of straight driving says of the straight load.

use crate::pieces::pieces;
use crate::run::SpeedRun;
use crate::settings::{MEASURING, measuring::Straight, measuring::Unwinding};
use inference::robust::mean;

const STRAIGHT: Straight = MEASURING.straight;
const UNWINDING: Unwinding = MEASURING.unwinding;

/// The straight load at a row: the sum of both sides' torques in the direction of travel, N m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Reading {
    /// Both sides read.
    Exact(f64),
    /// A side sits in the dead band, where a side that is dragged or wound up after a turn also shows.
    AtMost(f64),
}

impl Reading {
    pub(crate) fn value(self) -> f64 {
        match self {
            Self::Exact(x) | Self::AtMost(x) => x,
        }
    }

    pub(crate) fn is_exact(self) -> bool {
        matches!(self, Self::Exact(_))
    }
}

/// Whether a row is driven straight and has been so for `hold` seconds.
pub(crate) fn is_straight(run: &SpeedRun, i: usize, hold: f64) -> bool {
    let (l, r) = (run.speed[0][i], run.speed[1][i]);
    l * r > 0.0
        && l.abs().min(r.abs()) >= STRAIGHT.least_speed
        && (r - l).abs() <= STRAIGHT.difference
        && run.held(i, STRAIGHT.steady, hold * run.patience())
}

/// The straight load row by row; `None` where the drive is not straight or not steady.
pub(crate) fn readings(run: &SpeedRun) -> Vec<Option<Reading>> {
    let of_row = |i: usize| {
        let torque = [run.torque[0][i], run.torque[1][i]];
        if !run.magnitude_only {
            let sum = (torque[0] + torque[1]) * run.speed[0][i].signum();
            let unread = (0..2).filter(|&j| !run.reads(i, j)).count() as f64;
            return if unread > 0.0 { Reading::AtMost(sum + unread * run.hidden) } else { Reading::Exact(sum) };
        }
        // What does not read adds at most what is hidden.
        let sum = (0..2).map(|j| if run.reads(i, j) { torque[j].abs() } else { run.hidden }).sum();
        if run.reads(i, 0) && run.reads(i, 1) { Reading::Exact(sum) } else { Reading::AtMost(sum) }
    };
    let mut out: Vec<Option<Reading>> =
        (0..run.time.len()).map(|i| is_straight(run, i, STRAIGHT.hold).then(|| of_row(i))).collect();
    if run.magnitude_only {
        let seen: Vec<usize> = (0..out.len()).filter(|&i| out[i].is_some()).collect();
        // Measured speeds scatter: a row that is not straight for once, and the time after it until one counts, do not end a
        // stretch.
        for stretch in pieces(&run.time, seen.into_iter(), 2.0 * STRAIGHT.hold) {
            for &i in unwinding(run, &stretch) {
                out[i] = out[i].map(|r| Reading::AtMost(r.value()));
            }
        }
    }
    out
}

/// The first rows of a straight stretch in which one side brakes although both read: a slow speed controller holds after a turn what
/// it needed in it, and lets go over seconds. Then the load is the difference of the sides, which stays, and not their sum,
/// which falls. Empty where that does not show.
fn unwinding<'a>(run: &SpeedRun, stretch: &'a [usize]) -> &'a [usize] {
    let reads = |i: &&usize| {
        run.reads(**i, 0) && run.reads(**i, 1) && run.time[**i] - run.time[stretch[0]] <= UNWINDING.longest
    };
    let rows = &stretch[..stretch.iter().take_while(reads).count()];
    let third = rows.len() / 3;
    if third == 0 {
        return &[];
    }

    let side = |j: usize, rows: &[usize]| mean(rows.iter().map(|&i| run.torque[j][i].abs())).unwrap_or(0.0);
    let [first, all, last] = [&rows[..third], rows, &rows[rows.len() - third..]].map(|r| [0, 1].map(|j| side(j, r)));
    let larger = usize::from(all[1] > all[0]);
    let sum = |[left, right]: [f64; 2]| left + right;
    let difference = |of: [f64; 2]| of[larger] - of[1 - larger];
    let fall = sum(first) - sum(last);
    let differs = all[1 - larger] <= UNWINDING.sides * all[larger];
    let falls = fall >= UNWINDING.fall * difference(all);
    let stays = (difference(first) - difference(last)).abs() <= UNWINDING.steady * fall;
    if differs && falls && stays { rows } else { &[] }
}

/// Both sides in the dead band.
pub(crate) fn reads_nothing(run: &SpeedRun, i: usize) -> bool {
    !run.reads(i, 0) && !run.reads(i, 1)
}
