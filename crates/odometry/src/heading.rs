//! A heading by a gyro in the place of a pose: how the body turns, and not where it is.

use crate::drive::Drive;
use crate::settings::{Heading, SETTINGS};

const RULES: Heading = SETTINGS.heading;

impl Drive {
    /// Takes the bias off a gyro's heading that it shows while no wheel turns, with a sentence on it.
    pub(crate) fn take_bias_off(&mut self) {
        let wheels = self.turns.first().map_or(0, Vec::len);
        let mut still = vec![true; self.time.len()];
        for wheel in 0..wheels {
            for (row, [rate]) in self.rates(|row| [self.turns[row][wheel]]).into_iter().enumerate() {
                still[row] &= rate.abs() < RULES.still;
            }
        }
        let (mut turned, mut rested) = (0.0, 0.0);
        for row in 1..self.time.len() {
            if still[row] && still[row - 1] && self.is_seen(row) && self.is_seen(row - 1) {
                turned += self.pose[row][2] - self.pose[row - 1][2];
                rested += self.time[row] - self.time[row - 1];
            }
        }
        if rested < RULES.least {
            return;
        }
        let (bias, start) = (turned / rested, self.time[0]);
        for (pose, time) in self.pose.iter_mut().zip(&self.time) {
            pose[2] -= bias * (time - start);
        }
        self.told.push(format!(
            "recording '{}': while the wheels stand, {rested:.0} s in all, the gyro shows {bias:.5} rad/s, which was taken off",
            self.name
        ));
    }

    /// By how far the wheel that turns most turns from one row to another, rad.
    pub(crate) fn rolled(&self, from: usize, to: usize) -> f64 {
        let wheels = self.turns.first().map_or(0, Vec::len);
        let of = |wheel: usize| self.turns[from + 1..=to].iter().map(|turns| turns[wheel].abs()).sum::<f64>();
        (0..wheels).map(of).fold(0.0, f64::max)
    }
}

/// Whether that is motion.
pub(crate) fn is_rolling(rolled: f64) -> bool {
    rolled > RULES.rolled
}
