//! Telling a simulator's log from a recording: its sensors have no noise.

use std::f64::consts::TAU;

use inference::robust::median;

use crate::run::Run;
use crate::settings::preparation::{Logs, SETTINGS};

const LOGS: Logs = SETTINGS.logs;

impl Run {
    /// Whether this looks like a simulator's log.
    ///
    /// Gyro and accelerometer show the same number all the while that the robot stands at the start; or, row by row, the
    /// gyro is the slope of the pose's yaw and the accelerometer the curvature of its path, closer than sensors come.
    pub fn is_noise_free(&self) -> bool {
        self.rests_without_noise() || self.moves_without_noise()
    }

    fn rests_without_noise(&self) -> bool {
        let stands = |k: usize| self.angle.iter().all(|angle| angle[k] == angle[0] && angle[k].is_some());
        let rest = (0..self.rows()).take_while(|&k| stands(k)).count();
        let same = |channel: &Vec<Option<f64>>| {
            let samples: Vec<f64> = channel[..rest].iter().copied().flatten().collect();
            let first = samples.first().copied().unwrap_or_default();
            (samples.len() >= LOGS.least_samples).then(|| samples.iter().all(|v| (v - first).abs() < LOGS.same))
        };
        let sensors = std::iter::once(&self.gyro).chain(&self.accel).filter_map(same);
        let of_each: Vec<bool> = sensors.collect();
        !of_each.is_empty() && of_each.iter().all(|constant| *constant)
    }

    /// Both must agree: an estimator may have made the yaw from the gyro.
    fn moves_without_noise(&self) -> bool {
        let around = 1..self.rows().saturating_sub(1);
        let [turning, pushing]: [Vec<f64>; 2] = [
            around.clone().filter_map(|k| self.yaw_rate_error(k)).collect(),
            around.filter_map(|k| self.acceleration_error(k)).collect(),
        ];
        let agrees = |errors: Vec<f64>, most: f64| {
            errors.len() >= LOGS.least_rows && median(errors).is_some_and(|error| error < most)
        };
        agrees(turning, LOGS.same_yaw_rate) && agrees(pushing, LOGS.same_acceleration)
    }

    /// The slope of the yaw about a row less the gyro there `(ψ₊ − ψ₋) / 2T − (ω₋ + 2ω + ω₊) / 4`, rad/s.
    fn yaw_rate_error(&self, k: usize) -> Option<f64> {
        let [yaw, gyro] = [&self.pose[2], &self.gyro];
        let turned = yaw[k + 1]? - yaw[k - 1]?;
        let slope = (turned - TAU * (turned / TAU).round()) / (2.0 * self.period);
        Some((slope - 0.25 * (gyro[k - 1]? + 2.0 * gyro[k]? + gyro[k + 1]?)).abs())
    }

    /// The second difference of the position about a row, seen from the body, less the accelerometer there, m/s².
    fn acceleration_error(&self, k: usize) -> Option<f64> {
        let bent = |axis: usize| {
            let at = &self.pose[axis];
            Some((at[k + 1]? - 2.0 * at[k]? + at[k - 1]?) / (self.period * self.period))
        };
        let ([ax, ay], (sin, cos)) = ([bent(0)?, bent(1)?], self.pose[2][k]?.sin_cos());
        let ahead = cos * ax + sin * ay - self.accel[0][k]?;
        let left = cos * ay - sin * ax - self.accel[1][k]?;
        Some(ahead.hypot(left))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::blank;

    #[test]
    fn a_log_whose_sensors_rest_while_the_robot_stands_is_a_simulators() {
        let mut run = blank(300);
        for k in 0..300_usize {
            let moved = 0.01 * k.saturating_sub(50) as f64;
            run.angle = run.angle.map(|mut angle| {
                angle[k] = Some(moved);
                angle
            });
            run.gyro[k] = Some(if k < 50 { 0.0 } else { 0.1 * moved });
        }
        assert!(run.is_noise_free());
        run.gyro[20] = Some(1e-4);
        assert!(!run.is_noise_free(), "noise of a real gyro");
        let mut moving = run.clone();
        moving.gyro[20] = Some(0.0);
        moving.angle[0][2] = Some(1.0);
        assert!(!moving.is_noise_free(), "too short a rest tells nothing");
    }

    /// A robot that drives a spiral from the first row on; `noise` of its sensors, in their units.
    fn spiral(noise: [f64; 3]) -> Run {
        let mut run = blank(400);
        // A repeating scatter: no random numbers, no lucky draw.
        let scatter = |k: usize| [0.8, -1.1, 0.4, -0.1, 0.9, -0.9, 0.3][k % 7];
        for k in 0..400 {
            let t = k as f64 * run.period;
            let (yaw, speed) = (3.0 + 0.4 * t, 0.5);
            let radius = speed / 0.4;
            let pose = [radius * yaw.sin(), -radius * yaw.cos(), yaw - TAU * (yaw / TAU).round()];
            for (axis, channel) in run.pose.iter_mut().enumerate() {
                channel[k] = Some(pose[axis] + noise[2] * scatter(k + axis));
            }
            run.gyro[k] = Some(0.4 + noise[0] * scatter(k));
            run.accel[0][k] = Some(noise[1] * scatter(k + 3));
            run.accel[1][k] = Some(speed * 0.4 + noise[1] * scatter(k + 5));
            run.angle = run.angle.map(|mut angle| {
                angle[k] = Some(5.0 * t);
                angle
            });
        }
        run
    }

    #[test]
    fn a_log_of_a_robot_that_moves_at_once_is_known_by_a_pose_that_agrees_with_its_sensors() {
        assert!(spiral([0.0; 3]).is_noise_free());
        assert!(!spiral([0.01, 0.3, 1e-3]).is_noise_free(), "a recording");
        assert!(!spiral([0.0, 0.3, 0.0]).is_noise_free(), "a yaw that was made from the gyro is no simulation");
        let mut seldom = spiral([0.0; 3]);
        seldom.pose = seldom.pose.map(|p| p.iter().enumerate().map(|(k, v)| v.filter(|_| k % 5 == 0)).collect());
        assert!(!seldom.is_noise_free(), "nothing to compare with");
    }
}
