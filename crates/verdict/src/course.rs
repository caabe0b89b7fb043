//! A drive as wanted speeds over time.

/// Acceleration and angular acceleration of ramps, m/s² and rad/s²: what such robots drive every day.
const RAMP: [f64; 2] = [1.2, 3.0];
/// Instants closer than this are one, s: far above rounding, far below a row.
const INSTANT: f64 = 1e-9;

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
            // What cannot be reached in the time, or from where nobody could stop in time, is aimed at as far as it goes.
            let room = if last { 0.5 * each } else { each };
            let rest = if last { 0.5 * each } else { length - from - each };
            let next: [f64; 2] = std::array::from_fn(|c| {
                let stoppable = level[c].clamp(-RAMP[c] * rest, RAMP[c] * rest);
                now[c] + (stoppable - now[c]).clamp(-RAMP[c] * room, RAMP[c] * room)
            });
            let reached = from + ramp(now, next);
            if reached > from + INSTANT {
                points.push([reached, next[0], next[1]]);
            }
            let until = if last { length - ramp(next, [0.0; 2]) } else { from + each };
            if until > reached + INSTANT {
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
                let share = (t - a[0]) / (b[0] - a[0]).max(INSTANT);
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

/// Speeds of the left and right wheel, rad/s, that drive a body so: `w = (v ∓ b ω) / r`; of a body that skids, the lever b
/// is longer than half the track.
pub fn wheel_speeds([speed, turn]: [f64; 2], wheel_radius: f64, lever: f64) -> [f64; 2] {
    let lever = lever * turn;
    [(speed - lever) / wheel_radius, (speed + lever) / wheel_radius]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_ramp_is_steeper_than_such_robots_drive_and_no_instant_is_told_twice() {
        let drives: [&[[f64; 2]]; 4] =
            [&[[1.2, 0.0]; 2], &[[0.0, 4.0]; 3], &[[1.0, 1.2], [1.0, 1.2], [-1.0, 3.0]], &[[2.0, -4.0]]];
        for levels in drives {
            for each in [0.8, 1.0, 1.5, 4.0] {
                let course = Course::of_levels(levels, each * levels.len() as f64);
                for pair in course.points.windows(2) {
                    let [a, b] = [pair[0], pair[1]];
                    assert!(b[0] > a[0], "{levels:?} of {each} s: {:?}", course.points);
                    for c in 0..2 {
                        let rate = (b[c + 1] - a[c + 1]).abs() / (b[0] - a[0]);
                        assert!(rate <= RAMP[c] * (1.0 + 1e-9), "{levels:?} of {each} s: {:?}", course.points);
                    }
                }
            }
        }
    }

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

    #[test]
    fn a_level_is_held_until_braking_must_begin_and_only_touched_where_time_is_short() {
        // Braking takes 0.6 / 1.2 = 0.5 s, the turn 0.9 / 3.0 = 0.3 s: the slower of both counts.
        let c = Course::of_levels(&[[0.6, 0.9]], 4.0);
        assert_eq!(c.points, [[0.0; 3], [0.5, 0.6, 0.9], [3.5, 0.6, 0.9], [4.0, 0.0, 0.0]]);
        // Here the turn is the slower one: 1.8 / 3.0 = 0.6 s.
        let c = Course::of_levels(&[[0.6, 1.8]], 4.0);
        assert_eq!((c.points[1], c.points[2]), ([0.6, 0.6, 1.8], [3.4, 0.6, 1.8]));
        // A second takes it to 1.2 m/s and the next back to rest; of the last, one half goes up and one down.
        let c = Course::of_levels(&[[2.0, 0.0], [-2.0, 0.0], [2.0, 0.0]], 3.0);
        assert_eq!(c.points, [[0.0; 3], [1.0, 1.2, 0.0], [2.0, 0.0, 0.0], [2.5, 0.6, 0.0], [3.0, 0.0, 0.0]]);
    }

    #[test]
    fn between_two_points_speed_and_yaw_rate_change_evenly_and_beyond_them_they_stay() {
        let c = Course { points: vec![[1.0, 0.25, -0.5], [3.0, 0.75, 1.5]], torque_free: Vec::new() };
        assert_eq!([1.0, 1.5, 2.0].map(|t| c.at(t)), [[0.25, -0.5], [0.375, 0.0], [0.5, 0.5]]);
        assert_eq!([0.0, 3.0, 9.0].map(|t| c.at(t)), [[0.25, -0.5], [0.75, 1.5], [0.75, 1.5]]);
        assert_eq!(Course::default().at(1.0), [0.0; 2]);
    }

    #[test]
    fn drives_are_free_from_the_begin_of_an_interval_to_just_before_its_end() {
        let c = Course { points: Vec::new(), torque_free: vec![[2.0, 3.0], [5.0, 6.0]] };
        let free = [1.9, 2.0, 2.9, 3.0, 4.0, 5.5, 6.0].map(|t| c.is_free(t));
        assert_eq!(free, [false, true, true, false, false, true, false]);
    }

    #[test]
    fn wheels_roll_at_the_speed_of_the_body_and_the_right_one_is_faster_to_the_left() {
        // On rims of 0.25 m: 1 m/s less and plus 0.5 m × 0.5 rad/s.
        assert_eq!(wheel_speeds([1.0, 0.5], 0.25, 0.5), [3.0, 5.0]);
        assert_eq!(wheel_speeds([0.0, 0.5], 0.25, 0.5), [-1.0, 1.0]);
        assert_eq!(wheel_speeds([-1.0, 0.0], 0.25, 0.5), [-4.0, -4.0]);
    }
}
