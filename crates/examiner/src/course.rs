//! Drives that are asked for: wanted speed and yaw rate over time.

/// A drive that someone asks for, instead of one that is drawn.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Course {
    /// Pose at the start, x and y in m, yaw in rad; drawn if not given.
    pub start: Option<[f64; 3]>,
    /// Time in s, wanted speed in m/s and yaw rate in rad/s, linear between points; in the order of time.
    pub points: Vec<[f64; 3]>,
    /// When the drives are told to give no torque, s.
    pub torque_free: Vec<[f64; 2]>,
}

impl Course {
    /// Length, s.
    pub fn duration(&self) -> f64 {
        self.points.last().map_or(0.0, |p| p[0])
    }

    /// Speed and yaw rate wanted at an instant; before the first point and after the last theirs.
    pub(crate) fn want(&self, t: f64) -> [f64; 2] {
        let after = self.points.partition_point(|p| p[0] <= t);
        let before = &self.points[after.max(1) - 1];
        let next = &self.points[after.min(self.points.len() - 1)];
        let span = next[0] - before[0];
        let share = if span > 0.0 { ((t - before[0]) / span).clamp(0.0, 1.0) } else { 0.0 };
        [1, 2].map(|i| before[i] + share * (next[i] - before[i]))
    }

    /// Whether no torque is wanted.
    pub(crate) fn is_free(&self, t: f64) -> bool {
        self.torque_free.iter().any(|i| i[0] <= t && t < i[1])
    }

    /// Whether it can be driven.
    pub(crate) fn is_sound(&self) -> bool {
        let numbers = self.points.iter().flatten().chain(self.start.iter().flatten());
        !self.points.is_empty()
            && numbers.into_iter().all(|x| x.is_finite())
            && self.points.windows(2).all(|p| p[0][0] <= p[1][0])
    }
}

#[cfg(test)]
mod tests {
    use super::Course;

    #[test]
    fn speeds_are_linear_between_points() {
        let points = vec![[0.0, 0.0, 0.0], [2.0, 1.0, -0.5], [4.0, 1.0, 0.5]];
        let c = Course { points, torque_free: vec![[1.0, 2.0]], ..Course::default() };
        assert_eq!((c.want(1.0), c.want(3.0), c.want(9.0)), ([0.5, -0.25], [1.0, 0.0], [1.0, 0.5]));
        assert!(c.is_sound() && c.is_free(1.5) && !c.is_free(2.0));
        let back = Course { points: vec![[1.0, 0.0, 0.0], [0.5, 0.0, 0.0]], ..Course::default() };
        assert!(!back.is_sound() && !Course::default().is_sound());
    }
}
