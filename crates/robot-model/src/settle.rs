//! Steady motion of a speed-driven robot.

use nalgebra::RealField;

use crate::plant::Plant;
use crate::scalar::{Scalar, real};
use crate::state::State;

/// Steps of the search for a steady motion: were none rejected, the last would be years long.
const SETTLING: usize = 50;
/// The first step and the shortest, s.
const FIRST_STEP: f64 = 1e-2;
const LEAST_STEP: f64 = 1e-5;

impl<T: Scalar + RealField> Plant<'_, T> {
    /// Body motion at which a robot whose wheels turn at `speed` stays: velocity of the centre of mass and yaw rate
    /// for which all accelerations vanish, at the heading and place of `s`; the torque that it takes is left in
    /// [`State::needed`].
    ///
    /// Pseudo-transient continuation: implicit Euler steps with ever longer steps, at most `SETTLING`. Returns the
    /// largest acceleration that is left, m/s² or rad/s².
    pub fn settle_at_speed(&self, s: &mut State<T>, speed: [T; 2]) -> T {
        let still = self.stepping(real(0.0));
        let rate = |s: &State<T>, v: [T; 3]| {
            let mut at = State { velocity: [v[0], v[1]], yaw_rate: v[2], ..*s };
            still.step_at_speed(&mut at, speed, [real(0.0); 2]);
            (nalgebra::Vector3::from(at.rate), at.needed)
        };
        let shift = real::<T>(1e-5);
        let mut h = real::<T>(FIRST_STEP);
        for _ in 0..SETTLING {
            let v = [s.velocity[0], s.velocity[1], s.yaw_rate];
            let (here, needed) = rate(s, v);
            // Effects that depend on the torque see that of the step before.
            s.needed = needed;
            let mut m = nalgebra::Matrix3::identity();
            for k in 0..3 {
                let mut shifted = v;
                shifted[k] += shift;
                m.set_column(k, &(m.column(k) - (rate(s, shifted).0 - here) * (h / shift)));
            }
            let Some(inverse) = m.try_inverse() else { break };
            let change = inverse * here * h;
            let next = [v[0] + change[0], v[1] + change[1], v[2] + change[2]];
            // A long step may jump over the peak of the tyres' force and back: a shorter one does not.
            let there = rate(s, next).0;
            if h > real(LEAST_STEP) && there.dot(&here) < real(0.0) && there.amax() > here.amax() * real(0.5) {
                h *= real(0.25);
                continue;
            }
            s.velocity = [next[0], next[1]];
            s.yaw_rate = next[2];
            h *= real(1.6);
        }
        let (left, needed) = rate(s, [s.velocity[0], s.velocity[1], s.yaw_rate]);
        s.wheel_speed = speed;
        self.turn_passive(s, speed);
        s.needed = needed;
        left.amax()
    }
}
