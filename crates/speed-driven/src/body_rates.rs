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
        Some(Self { time: grid, step: ROWS.rate_step, rate, level: None })
    }

    /// Takes off what the gyro reads while the robot stands, `rests` from and until on its clock, s: what would add up to a slope. Where it
    /// never does for long enough, the body cannot have pitched and rolled on without end: a mean over the whole recording that would
    /// have tilted it farther than any ground is an offset.
    pub(crate) fn take_offsets_off(&mut self, rests: &[[f64; 2]]) {
        let is_at_rest = |at: &f64| rests.iter().any(|[from, until]| (*from..=*until).contains(at));
        let still: Vec<usize> = (0..self.time.len()).filter(|&k| is_at_rest(&self.time[k])).collect();
        let is_known = still.len() as f64 * self.step >= ROWS.rest_least;
        let length = self.time.len() as f64 * self.step;
        for (axis, rate) in self.rate.iter_mut().enumerate() {
            let of_all = mean(rate.iter().copied()).filter(|all| axis < 2 && all.abs() * length > ROWS.tilted);
            let at_rest = mean(still.iter().map(|&k| rate[k])).filter(|_| is_known);
            let offset = at_rest.or(of_all).unwrap_or(0.0);
            rate.iter_mut().for_each(|rate| *rate -= offset);
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
        BodyRates { time, step: 0.1, rate, level: None }
    }

    #[test]
    fn what_a_gyro_reads_at_rest_is_taken_off() {
        let mut off = rates([0.02, -0.025, 0.03]);
        off.take_offsets_off(&[[0.0, 2.0]]);
        for (a, b) in off.rate.iter().flatten().zip(rates([0.0; 3]).rate.iter().flatten()) {
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
    }

    #[test]
    fn without_rest_an_offset_that_no_ground_could_make_is_taken_off_and_a_slower_one_is_not() {
        // Over a minute .02 rad/s would be 69 degrees, .005 rad/s 17.
        for (rests, is_short) in [(vec![], false), (vec![[0.0, 0.5]], true)] {
            let mut off = rates([0.02, 0.005, 0.02]);
            off.take_offsets_off(&rests);
            let means = off.rate.each_ref().map(|rate| mean(rate.iter().copied()).unwrap_or(f64::NAN));
            assert!(means[0].abs() < 1e-9, "{means:?} {is_short}");
            assert!((means[1] - 0.005).abs() < 1e-3 && (means[2] - 0.02).abs() < 1e-3, "turning is no tilt: {means:?}");
        }
    }
}
