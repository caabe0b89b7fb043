//! A drive as wanted speeds over time.

/// Acceleration and angular acceleration of ramps, m/s² and rad/s²: what such robots drive every day.
const RAMP: [f64; 2] = [1.2, 3.0];
/// Of the half track, the lever on which a wheel's speed turns the body: skidding wheels turn it less than rolling ones.
pub const WIDENING: f64 = 1.5;

/// Wanted speed and yaw rate over time, linear between points.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Course {
    /// Time s, speed m/s, yaw rate rad/s.
    pub points: Vec<[f64; 3]>,
    /// Intervals in which the drives are given no torque, s.
    pub torque_free: Vec<[f64; 2]>,
}

impl Course {
    /// Levels `[speed, yaw rate]` held one after the other for equal times, with ramps between them, from rest to rest.
    pub fn of_levels(levels: &[[f64; 2]], length: f64) -> Self {
        let each = length / levels.len().max(1) as f64;
        let mut points = vec![[0.0; 3]];
        let mut now = [0.0; 2];
        for (i, level) in levels.iter().enumerate() {
            let (from, last) = (i as f64 * each, i + 1 == levels.len());
            // The last level leaves room to stop.
            let room = if last { 0.5 * each } else { each };
            // What cannot be reached in the time is aimed at as far as it goes.
            let next: [f64; 2] =
                std::array::from_fn(|c| now[c] + (level[c] - now[c]).clamp(-RAMP[c] * room, RAMP[c] * room));
            let ramp = ramp(now, next);
            points.push([from + ramp, next[0], next[1]]);
            let stop = (0..2).map(|c| next[c].abs() / RAMP[c]).fold(0.0, f64::max).min(0.5 * each);
            let until = if last { length - stop } else { from + each };
            if until > from + ramp {
                points.push([until, next[0], next[1]]);
            }
            now = next;
        }
        points.push([length, 0.0, 0.0]);
        Self { points, torque_free: Vec::new() }
    }

    /// Wanted speed and yaw rate at a time.
    pub fn at(&self, t: f64) -> [f64; 2] {
        let after = self.points.partition_point(|p| p[0] <= t);
        match (after.checked_sub(1).map(|i| self.points[i]), self.points.get(after)) {
            (Some(a), Some(b)) => {
                let share = (t - a[0]) / (b[0] - a[0]).max(1e-9);
                [a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2])]
            }
            (Some(a), None) => [a[1], a[2]],
            (None, first) => first.map_or([0.0; 2], |p| [p[1], p[2]]),
        }
    }

    /// Whether the drives are given no torque.
    pub fn is_free(&self, t: f64) -> bool {
        self.torque_free.iter().any(|[from, until]| (*from..*until).contains(&t))
    }
}

/// Time that a change takes, s.
fn ramp(from: [f64; 2], to: [f64; 2]) -> f64 {
    (0..2).map(|c| (to[c] - from[c]).abs() / RAMP[c]).fold(0.0, f64::max)
}

/// Speeds of the left and right wheel, rad/s, that drive a body so: `w = (v ∓ b ω) / r`; of a body that skids, b is
/// [`WIDENING`] times the half track.
pub fn wheel_speeds([speed, turn]: [f64; 2], wheel_radius: f64, lever: f64) -> [f64; 2] {
    let lever = lever * turn;
    [(speed - lever) / wheel_radius, (speed + lever) / wheel_radius]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_are_reached_by_ramps_and_left_for_rest() {
        let c = Course::of_levels(&[[0.6, 0.0], [-0.6, 1.0]], 8.0);
        assert_eq!((c.at(0.0), c.at(8.0)), ([0.0; 2], [0.0; 2]));
        approx::assert_relative_eq!(c.at(0.25)[0], 0.3, epsilon = 1e-12);
        assert_eq!(c.at(3.0), [0.6, 0.0]);
        assert_eq!(c.at(6.0), [-0.6, 1.0]);
        for pair in c.points.windows(2) {
            let span = pair[1][0] - pair[0][0];
            assert!(span > 0.0, "{pair:?}");
            assert!((pair[1][1] - pair[0][1]).abs() <= RAMP[0] * span + 1e-9, "{pair:?}");
            assert!((pair[1][2] - pair[0][2]).abs() <= RAMP[1] * span + 1e-9, "{pair:?}");
        }
    }

    #[test]
    fn a_level_that_is_out_of_reach_is_approached() {
        let c = Course::of_levels(&[[2.0, 0.0], [-2.0, 0.0], [2.0, 0.0]], 3.0);
        let most = c.points.iter().fold(0.0_f64, |m, p| m.max(p[1].abs()));
        assert!(most <= 1.2 + 1e-12, "{most}");
        assert_eq!(c.at(3.0), [0.0; 2]);
    }
}
