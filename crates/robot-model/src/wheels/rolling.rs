//! Motions in which wheels roll: wheels from the body, and the body from its wheels.

use crate::chassis::swung;
use crate::scalar::{Scalar, real};
use crate::wheels::MOST;
use crate::wheels::plant::{Plant, solve};
use crate::wheels::state::State;

/// How much not to slide sideways counts beside rolling, where a motion is to be found from wheels.
const SIDEWAYS: f64 = 0.1;
/// Distance at which a wheel would count like a yaw rate that is measured, m.
const GYRO_LEVER: f64 = 10.0;

impl<T: Scalar> Plant<T> {
    /// Velocity of the body from that of the robot's origin; casters keep their angles.
    pub fn move_body(&self, s: &mut State<T>, origin: [T; 2], yaw_rate: T) {
        let com = self.robot.com;
        s.yaw_rate = yaw_rate;
        s.velocity = [origin[0] - yaw_rate * com[1], origin[1] + yaw_rate * com[0]];
    }

    /// Advances the angles of all casters by a time in which the body moves as it does.
    #[inline(always)]
    pub fn swing_casters(&self, s: &mut State<T>, seconds: T) {
        for (k, p) in self.casters.iter().enumerate() {
            let Some(caster) = self.robot.casters[k] else { continue };
            let v = [s.velocity[0] - s.yaw_rate * p[1], s.velocity[1] + s.yaw_rate * p[0]];
            s.caster[k] = swung(s.caster[k], v, s.yaw_rate, caster.trail, seconds);
        }
    }

    /// Sets the speed of every wheel to that at which it rolls under the body's motion, wheels of one motor at their mean.
    pub fn roll_wheels(&self, s: &mut State<T>) {
        let directions = self.directions(s);
        let (mut sum, mut count) = ([T::zero(); MOST], [T::zero(); MOST]);
        for i in 0..MOST {
            let Some(wheel) = self.robot.wheels[i] else { continue };
            let p = self.from_com[i];
            let along = self.axis(i, directions[i]);
            let v = [s.velocity[0] - s.yaw_rate * p[1], s.velocity[1] + s.yaw_rate * p[0]];
            let per_turn = wheel.radius * (along[0] * directions[i][0] + along[1] * directions[i][1]);
            sum[self.group[i] % MOST] += (v[0] * along[0] + v[1] * along[1]) / per_turn;
            count[self.group[i] % MOST] += T::one();
        }
        for i in 0..MOST {
            let g = self.group[i] % MOST;
            s.wheel_speed[i] = T::zero().if_less(count[g], sum[g] / count[g].max(T::one()), T::zero());
        }
    }

    /// Sets the speeds of wheels that are known, with those of the wheels that turn with them.
    pub fn turn_wheels(&self, s: &mut State<T>, speeds: &[Option<T>; MOST]) {
        for i in 0..MOST {
            let Some(speed) = speeds[i] else { continue };
            for k in 0..MOST {
                if self.group[k] == self.group[i] {
                    s.wheel_speed[k] = speed;
                }
            }
        }
    }

    /// Sets the body's motion to that in which wheels that turn at these speeds roll, and none slides sideways, as well as they
    /// agree (least squares); `None` of a wheel that is not measured. Of robots that skid the wheels do not agree: a yaw rate that is
    /// measured then counts most, and sliding sideways least.
    pub fn roll_body(&self, s: &mut State<T>, speeds: &[Option<T>; MOST], yaw_rate: Option<T>) {
        let directions = self.directions(s);
        let (mut m, mut b) = ([T::zero(); 6], [T::zero(); 3]);
        let mut rule = |row: [T; 3], value: T| {
            let [x, y, z] = row;
            for (to, add) in m.iter_mut().zip([x * x, x * y, x * z, y * y, y * z, z * z]) {
                *to += add;
            }
            for (to, add) in b.iter_mut().zip(row) {
                *to += add * value;
            }
        };
        for i in 0..MOST {
            let Some(wheel) = self.robot.wheels[i] else { continue };
            let (p, e) = (self.from_com[i], directions[i]);
            let of = |[x, y]: [T; 2]| [x, y, p[0] * y - p[1] * x];
            let along = self.axis(i, e);
            if let Some(speed) = speeds[i] {
                rule(of(along), speed * wheel.radius * (along[0] * e[0] + along[1] * e[1]));
            }
            if wheel.roller.is_none() {
                rule(of([-e[1], e[0]]).map(|x| x * real(SIDEWAYS)), T::zero());
            }
        }
        if let Some(rate) = yaw_rate {
            rule([T::zero(), T::zero(), real(GYRO_LEVER)], rate * real(GYRO_LEVER));
        }
        // Motions that nothing determines stay at rest.
        for k in [0, 3, 5] {
            m[k] += real(1e-9);
        }
        let [x, y, w] = solve(m, b);
        s.yaw_rate = w;
        let com = self.robot.com;
        self.set_velocity(s, [x + w * com[1], y - w * com[0]]);
    }
}
