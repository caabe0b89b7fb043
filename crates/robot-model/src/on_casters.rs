//! The plant of a robot on two driven wheels and casters: contacts 0 and 1 are the casters, 2 and 3 the wheels.

use crate::chassis::swung;
use crate::effect::Coefficients;
use crate::plant::{Contacts, FRICTION_REST, Plant};
use crate::scalar::{Scalar, real, smooth_sign};
use crate::state::State;

impl<T: Scalar> Plant<'_, T> {
    /// Velocity of a contact's place on the body, in body axes, m/s.
    #[inline(always)]
    pub(crate) fn pivot(&self, s: &State<T>, contact: usize) -> [T; 2] {
        let [x, y] = self.stance.wheel[contact];
        [s.velocity[0] - s.yaw_rate * y, s.velocity[1] + s.yaw_rate * x]
    }

    /// Contact forces, the stiffness of those of the wheels, and the rolling resistance torque of these.
    ///
    /// A caster's wheel rolls along its own direction and, since it swings freely, slides sideways at no force:
    /// `F = −f_r N sign v` along it, at its pivot. That the load follows the wheel about the pivot is left out: of sixty
    /// drawn robots no more was named with it.
    #[inline(always)]
    fn contacts_on_casters(&self, s: &State<T>, c: &Coefficients<T>) -> Contacts<T> {
        let mut k = [[T::zero(); 2]; 4];
        let mut stiffness = [T::zero(); 4];
        let rest = real::<T>(FRICTION_REST) * self.robot.wheel_radius;
        for i in 0..2 {
            let ((sin, cos), [x, y]) = (s.passive[i].sin_cos(), self.pivot(s, i));
            let drag = c.rolling[i] * smooth_sign((x * cos + y * sin) / rest);
            k[i] = [-(drag * cos), -(drag * sin)];
        }
        for i in 2..4 {
            (k[i], stiffness[i]) = self.tyre(s, c, i, s.wheel_speed[i - 2]);
        }

        let balance = self.stance.settle(&k);
        let mut rolling = [T::zero(); 4];
        for i in 2..4 {
            stiffness[i] *= balance.load[i];
            rolling[i] = c.rolling[i] * balance.load[i] * c.radius[i];
        }
        Contacts { force: balance.force, stiffness, rolling }
    }

    /// [`Plant::step_under`] of such a robot: each wheel bears all of its side's friction.
    #[inline(always)]
    pub(crate) fn step_on_casters(&self, s: &mut State<T>, torque: [T; 2], c: &Coefficients<T>) {
        let h = self.step;
        let Contacts { mut force, stiffness, rolling } = self.contacts_on_casters(s, c);
        let inertia = self.robot.side_inertia();
        for j in 0..2 {
            let (i, speed) = (j + 2, s.wheel_speed[j]);
            let radius = c.radius[i];
            let sign = smooth_sign(speed * real(1.0 / FRICTION_REST));
            let ahead = h * (s.rate[0] - s.rate[2] * self.stance.wheel[i][1]);
            let stiff = h * radius * stiffness[i];
            let drag = rolling[i] * sign + Self::friction(c, j, speed, sign);

            let impulse = h * (torque[j] + c.torque[j] - radius * force[i][0] - drag) + stiff * ahead;
            let change = impulse / (inertia + stiff * radius);
            force[i][0] += stiffness[i] * (radius * change - ahead);
            s.wheel_speed[j] = speed + change;
            s.wheel_angle[j] += h * s.wheel_speed[j];
        }
        self.move_on_casters(s, &force, c);
    }

    /// [`Plant::step_at_speed`] of such a robot.
    #[inline(always)]
    pub(crate) fn step_on_casters_at_speed(&self, s: &mut State<T>, speed: [T; 2], rate: [T; 2], c: &Coefficients<T>) {
        let Contacts { force, rolling, .. } = self.contacts_on_casters(s, c);
        let inertia = self.robot.side_inertia();
        for j in 0..2 {
            let i = j + 2;
            let sign = smooth_sign(speed[j] * real(1.0 / FRICTION_REST));
            let load = Self::friction(c, j, speed[j], sign) + rolling[i] * sign + c.radius[i] * force[i][0];
            s.needed[j] = (inertia * rate[j] + load - c.torque[j]) / self.robot.drive.gain;
            s.wheel_angle[j] += self.step * speed[j];
        }
        self.move_on_casters(s, &force, c);
    }

    #[inline(always)]
    fn move_on_casters(&self, s: &mut State<T>, force: &[[T; 2]; 4], c: &Coefficients<T>) {
        self.move_body(s, force, c);
        for i in 0..2 {
            s.passive[i] = swung(s.passive[i], self.pivot(s, i), s.yaw_rate, self.robot.caster_trail, self.step);
        }
    }
}
