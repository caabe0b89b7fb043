//! Turning rates and level of the body, as its gyro and accelerometer show them.

use inference::interpolate;
use inference::robust::mean;
use recordings::{Recording, Signal};

use crate::clock;
use crate::settings::{MEASURING, measuring::Rows};
use crate::stamps::{origin, samples};

const ROWS: Rows = MEASURING.rows;

/// Turning rates of the body, averaged over steps.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyRates {
    /// Middle of each step on the gyro's clock, s.
    pub time: Vec<f64>,
    /// Length of a step, s.
    pub step: f64,
    /// About the forward, left and upward axis, rad/s.
    pub rate: [Vec<f64>; 3],
    /// Nose up by the accelerometer, averaged and less what the set speeds accelerate, rad; `None` without one, or with one
    /// that does not stand upright.
    pub level: Option<Vec<f64>>,
    /// How well it is known how the accelerometer leans in the body, one sigma, rad.
    pub level_sigma: f64,
    /// Whether the robot stood long enough to show what the gyro reads at rest.
    pub is_zero_known: bool,
}

impl BodyRates {
    pub(crate) fn new(recording: &Recording) -> Option<Self> {
        let axes = [Signal::GyroX, Signal::GyroY, Signal::GyroZ].map(|s| recording.get(s));
        let [Some(x), Some(y), Some(z)] = axes else { return None };
        let origin = origin(recording);
        let (time, _) = samples(z, origin);
        let (first, last) = (*time.first()?, *time.last()?);
        if ((last - first) / ROWS.rate_step) as usize > ROWS.sparse * time.len() {
            return None;
        }
        let grid: Vec<f64> =
            (0..=((last - first) / ROWS.rate_step) as usize).map(|k| first + k as f64 * ROWS.rate_step).collect();
        let rate = [x, y, z].map(|channel| {
            let (t, values) = samples(channel, origin);
            let mean = clock::box_mean(&t, values, ROWS.rate_step);
            grid.iter().map(|&at| interpolate(&t, &mean, at)).collect()
        });
        Some(Self {
            time: grid,
            step: ROWS.rate_step,
            rate,
            level: None,
            level_sigma: MEASURING.mounting.known,
            is_zero_known: false,
        })
    }

    /// Takes off what the gyro reads of pitching and rolling while the robot stands, `rests` from and until on its clock, s: it would add
    /// up to a slope. A small offset the filter finds itself, and a short rest hardly knows.
    pub(crate) fn take_offsets_off(&mut self, rests: &[[f64; 2]]) {
        let is_at_rest = |at: &f64| rests.iter().any(|[from, until]| (*from..=*until).contains(at));
        let still: Vec<usize> = (0..self.time.len()).filter(|&k| is_at_rest(&self.time[k])).collect();
        if (still.len() as f64) * self.step < ROWS.rest_least {
            return;
        }
        self.is_zero_known = true;
        for rate in &mut self.rate[..2] {
            let offset = mean(still.iter().map(|&k| rate[k])).filter(|offset| offset.abs() > ROWS.rest_offset);
            for rate in rate.iter_mut() {
                *rate -= offset.unwrap_or(0.0);
            }
        }
    }
}

/// Nose up at the steps of the gyro's clock, rad, from the specific force along the body; `rows` are times on that clock,
/// s, `forward` the speed then, m/s.
pub(crate) fn level(recording: &Recording, [rows, forward]: [&Vec<f64>; 2], at: &[f64]) -> Option<Vec<f64>> {
    let force = recording.get(Signal::AccelX)?;
    let upward = recording.get(Signal::AccelZ).and_then(|c| mean(c.values().iter().copied()));
    if upward.is_some_and(|g| (g / ROWS.gravity - 1.0).abs() > ROWS.upright) {
        return None;
    }
    let (t, values) = samples(force, origin(recording));
    let smooth = clock::box_mean(&t, values, ROWS.level_mean);
    let speed = |at: f64| interpolate(rows, forward, at);
    let half = 0.5 * ROWS.level_mean;
    let of_step = |&at: &f64| {
        let gained = (speed(at + half) - speed(at - half)) / ROWS.level_mean;
        ((interpolate(&t, &smooth, at) - gained) / ROWS.gravity).clamp(-1.0, 1.0).asin()
    };
    Some(at.iter().map(of_step).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A gyro with offsets, at rest for two seconds, then over a bump that it comes down from.
    fn rates(offsets: [f64; 3]) -> BodyRates {
        let time: Vec<f64> = (0..600).map(|k| 0.1 * f64::from(k)).collect();
        let bump = |t: f64| {
            if (20.0..40.0).contains(&t) { 0.1 * (0.1 * std::f64::consts::PI * (t - 20.0)).sin() } else { 0.0 }
        };
        let rate = offsets.map(|offset| time.iter().map(|t| bump(*t) + offset).collect());
        BodyRates { time, step: 0.1, rate, level: None, level_sigma: MEASURING.mounting.known, is_zero_known: false }
    }

    fn means(offsets: [f64; 3], rests: &[[f64; 2]]) -> [f64; 3] {
        let mut off = rates(offsets);
        off.take_offsets_off(rests);
        let right = rates([0.0; 3]);
        [0, 1, 2].map(|axis| off.rate[axis][0] - right.rate[axis][0])
    }

    #[test]
    fn what_a_gyro_reads_of_pitching_and_rolling_at_rest_is_taken_off() {
        assert!(means([0.02, -0.025, 0.0], &[[0.0, 2.0]]).iter().all(|m| m.abs() < 1e-12));
        // Its yaw rate is compared with the wheels, small offsets are found beside the slope, and a short rest tells none.
        assert_eq!(means([0.0, 0.002, 0.03], &[[0.0, 2.0]]), [0.0, 0.002, 0.03]);
        assert_eq!(means([0.02, -0.025, 0.0], &[[0.0, 1.0]]), [0.02, -0.025, 0.0]);
        assert_eq!(means([0.02, -0.025, 0.0], &[]), [0.02, -0.025, 0.0]);
    }
}
