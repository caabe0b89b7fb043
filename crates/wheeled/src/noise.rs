//! How noisy a measured pose is, and the velocities that are taken from it.
//!
//! Third differences of a motion at equal instants are those of its noise nearly: `20 σ²` of white noise, the jerk times the cube of the
//! time between two poses else. A velocity by the parabola through poses about an instant has `σ/√Σt²`.

use std::f64::consts::TAU;

use inference::robust::{MAD_TO_SIGMA, median};
use odometry::file::Series;

use crate::settings::{Grid, SETTINGS};

const RULES: Grid = SETTINGS.grid;
/// Variance of third differences of white noise of unit variance.
const OF_THIRD: f64 = 20.0;

/// Noise of a pose and its rates, one sigma each; 0 without a pose.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Noise {
    /// Of a place along an axis, m, and of the heading, rad.
    pub(crate) pose: [f64; 2],
    /// Of their rates, m/s and rad/s.
    pub(crate) rates: [f64; 2],
}

impl Noise {
    /// Of poses at their own instants.
    pub(crate) fn of(pose: &[Series; 3]) -> Self {
        let (seen, [x, y, yaw]) = (seen(pose), pose);
        let Some(period) = apart(pose) else { return Self::default() };
        // Third differences across a gap are motion.
        let even = |w: &&[usize]| x.time[w[3]] - x.time[w[0]] < RULES.even * 3.0 * period;
        let third = |w: &[usize], s: &Series| {
            let at = |k: usize| s.value[w[k]];
            at(3) - 3.0 * at(2) + 3.0 * at(1) - at(0)
        };
        let sigma = |all: &mut dyn Iterator<Item = f64>| MAD_TO_SIGMA * median(all).unwrap_or(0.0) / OF_THIRD.sqrt();
        let windows = || seen.windows(4).filter(even);
        let place = sigma(&mut windows().flat_map(|w| [third(w, x).abs(), third(w, y).abs()]));
        // A heading may jump by a turn.
        let within_a_turn = |d: f64| (d - (d / TAU).round() * TAU).abs();
        let heading = sigma(&mut windows().map(|w| within_a_turn(third(w, yaw))));
        let pose = [place, heading];
        let about = (RULES.smoothing / period + RULES.whole).floor().max(1.0);
        let squares: f64 = (1..=about as usize).map(|k| 2.0 * (period * k as f64).powi(2)).sum();
        Self { pose, rates: pose.map(|sigma| sigma / squares.sqrt()) }
    }

    /// By how much velocities by wheels and gyro count at the beginning of a window beside those of the pose, by their variances: of those
    /// ahead, to the left and of turning. Wheels without rollers slide sideways, and do not show it.
    pub(crate) fn share_of_wheels(self, rolls_any_way: bool) -> [f64; 3] {
        let share = |of_pose: f64, of_wheels: f64| of_pose.powi(2) / (of_pose.powi(2) + of_wheels.powi(2));
        let [place, heading] = self.rates;
        let [along, turning] = RULES.by_wheels;
        [share(place, along), share(place, if rolls_any_way { along } else { RULES.sideways }), share(heading, turning)]
    }

    /// What it makes of the place, ahead and to the left, and of the heading so much later, m and rad, root mean square, where windows
    /// begin with these shares of wheels and gyro.
    pub(crate) fn after(self, seconds: f64, [ahead, left, turning]: [f64; 3]) -> [f64; 3] {
        [(0, ahead), (0, left), (1, turning)].map(|(k, share)| {
            let rate = self.rates[k] * (1.0 - share).sqrt();
            (2.0 * self.pose[k].powi(2) + (rate * seconds).powi(2)).sqrt()
        })
    }
}

/// Rows in which a pose was seen.
fn seen(pose: &[Series; 3]) -> Vec<usize> {
    let is_seen = |k: &usize| pose.iter().all(|s| s.value.get(*k).is_some_and(|value| value.is_finite()));
    (0..pose[0].time.len()).filter(is_seen).collect()
}

/// Usual time between two poses, s; `None` where fewer than two were seen.
pub(crate) fn apart(pose: &[Series; 3]) -> Option<f64> {
    let time = &pose[0].time;
    median(seen(pose).windows(2).map(|w| time[w[1]] - time[w[0]]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use inference::robust::normal_quantile;

    /// Poses of a robot that drives a slalom, seen so often a second with so much noise.
    fn drawn(rate: f64, [of_place, of_heading]: [f64; 2]) -> Noise {
        let time: Vec<f64> = (0..(30.0 * rate) as usize).map(|k| k as f64 / rate).collect();
        let mut number = 0_usize;
        let mut noise = || {
            number += 1;
            normal_quantile((number as f64 * 0.618_033_988_749_895).fract().clamp(1e-6, 1.0 - 1e-6))
        };
        let mut series = |of: &dyn Fn(f64) -> f64, sigma: f64| Series {
            time: time.clone(),
            value: time.iter().map(|t| of(*t) + sigma * noise()).collect(),
        };
        let yaw = |t: f64| 3.0 + 0.5 * (0.8 * t).sin();
        Noise::of(&[
            series(&|t| 0.6 * t, of_place),
            series(&|t| 0.3 * (0.8 * t).sin(), of_place),
            series(&|t| yaw(t) - TAU * ((yaw(t) + std::f64::consts::PI) / TAU).floor(), of_heading),
        ])
    }

    #[test]
    fn noise_of_a_pose_is_found_beside_its_motion_and_wheels_count_the_more_the_larger_it_is() {
        for rate in [25.0, 50.0, 100.0] {
            let found = drawn(rate, [0.003, 0.004]);
            // Noise that is drawn evenly alternates, which third differences take for more.
            assert!((0.002..0.006).contains(&found.pose[0]) && (0.002..0.009).contains(&found.pose[1]), "{found:?}");
        }
        let (good, bad) = (drawn(100.0, [2e-4, 2e-4]), drawn(25.0, [0.003, 0.003]));
        assert!(good.share_of_wheels(true)[0] < 0.05 && bad.share_of_wheels(true)[1] > 0.5, "{good:?} {bad:?}");
        assert!(bad.share_of_wheels(false)[1] < 0.5 * bad.share_of_wheels(true)[1], "wheels slide sideways");
        let [with_wheels, without] = [bad.share_of_wheels(true), [0.0; 3]].map(|shares| bad.after(1.0, shares)[0]);
        assert!(with_wheels > 2.0_f64.sqrt() * bad.pose[0] && with_wheels < 0.7 * without, "{with_wheels} {without}");
        assert_eq!(Noise::of(&Default::default()), Noise::default());
    }
}
