//! What each row of straight driving says of the straight load.

use crate::run::SpeedRun;
use crate::settings::{MEASURING, measuring::Straight};

const STRAIGHT: Straight = MEASURING.straight;

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
            return Reading::Exact((torque[0] + torque[1]) * run.speed[0][i].signum());
        }
        // What does not read adds at most the dead band.
        let sum = (0..2).map(|j| if run.reads(i, j) { torque[j].abs() } else { run.dead_band }).sum();
        if run.reads(i, 0) && run.reads(i, 1) { Reading::Exact(sum) } else { Reading::AtMost(sum) }
    };
    (0..run.time.len()).map(|i| is_straight(run, i, STRAIGHT.hold).then(|| of_row(i))).collect()
}

/// Both sides in the dead band.
pub(crate) fn reads_nothing(run: &SpeedRun, i: usize) -> bool {
    run.magnitude_only && !run.reads(i, 0) && !run.reads(i, 1)
}
