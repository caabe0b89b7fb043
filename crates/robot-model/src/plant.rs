//! The plant of a user's simulation: torque-driven (torque in, motion out) or speed-driven (wheel speeds in,
//! body motion and torque out).

use crate::active::Active;
use crate::chassis::{Chassis, dragged};
use crate::contact::{Stance, combined};
use crate::disturbance::Disturbance;
use crate::effect::{Coefficients, OperatingPoint, Readings};
use crate::robot::{Drive, Robot};
use crate::scalar::{Scalar, bell, real, smooth_sign};
use crate::state::State;

/// Wheel speed over which dry friction changes its sign, rad/s.
pub(crate) const FRICTION_REST: f64 = 0.15;
/// Wheel speed over which the Stribeck rise decays, rad/s.
const STRIBECK_SPEED: f64 = 0.6;

/// A robot with its active effects, ready to step.
pub struct Plant<'a, T: Scalar> {
    pub(crate) robot: Robot<T>,
    pub(crate) stance: Stance<T>,
    coefficients: Coefficients<T>,
    active: &'a [Active<T>],
    disturbance: Option<&'a dyn Disturbance<T>>,
    pub(crate) step: T,
    keep: [T; 2],
    inverse_mass: T,
    inverse_yaw_inertia: T,
}

/// Forces of an instant, before any speed has moved.
pub(crate) struct Contacts<T> {
    pub(crate) force: [[T; 2]; 4],
    pub(crate) stiffness: [T; 4],
    pub(crate) rolling: [T; 4],
}

impl<'a, T: Scalar> Plant<'a, T> {
    /// A plant that steps by `step` seconds.
    pub fn new(robot: &Robot<T>, active: &'a [Active<T>], step: T) -> Self {
        let mut robot = *robot;
        for a in active {
            a.effect.robot(a.values(), &mut robot);
        }
        let decay = |tau: T| T::zero().if_less(tau, (-step / tau).exp(), T::zero());
        let keep = [decay(robot.drive.lag), decay(robot.drive.extra_lag)];
        Self {
            stance: robot.stance(),
            coefficients: robot.coefficients(),
            inverse_mass: T::one() / robot.mass,
            inverse_yaw_inertia: T::one() / robot.yaw_inertia,
            robot,
            active,
            disturbance: None,
            step,
            keep,
        }
    }

    /// The same plant, on which something without a name acts as well.
    #[must_use]
    pub fn disturbed(self, by: Option<&'a dyn Disturbance<T>>) -> Self {
        Self { disturbance: by, ..self }
    }

    /// The same plant that steps by `step` seconds, its drive as it is.
    pub(crate) fn stepping(&self, step: T) -> Self {
        Self { step, ..*self }
    }

    /// The drive, as the active effects left it: its delay is for whoever looks the command up.
    pub fn drive(&self) -> &Drive<T> {
        &self.robot.drive
    }

    /// Sets the body velocity from that of the geometric centre.
    pub fn set_velocity(&self, s: &mut State<T>, reference: [T; 2]) {
        let w = s.yaw_rate;
        s.velocity = [reference[0] - w * self.robot.com[1], reference[1] + w * self.robot.com[0]];
        if self.robot.chassis == Chassis::Differential {
            s.passive = [dragged(self.pivot(s, 0)), dragged(self.pivot(s, 1))];
        }
    }

    /// Turns the wheels that a belt couples to the driven ones with them.
    pub(crate) fn turn_passive(&self, s: &mut State<T>, speed: [T; 2]) {
        if self.robot.chassis.is_on_four_wheels() {
            s.passive = speed;
        }
    }

    /// Sets the drive to a torque command that has been held for long.
    pub fn settle_drive(&self, s: &mut State<T>, command: [T; 2]) {
        for (j, &c) in command.iter().enumerate() {
            s.torque[j] = self.limited(c);
            s.lagged[j] = s.torque[j];
        }
    }

    #[inline(always)]
    fn limited(&self, command: T) -> T {
        let d = &self.robot.drive;
        (command * d.gain).max(-d.limit).min(d.limit)
    }

    /// Advances the drive alone by one step, for the history before a restart.
    #[inline(always)]
    pub fn step_drive(&self, s: &mut State<T>, command: [T; 2]) {
        for (j, &c) in command.iter().enumerate() {
            let x = self.limited(c);
            s.torque[j] = x + self.keep[0] * (s.torque[j] - x);
            s.lagged[j] = s.torque[j] + self.keep[1] * (s.lagged[j] - s.torque[j]);
        }
    }

    /// Torque that a side's drive delivers, N m: what is left of the lagged torque after the dead band.
    #[inline(always)]
    pub fn delivered(&self, s: &State<T>) -> [T; 2] {
        let d = self.robot.drive.dead_band;
        s.lagged.map(|x| (x - d).max(T::zero()) + (x + d).min(T::zero()))
    }

    #[inline(always)]
    fn operating_point(&self, s: &State<T>, torque: [T; 2]) -> OperatingPoint<T> {
        OperatingPoint {
            time: s.time,
            position: s.position,
            heading: s.heading,
            velocity: s.velocity,
            yaw_rate: s.yaw_rate,
            wheel_speed: s.wheel_speed,
            wheel_angle: s.wheel_angle,
            torque,
            ..self.robot.at_rest()
        }
    }

    /// Lets the active effects change the coefficients of an instant, in place: it is large, and this is the hot path.
    #[inline(always)]
    fn change(&self, s: &State<T>, torque: [T; 2], c: &mut Coefficients<T>) {
        let at = self.operating_point(s, torque);
        for a in self.active {
            a.apply(&at, c);
        }
        if let Some(d) = self.disturbance {
            d.act(&at, c);
        }
    }

    #[inline(always)]
    fn speeds(&self, s: &State<T>) -> [T; 4] {
        let [front, mut rear] = [s.passive, s.wheel_speed];
        if self.robot.chassis == Chassis::FourMotors {
            // Their encoders are told as the mean of a side.
            rear = [rear[0] + rear[0] - front[0], rear[1] + rear[1] - front[1]];
        }
        [front[0], front[1], rear[0], rear[1]]
    }

    /// Force per load of a wheel that turns at `speed`, and the stiffness of that along the wheel.
    #[inline(always)]
    pub(crate) fn tyre(&self, s: &State<T>, c: &Coefficients<T>, i: usize, speed: T) -> ([T; 2], T) {
        let rest2 = self.robot.rest_speed * self.robot.rest_speed;
        let [x, y] = self.stance.wheel[i];
        let rim = speed * c.radius[i];
        let slip = [rim - (s.velocity[0] - s.yaw_rate * y), -(s.velocity[1] + s.yaw_rate * x)];
        let (per_speed, stiff) = combined(slip, rim * rim + rest2, c.slip_at_peak[i], self.robot.sliding_share);
        let mu = c.adhesion[i] * per_speed;
        let k = [mu * slip[0] * c.traction[i], mu * slip[1] * c.lateral[i]];
        (k, c.adhesion[i] * stiff * c.traction[i])
    }

    /// Contact forces, their stiffness `∂F_x/∂v_slip`, and the rolling resistance torque of each wheel.
    #[inline(always)]
    fn contacts(&self, s: &State<T>, c: &Coefficients<T>) -> Contacts<T> {
        let speed = self.speeds(s);
        let mut k = [[T::zero(); 2]; 4];
        let mut stiffness = [T::zero(); 4];
        for i in 0..4 {
            (k[i], stiffness[i]) = self.tyre(s, c, i, speed[i]);
        }
        let balance = self.stance.settle_twisted(&k, c.twist);
        let mut rolling = [T::zero(); 4];
        for i in 0..4 {
            stiffness[i] *= balance.load[i];
            rolling[i] = c.rolling[i] * balance.load[i] * c.radius[i];
        }
        Contacts { force: balance.force, stiffness, rolling }
    }

    /// Torque of a side's drivetrain friction at wheel speed `w`, without rolling resistance.
    #[inline(always)]
    pub(crate) fn friction(c: &Coefficients<T>, j: usize, w: T, sign: T) -> T {
        let mut dry = c.coulomb[j];
        if c.stribeck[j] != T::zero() {
            dry += c.stribeck[j] * bell(w * real(1.0 / STRIBECK_SPEED));
        }
        dry * sign + c.viscous[j] * w
    }

    /// One step of a torque-driven robot: `command` is held over the step.
    pub fn step(&self, s: &mut State<T>, command: [T; 2]) {
        self.step_drive(s, command);
        self.step_under(s, self.delivered(s));
    }

    /// One step under the torque of each side at its driven wheel, past the drive.
    ///
    /// Linearly implicit in the wheel speeds, whose slip stiffness is the fast part: with contact stiffness
    /// `F' = ∂F_x/∂v_slip` and the last acceleration `a` of the contact point,
    /// `(J + h r² F') Δω = h (T − r F + r F' h a)`, and the body receives the same impulses as the wheels.
    #[inline(always)]
    pub fn step_under(&self, s: &mut State<T>, torque: [T; 2]) {
        let (h, half) = (self.step, real::<T>(0.5));
        let mut changed;
        let c = if self.active.is_empty() && self.disturbance.is_none() {
            &self.coefficients
        } else {
            changed = self.coefficients;
            self.change(s, torque, &mut changed);
            &changed
        };
        if self.robot.chassis == Chassis::Differential {
            return self.step_on_casters(s, torque, c);
        }
        let Contacts { mut force, stiffness, rolling } = self.contacts(s, c);
        let (jw, jm) = (self.robot.wheel_inertia, self.robot.motor_inertia);
        let is_coupled = self.robot.chassis == Chassis::SkidSteer;
        let speeds = self.speeds(s);
        // What the front wheel and the rear one have of a side's motors.
        let share = if is_coupled { [T::zero(), T::one()] } else { [half; 2] };
        for j in 0..2 {
            let mut inertia = share.map(|part| jw + part * jm);
            let mut impulse = share.map(|part| part * h * (torque[j] + c.torque[j]));
            let mut ahead = [T::zero(); 2];
            let speed = [speeds[j], speeds[j + 2]];
            for n in 0..2 {
                let i = j + 2 * n;
                let radius = c.radius[i];
                let sign = smooth_sign(speed[n] * real(1.0 / FRICTION_REST));
                ahead[n] = h * (s.rate[0] - s.rate[2] * self.stance.wheel[i][1]);
                let stiff = h * radius * stiffness[i];
                inertia[n] += stiff * radius;
                // Bearings: each wheel bears half of its side's drivetrain friction, as in Eq. 8 of the paper.
                let drag = rolling[i] * sign + half * Self::friction(c, j, speed[n], sign);
                impulse[n] += stiff * ahead[n] - h * (radius * force[i][0] + drag);
            }
            // The belt's impulse that keeps both wheels at one speed, or as much of it as the belt passes.
            let both = inertia[0] * inertia[1];
            let sum = inertia[0] + inertia[1];
            let inverse = T::one() / (both * sum);
            let per_inertia = [inertia[1] * sum * inverse, inertia[0] * sum * inverse];
            let gap = speed[1] - speed[0] + impulse[1] * per_inertia[1] - impulse[0] * per_inertia[0];
            let most = if is_coupled { c.belt_limit[j] * h } else { T::zero() };
            let belt = (gap * both * both * inverse).max(-most).min(most);
            let change = [(impulse[0] + belt) * per_inertia[0], (impulse[1] - belt) * per_inertia[1]];
            for n in 0..2 {
                let i = j + 2 * n;
                force[i][0] += stiffness[i] * (c.radius[i] * change[n] - ahead[n]);
            }
            s.passive[j] = speed[0] + change[0];
            let rear = speed[1] + change[1];
            s.wheel_speed[j] = if is_coupled { rear } else { half * (s.passive[j] + rear) };
            s.wheel_angle[j] += h * s.wheel_speed[j];
        }
        self.move_body(s, &force, c);
    }

    /// One step of a speed-driven robot: the wheels turn at `speed` and change it at `rate`;
    /// the torque that this takes is left in [`State::needed`].
    pub fn step_at_speed(&self, s: &mut State<T>, speed: [T; 2], rate: [T; 2]) {
        let h = self.step;
        s.wheel_speed = speed;
        self.turn_passive(s, speed);
        let mut changed;
        let c = if self.active.is_empty() && self.disturbance.is_none() {
            &self.coefficients
        } else {
            changed = self.coefficients;
            self.change(s, s.needed.map(|t| t * self.robot.drive.gain), &mut changed);
            &changed
        };
        if self.robot.chassis == Chassis::Differential {
            return self.step_on_casters_at_speed(s, speed, rate, c);
        }
        let Contacts { force, rolling, .. } = self.contacts(s, c);
        let inertia = self.robot.side_inertia();
        for j in 0..2 {
            let sign = smooth_sign(speed[j] * real(1.0 / FRICTION_REST));
            s.needed[j] = inertia * rate[j] + Self::friction(c, j, speed[j], sign);
            for i in [j, j + 2] {
                s.needed[j] += rolling[i] * sign + c.radius[i] * force[i][0];
            }
            s.needed[j] = (s.needed[j] - c.torque[j]) / self.robot.drive.gain;
            s.wheel_angle[j] += h * speed[j];
        }
        self.move_body(s, &force, c);
    }

    #[inline(always)]
    pub(crate) fn move_body(&self, s: &mut State<T>, force: &[[T; 2]; 4], c: &Coefficients<T>) {
        let (h, half) = (self.step, real::<T>(0.5));
        let mut total = c.force;
        let mut ground = [T::zero(); 2];
        let mut moment = c.moment;
        for (f, [x, y]) in force.iter().zip(self.stance.wheel) {
            ground[0] += f[0];
            ground[1] += f[1];
            moment += x * f[1] - y * f[0];
        }
        total[0] += ground[0];
        total[1] += ground[1];
        let w = s.yaw_rate;
        s.specific = [total[0] * self.inverse_mass, total[1] * self.inverse_mass];
        s.rate = [
            s.specific[0] + c.tilt[0] + w * s.velocity[1],
            s.specific[1] + c.tilt[1] - w * s.velocity[0],
            moment * self.inverse_yaw_inertia,
        ];
        s.yaw_rate += h * s.rate[2];
        s.velocity[0] += h * s.rate[0];
        s.velocity[1] += h * s.rate[1];
        // Velocity of the geometric centre, then the pose; the heading turns by a small angle and stays a unit vector.
        let v = self.velocity(s);
        let [c, n] = s.heading;
        s.position[0] += h * (v[0] * c - v[1] * n);
        s.position[1] += h * (v[0] * n + v[1] * c);
        let turn = h * half * (w + s.yaw_rate);
        let (cd, sd) = (T::one() - half * turn * turn, turn - turn * turn * turn * real(1.0 / 6.0));
        let (c2, n2) = (c * cd - n * sd, n * cd + c * sd);
        let fix = real::<T>(1.5) - half * (c2 * c2 + n2 * n2);
        s.heading = [c2 * fix, n2 * fix];
        s.time += h;
    }

    /// Velocity of the geometric centre in body axes, m/s.
    #[inline(always)]
    pub fn velocity(&self, s: &State<T>) -> [T; 2] {
        let (w, com) = (s.yaw_rate, &self.robot.com);
        [s.velocity[0] + w * com[1], s.velocity[1] - w * com[0]]
    }

    /// What ideal sensors show, before any sensor effect.
    #[inline(always)]
    pub fn readings(&self, s: &State<T>) -> Readings<T> {
        let (w, dw, com) = (s.yaw_rate, s.rate[2], &self.robot.com);
        Readings {
            wheel_speed: s.wheel_speed,
            gyro: w,
            velocity: self.velocity(s),
            accel: [s.specific[0] + dw * com[1] + w * w * com[0], s.specific[1] - dw * com[0] + w * w * com[1]],
            torque: s.needed,
        }
    }

    /// Adds what the active effects do to the sensors.
    #[inline(always)]
    pub fn sense(&self, readings: &mut Readings<T>) {
        for a in self.active.iter().filter(|a| a.senses) {
            a.sense(readings);
        }
    }
}
