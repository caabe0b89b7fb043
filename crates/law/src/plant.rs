//! A law at work in the plant: what it sees of an instant, and what it changes there.

use robot_model::{Coefficients, OperatingPoint};
use scalar::{Scalar, real};

use crate::motion::{Action, Motion};
use crate::settings::SETTINGS;

impl<T: Scalar> Motion<T> {
    /// What a law sees of an operating point whose wheels have the radii of `c`.
    #[inline(always)]
    pub fn seen_at(at: &OperatingPoint<T>, c: &Coefficients<T>) -> Self {
        let rim = [at.wheel_speed[0] * c.radius[2], at.wheel_speed[1] * c.radius[3]];
        let turning = at.yaw_rate * at.half_base[1];
        Self {
            time: at.time,
            position: at.position,
            heading: at.heading,
            velocity: at.velocity,
            yaw_rate: at.yaw_rate,
            wheel_speed: at.wheel_speed,
            wheel_angle: at.wheel_angle,
            torque: at.torque,
            slip: [rim[0] - at.velocity[0] + turning, rim[1] - at.velocity[0] - turning],
        }
    }
}

impl<T: Scalar> Action<T> {
    /// Changes the coefficients of an instant; a slope is positive where the ground rises along its axis.
    #[inline(always)]
    pub fn change(&self, at: &OperatingPoint<T>, c: &mut Coefficients<T>) {
        let least = SETTINGS.effect.least_share;
        let share = |x: T| (T::one() + x).max(real(least));
        for i in 0..4 {
            let j = i % 2;
            c.adhesion[i] *= share(self.grip[j]);
            c.lateral[i] *= share(self.lateral_grip);
            c.radius[i] = (c.radius[i] + self.radius[j]).max(c.radius[i] * real(least));
        }
        for j in 0..2 {
            c.torque[j] += self.torque[j];
            c.force[j] += self.force[j];
        }
        c.moment += self.moment;
        let ([cos, sin], [x, y]) = (at.heading, self.slope);
        c.tilt[0] -= at.gravity * (x * cos + y * sin);
        c.tilt[1] -= at.gravity * (y * cos - x * sin);
    }
}
