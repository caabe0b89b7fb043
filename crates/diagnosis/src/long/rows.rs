//! A piece of a recording as rows of signals on a common grid.

use std::array::from_fn;

use recordings::{Channel, Recording, Signal};

use crate::grid::{binned, slope};
use crate::settings::{Raster, SETTINGS};

/// Signals of a row: what drives each side, wheel speeds, wheel accelerations, directions, yaw rate, specific force, one.
pub(super) const SIGNALS: usize = 12;
/// Places of a row's signals.
pub(super) const DRIVE: [usize; 2] = [0, 1];
pub(super) const SPEED: [usize; 2] = [2, 3];
pub(super) const RATE: [usize; 2] = [4, 5];
pub(super) const DIRECTION: [usize; 2] = [6, 7];
pub(super) const GYRO: usize = 8;
pub(super) const ACCEL: [usize; 2] = [9, 10];
pub(super) const ONE: usize = 11;

const RASTER: Raster = SETTINGS.grid;

/// What drives the wheels: the first pair that a recording has.
const DRIVES: [[Signal; 2]; 3] = [
    [Signal::TorqueLeft, Signal::TorqueRight],
    [Signal::CurrentLeft, Signal::CurrentRight],
    [Signal::CommandSpeedLeft, Signal::CommandSpeedRight],
];

/// Which signals a recording has, and how fine they are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Grid {
    drive: [Signal; 2],
    /// Wheel speeds come from angles.
    by_angle: bool,
    pub(super) gyro: bool,
    pub(super) accel: bool,
    /// Time between rows, s.
    pub(super) period: f64,
}

impl Grid {
    /// The grid for a recording; `None` when it has neither a drive nor wheels.
    pub(super) fn new(recording: &Recording) -> Option<Self> {
        let has = |signal: Signal| recording.get(signal).is_some_and(|c| c.len() > 1);
        let drive = DRIVES.into_iter().find(|pair| pair.iter().all(|&s| has(s)))?;
        let by_angle = has(Signal::WheelAngleLeft) && has(Signal::WheelAngleRight);
        if !(by_angle || has(Signal::WheelSpeedLeft) && has(Signal::WheelSpeedRight)) {
            return None;
        }
        let mut grid = Self { drive, by_angle, gyro: has(Signal::GyroZ), accel: false, period: RASTER.finest };
        grid.accel = has(Signal::AccelX) && has(Signal::AccelY);
        let spacing = grid.signals().filter_map(|s| recording.get(s)).map(spacing).fold(RASTER.finest, f64::max);
        grid.period = spacing.min(RASTER.coarsest);
        Some(grid)
    }

    fn wheels(&self) -> [Signal; 2] {
        if self.by_angle {
            [Signal::WheelAngleLeft, Signal::WheelAngleRight]
        } else {
            [Signal::WheelSpeedLeft, Signal::WheelSpeedRight]
        }
    }

    fn signals(&self) -> impl Iterator<Item = Signal> {
        let gyro = self.gyro.then_some(Signal::GyroZ);
        let accel = [Signal::AccelX, Signal::AccelY].into_iter().filter(|_| self.accel);
        self.drive.into_iter().chain(self.wheels()).chain(gyro).chain(accel)
    }

    /// Rows of a piece; NaN where a signal is missing for long.
    pub(super) fn rows(&self, piece: &Recording) -> Vec<f64> {
        let spans = self.signals().filter_map(|s| piece.get(s)?.span_ns());
        let Some((from_ns, until_ns)) = spans.reduce(|a, b| (a.0.max(b.0), a.1.min(b.1))) else { return Vec::new() };
        let step_ns = self.period * 1e9;
        let count = ((until_ns - from_ns) as f64 / step_ns).max(0.0) as usize;
        let column = |signal: Signal| {
            piece.get(signal).map_or_else(|| vec![f64::NAN; count], |c| binned(c, from_ns, step_ns, count))
        };
        let drive = self.drive.map(column);
        let wheels = self.wheels().map(column);
        let speed = if self.by_angle { wheels.map(|a| slope(&a, self.period)) } else { wheels };
        let rate: [Vec<f64>; 2] = from_fn(|j| slope(&speed[j], self.period));
        let gyro = if self.gyro { column(Signal::GyroZ) } else { vec![0.0; count] };
        let accel = [Signal::AccelX, Signal::AccelY].map(|s| if self.accel { column(s) } else { vec![0.0; count] });
        let mut rows = vec![0.0; count * SIGNALS];
        for (k, row) in rows.chunks_exact_mut(SIGNALS).enumerate() {
            for j in 0..2 {
                row[DRIVE[j]] = drive[j][k];
                row[SPEED[j]] = speed[j][k];
                row[RATE[j]] = rate[j][k];
                row[DIRECTION[j]] = (speed[j][k] / RASTER.at_rest).tanh();
                row[ACCEL[j]] = accel[j][k];
            }
            row[GYRO] = gyro[k];
            row[ONE] = 1.0;
        }
        rows
    }
}

/// Usual time between samples, s.
fn spacing(channel: &Channel) -> f64 {
    let mut gaps: Vec<i64> = channel.t_ns().windows(2).take(RASTER.spacings).map(|w| w[1] - w[0]).collect();
    let middle = gaps.len() / 2;
    if gaps.is_empty() { RASTER.coarsest } else { *gaps.select_nth_unstable(middle).1 as f64 * 1e-9 }
}
