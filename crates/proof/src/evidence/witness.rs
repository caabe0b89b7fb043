//! What the program did not see: tilt by the accelerometer, turning by the gyro, on the clock of the set speeds.

use std::path::Path;

use anyhow::{Context, Result, ensure};
use inference::interpolate;
use speed_driven::{align, box_mean};

use super::hide::Table;

/// The tilt is averaged over this long, s; the yaw rate over this long, s.
const TILT_MEAN: f64 = 2.0;
const YAW_MEAN: f64 = 0.31;
/// Tilt that counts, degrees, and for how long, s, with gaps up to, s.
const TILT: f64 = 2.0;
const LEAST: f64 = 5.0;
const GAP: f64 = 1.0;
/// Driving at least, m/s.
const DRIVING: f64 = 0.05;
const GRAVITY: f64 = 9.81;

/// The witness of a run, at the rows of its set speeds.
#[derive(Debug, Clone)]
pub(super) struct Witness {
    pub(super) time: Vec<f64>,
    /// Mean of the set speeds, m/s.
    pub(super) forward: Vec<f64>,
    /// Slope in the direction of travel, uphill positive, degrees.
    pub(super) slope: Vec<f64>,
    /// rad/s.
    pub(super) yaw_rate: Vec<f64>,
    /// Lag of the inertial unit's clock, s.
    pub(super) lag: Vec<f64>,
    /// Errors of the alignment on turns left out, s.
    pub(super) left_out: Vec<f64>,
}

/// A stretch in which the witness tilts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Tilted {
    pub(super) interval: [f64; 2],
    /// Mean slope in the direction of travel, degrees.
    pub(super) slope: f64,
}

impl Witness {
    /// Opens the envelope of a run.
    pub(super) fn open(speeds: &Path, inertial: &Path) -> Result<Self> {
        let (speeds, inertial) = (Table::read(speeds)?, Table::read(inertial)?);
        Self::of(&speeds, &inertial).context("the witness cannot be read")
    }

    pub(super) fn of(speeds: &Table, inertial: &Table) -> Result<Self> {
        let (time, left, right) = (speeds.column("time")?, speeds.column("velL")?, speeds.column("velR")?);
        let whole = |row: &&Vec<f64>| row.iter().all(|x| x.is_finite());
        let inertial =
            Table { columns: inertial.columns.clone(), rows: inertial.rows.iter().filter(whole).cloned().collect() };
        let (its_time, wz, ax) = (inertial.column("time")?, inertial.column("wz")?, inertial.column("ax")?);
        ensure!(!time.is_empty() && !its_time.is_empty(), "there is not a row in it");
        // Times count from the first stamp of both, as in the program's answers.
        let origin = time[0].min(its_time[0]);
        let [time, its_time] = [time, its_time].map(|t| t.iter().map(|x| x - origin).collect::<Vec<f64>>());
        let turning: Vec<f64> = right.iter().zip(&left).map(|(r, l)| r - l).collect();
        let forward: Vec<f64> = right.iter().zip(&left).map(|(r, l)| 0.5 * (r + l)).collect();
        let yaw = box_mean(&its_time, &wz, YAW_MEAN);
        let alignment = align(&time, &turning, &its_time, &yaw);
        let tilt = box_mean(&its_time, &ax, TILT_MEAN);
        let at = |z: &[f64]| -> Vec<f64> {
            time.iter().zip(&alignment.lag).map(|(t, lag)| interpolate(&its_time, z, t + lag)).collect()
        };
        let degrees = |(a, v): (&f64, &f64)| (a / GRAVITY).clamp(-1.0, 1.0).asin().to_degrees() * v.signum();
        let slope = at(&tilt).iter().zip(&forward).map(degrees).collect();
        Ok(Self { yaw_rate: at(&yaw), slope, forward, time, lag: alignment.lag, left_out: alignment.left_out })
    }

    /// Mean slope over an interval, degrees; `None` without a row in it.
    pub(super) fn mean_slope(&self, [from, until]: [f64; 2]) -> Option<f64> {
        let rows: Vec<f64> = (0..self.time.len())
            .filter(|&i| self.time[i] >= from && self.time[i] <= until && self.forward[i].abs() > DRIVING)
            .map(|i| self.slope[i])
            .collect();
        (!rows.is_empty()).then(|| rows.iter().sum::<f64>() / rows.len() as f64)
    }

    /// Stretches of driving in which it tilts by more than two degrees for more than five seconds.
    pub(super) fn tilted(&self) -> Vec<Tilted> {
        let mut spans: Vec<[f64; 2]> = Vec::new();
        for i in (0..self.time.len()).filter(|&i| self.slope[i].abs() > TILT && self.forward[i].abs() > DRIVING) {
            match spans.last_mut() {
                Some(span) if self.time[i] - span[1] <= GAP => span[1] = self.time[i],
                _ => spans.push([self.time[i]; 2]),
            }
        }
        let long = spans.into_iter().filter(|s| s[1] - s[0] > LEAST);
        long.filter_map(|interval| Some(Tilted { interval, slope: self.mean_slope(interval)? })).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tilt_is_seen_in_the_direction_of_travel() {
        let columns = |names: &[&str]| names.iter().map(|n| (*n).to_owned()).collect();
        let speeds = Table {
            columns: columns(&["time", "velL", "velR"]),
            rows: (0..200).map(|i| vec![f64::from(i) * 0.15, -0.3, -0.3]).collect(),
        };
        // Nose up from 10 s to 20 s, driven backward: downhill.
        let tilt = |t: f64| if (10.0..20.0).contains(&t) { GRAVITY * 4.0_f64.to_radians().sin() } else { 0.0 };
        let inertial = Table {
            columns: columns(&["time", "wz", "ax"]),
            rows: (0..3000).map(|i| vec![f64::from(i) * 0.01, 0.0, tilt(f64::from(i) * 0.01)]).collect(),
        };
        let found = Witness::of(&speeds, &inertial).expect("a witness").tilted();
        assert_eq!(found.len(), 1);
        let [from, until] = found[0].interval;
        assert!(
            (from - 10.0).abs() < 0.5 && (until - 20.0).abs() < 0.5 && (found[0].slope + 3.9).abs() < 0.3,
            "{found:?}"
        );
    }
}
