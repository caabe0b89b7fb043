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
