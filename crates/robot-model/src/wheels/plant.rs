//! A step of a robot of any wheels.

use core::array::from_fn;

use crate::chassis::dragged;
use crate::contact::Plane;
use crate::plant::FRICTION_REST;
use crate::scalar::{Scalar, real, smooth_sign, smooth_sign_per};
use crate::wheels::robot::{Caster, Coupling, Robot, Wheel};
use crate::wheels::state::State;
use crate::wheels::tyre::{of_wheel, tyre};
use crate::wheels::{MOST, MOST_CASTERS};

/// Speed over which a caster's or a roller's drag changes its sign, m/s.
const DRAG_REST: f64 = 0.03;
/// Distance of a joint from the line that is not steered which counts as none, m.
const LEAST_LENGTH: f64 = 1e-30;
/// Rate over which the friction of a caster's pivot changes its sign, rad/s.
const SWING_REST: f64 = 0.5;

/// Dry friction over its size and the speed of a wheel, s/rad.
#[inline(always)]
fn dry<T: Scalar>(speed: T) -> T {
    smooth_sign_per(speed * real(1.0 / FRICTION_REST)) * real(1.0 / FRICTION_REST)
}

/// Wheels that turn at one speed.
#[derive(Debug, Clone, Copy)]
struct Group<T> {
    /// Inertia, kg m².
    inertia: T,
    /// The motor that turns it, and its share of the motor's torque.
    motor: usize,
    share: T,
    coulomb: T,
    viscous: T,
}

/// A robot of any wheels, ready to step.
#[derive(Debug, Clone)]
pub struct Plant<T> {
    pub(super) robot: Robot<T>,
    step: T,
    /// Of each wheel: its group, its place from the centre of mass, cosine and sine of its direction, and of its rollers' axle
    /// from its own.
    pub(super) group: [usize; MOST],
    pub(super) from_com: [[T; 2]; MOST],
    direction: [[T; 2]; MOST],
    roller: [[T; 2]; MOST],
    groups: [Group<T>; MOST],
    pub(super) casters: [[T; 2]; MOST_CASTERS],
    plane: Plane<T>,
    /// What is kept of motors' torques and joints' angles in a step.
    keep_torque: [T; MOST],
    keep_angle: [T; MOST],
}

/// Forces of an instant, and what they are over the speeds that make them.
struct Sum<T> {
    /// Σ Gᵀ F and what acts beside the contacts: forward, left, yaw.
    force: [T; 3],
    /// Σ Gᵀ B G, symmetric: 11, 12, 13, 22, 23, 33.
    stiffness: [T; 6],
    /// Of each group: Σ r Gᵀ B e, torque, and what its speed is divided by.
    coupled: [[T; 3]; MOST],
    torque: [T; MOST],
    inertia: [T; MOST],
}

impl<T: Scalar> Plant<T> {
    /// A plant that steps by `step` seconds.
    pub fn new(robot: &Robot<T>, step: T) -> Self {
        let zero = T::zero();
        let com = robot.com;
        let minus = |[x, y]: [T; 2]| [x - com[0], y - com[1]];
        let mut group = [0; MOST];
        let mut groups = [Group { inertia: zero, motor: 0, share: zero, coulomb: zero, viscous: zero }; MOST];
        let of_motor = |k: usize| robot.wheels.iter().flatten().filter(move |w| w.motor == Some(k)).count();
        for i in 0..MOST {
            let Some(wheel) = robot.wheels[i] else { continue };
            let motor = wheel.motor.and_then(|k| Some((k, (*robot.motors.get(k)?)?)));
            let first = robot.wheels.iter().position(|w| w.is_some_and(|w| w.motor == wheel.motor));
            let (at, share) = match motor {
                Some((_, m)) if m.coupling == Coupling::Rigid => (first.unwrap_or(i), T::one()),
                Some((k, _)) => (i, T::one() / real(of_motor(k).max(1) as f64)),
                None => (i, zero),
            };
            group[i] = at % MOST;
            let own = &mut groups[at % MOST];
            own.inertia += wheel.inertia;
            if let Some((k, m)) = motor
                && (at == i || m.coupling == Coupling::Differential)
            {
                own.inertia += m.inertia * share;
                (own.motor, own.share) = (k, share);
                (own.coulomb, own.viscous) = (m.coulomb * share, m.viscous * share);
            }
        }
        let of_wheel = |f: &dyn Fn(&Wheel<T>) -> [T; 2]| {
            from_fn(|i| robot.wheels.get(i).copied().flatten().map_or([T::one(), zero], |w| f(&w)))
        };
        let unit = |angle: T| {
            let (sin, cos) = angle.sin_cos();
            [cos, sin]
        };
        let decay = |tau: T| zero.if_less(tau, (-step / tau).exp(), zero);
        Self {
            group,
            from_com: of_wheel(&|w| minus(w.place)),
            direction: of_wheel(&|w| unit(w.direction)),
            roller: of_wheel(&|w| w.roller.map_or([T::one(), zero], unit)),
            groups,
            casters: from_fn(|i| robot.casters.get(i).copied().flatten().map_or([zero; 2], |c| minus(c.pivot))),
            plane: Plane::of(robot.contacts().map(minus)),
            keep_torque: from_fn(|k| robot.motors.get(k).copied().flatten().map_or(zero, |m| decay(m.lag))),
            keep_angle: from_fn(|k| robot.joints.get(k).copied().flatten().map_or(zero, |j| decay(j.lag))),
            robot: *robot,
            step,
        }
    }

    /// The robot.
    pub fn robot(&self) -> &Robot<T> {
        &self.robot
    }

    /// Velocity of a place in the robot, in body axes, m/s.
    pub fn velocity_of(&self, s: &State<T>, place: [T; 2]) -> [T; 2] {
        let w = s.yaw_rate;
        [s.velocity[0] - w * (place[1] - self.robot.com[1]), s.velocity[1] + w * (place[0] - self.robot.com[0])]
    }

    /// Sets the velocity of the body from that of the robot's origin, and casters as it has long dragged them.
    pub fn set_velocity(&self, s: &mut State<T>, origin: [T; 2]) {
        let (w, com) = (s.yaw_rate, self.robot.com);
        s.velocity = [origin[0] - w * com[1], origin[1] + w * com[0]];
        for (angle, at) in s.caster.iter_mut().zip(self.casters) {
            *angle = dragged([s.velocity[0] - w * at[1], s.velocity[1] + w * at[0]]);
        }
    }

    /// Sets motors and joints to what has been commanded for long.
    pub fn settle(&self, s: &mut State<T>, torque: &[T; MOST], steering: &[T; MOST]) {
        for k in 0..MOST {
            s.torque[k] = self.gain(k) * torque[k];
            s.steering[k] = self.angle(k, steering[k]);
        }
    }

    /// Advances motors and joints alone by one step.
    #[inline(always)]
    pub fn step_drives(&self, s: &mut State<T>, torque: &[T; MOST], steering: &[T; MOST]) {
        for k in 0..MOST {
            let asked = self.gain(k) * torque[k];
            s.torque[k] = asked + self.keep_torque[k] * (s.torque[k] - asked);
            let asked = self.angle(k, steering[k]);
            s.steering[k] = asked + self.keep_angle[k] * (s.steering[k] - asked);
        }
    }

    /// The direction in which a wheel's contact holds: that in which it rolls, or the axles of its rollers.
    #[inline(always)]
    pub(super) fn axis(&self, i: usize, e: [T; 2]) -> [T; 2] {
        let has_rollers = self.robot.wheels.get(i).copied().flatten().is_some_and(|w| w.roller.is_some());
        if !has_rollers {
            return e;
        }
        let [c, d] = self.roller.get(i).copied().unwrap_or([T::one(), T::zero()]);
        [-e[1] * c - e[0] * d, e[0] * c - e[1] * d]
    }

    #[inline(always)]
    fn gain(&self, k: usize) -> T {
        self.robot.motors.get(k).copied().flatten().map_or(T::zero(), |m| m.gain)
    }

    #[inline(always)]
    fn angle(&self, k: usize, asked: T) -> T {
        self.robot.joints.get(k).copied().flatten().map_or(T::zero(), |j| j.offset + j.gain * asked)
    }

    /// Direction in which each wheel rolls, in body axes.
    #[inline(always)]
    pub(super) fn directions(&self, s: &State<T>) -> [[T; 2]; MOST] {
        let mut out = self.direction;
        for (i, e) in out.iter_mut().enumerate() {
            let Some(wheel) = self.robot.wheels.get(i).copied().flatten() else { continue };
            let steered =
                wheel.joint.and_then(|k| Some((self.robot.joints.get(k).copied().flatten()?, s.steering.get(k)?)));
            let Some((joint, angle)) = steered else { continue };
            // The axle of the wheel meets that of the joint on the line of the axle that is not steered.
            let (sin, cos) = angle.sin_cos();
            let length = joint.place[0] - joint.about;
            let across = wheel.place[1] - joint.place[1];
            let along = [length * cos - across * sin, (wheel.place[0] - joint.about) * sin];
            // A joint behind that line turns its wheels, not their direction of rolling: by the sign of its distance, 1 where there is none.
            let least = real::<T>(LEAST_LENGTH);
            let ahead = (length.abs() + least) / (length + least);
            let per_length = ahead / (along[0] * along[0] + along[1] * along[1]).sqrt();
            let [c, d] = along.map(|x| x * per_length);
            *e = [c * e[0] - d * e[1], c * e[1] + d * e[0]];
        }
        out
    }

    /// One step: torques of motors and angles of joints, as commanded or measured, are held over it.
    #[inline(always)]
    pub fn step(&self, s: &mut State<T>, torque: &[T; MOST], steering: &[T; MOST]) {
        self.step_drives(s, torque, steering);
        let sum = self.forces(s);
        self.advance(s, &sum);
    }

    /// Forces, what they are over the speeds that make them, and torques.
    #[inline(always)]
    fn forces(&self, s: &State<T>) -> Sum<T> {
        let (zero, ground, h) = (T::zero(), &self.robot.ground, self.step);
        let mut sum = Sum {
            force: [zero; 3],
            stiffness: [zero; 6],
            coupled: [[zero; 3]; MOST],
            torque: [zero; MOST],
            inertia: self.groups.map(|g| g.inertia),
        };
        let load_per = [s.specific[0], s.specific[1]];
        let weight = [self.robot.mass * ground.gravity, self.robot.mass * self.robot.com[2]];
        let load = |at: [T; 2]| {
            let n = self.plane.share(at, 0) * weight[0]
                - weight[1] * (self.plane.share(at, 1) * load_per[0] + self.plane.share(at, 2) * load_per[1]);
            n.max(zero)
        };
        let directions = self.directions(s);
        let rest2 = ground.rest_speed * ground.rest_speed;

        for i in 0..MOST {
            let Some(wheel) = self.robot.wheels[i] else { continue };
            let (e, p, g) = (directions[i], self.from_com[i], self.group[i] % MOST);
            let n = load(p);
            let speed = s.wheel_speed[i];
            let rim = speed * wheel.radius;
            let slip = [rim * e[0] - s.velocity[0] + s.yaw_rate * p[1], rim * e[1] - s.velocity[1] - s.yaw_rate * p[0]];
            let peak = n * ground.adhesion;
            let (force, b) = if wheel.roller.is_some() {
                let axle = self.axis(i, e);
                let along = slip[0] * axle[0] + slip[1] * axle[1];
                let k = peak * tyre([along, zero], rim * rim + rest2, ground);
                let pushed = k * along;
                let free = slip[0] * axle[1] - slip[1] * axle[0];
                let drag = ground.roller_drag * n * smooth_sign(free * real(1.0 / DRAG_REST));
                let force = [pushed * axle[0] + drag * axle[1], pushed * axle[1] - drag * axle[0]];
                (force, [k * axle[0] * axle[0], k * axle[0] * axle[1], k * axle[1] * axle[1]])
            } else {
                let (force, per_slip) = of_wheel(slip, e, rim * rim + rest2, ground);
                (force.map(|x| peak * x), per_slip.map(|x| peak * x))
            };

            // G: the body's speeds to those of the contact, [[1, 0, −y], [0, 1, x]].
            let be = [b[0] * e[0] + b[1] * e[1], b[1] * e[0] + b[2] * e[1]];
            let turned = |v: [T; 2]| p[0] * v[1] - p[1] * v[0];
            let column = [p[0] * b[1] - p[1] * b[0], p[0] * b[2] - p[1] * b[1]];
            let add = [b[0], b[1], column[0], b[2], column[1], turned(column)];
            for (to, x) in sum.stiffness.iter_mut().zip(add) {
                *to += x;
            }
            for (to, x) in sum.coupled[g].iter_mut().zip([be[0], be[1], turned(be)]) {
                *to += wheel.radius * x;
            }
            let rolling = ground.rolling * n * wheel.radius * dry(speed);
            sum.torque[g] -= wheel.radius * (force[0] * e[0] + force[1] * e[1]) + rolling * speed;
            sum.inertia[g] += h * (wheel.radius * wheel.radius * (be[0] * e[0] + be[1] * e[1]) + rolling);
            for (to, x) in sum.force.iter_mut().zip([force[0], force[1], turned(force)]) {
                *to += x;
            }
        }
        for g in 0..MOST {
            let group = &self.groups[g];
            let speed = s.wheel_speed[g];
            let held = group.coulomb * dry(speed) + group.viscous;
            sum.torque[g] += group.share * s.torque[group.motor % MOST] - held * speed;
            sum.inertia[g] += h * held;
        }
        for k in 0..MOST_CASTERS {
            let Some(caster) = self.robot.casters[k] else { continue };
            let p = self.casters[k];
            let force = Self::caster_force(s, &caster, p, s.caster[k], load(p));
            for (to, x) in sum.force.iter_mut().zip([force[0], force[1], p[0] * force[1] - p[1] * force[0]]) {
                *to += x;
            }
        }
        let [x, y] = s.velocity;
        let drag = self.robot.drag * (x * x + y * y + real(DRAG_REST * DRAG_REST)).sqrt();
        sum.force[0] -= drag * x;
        sum.force[1] -= drag * y;
        sum
    }

    /// Force of a caster on the body, at its pivot but for the friction of that.
    #[inline(always)]
    fn caster_force(s: &State<T>, caster: &Caster<T>, p: [T; 2], angle: T, load: T) -> [T; 2] {
        let (sin, cos) = angle.sin_cos();
        let v = [s.velocity[0] - s.yaw_rate * p[1], s.velocity[1] + s.yaw_rate * p[0]];
        let ahead = v[0] * cos + v[1] * sin;
        let across = v[1] * cos - v[0] * sin;
        let rate = across / caster.trail - s.yaw_rate;
        let drag = -(caster.rolling * load * smooth_sign(ahead * real(1.0 / DRAG_REST)));
        let held = -(caster.pivot_friction / caster.trail * smooth_sign(rate * real(1.0 / SWING_REST)));
        [drag * cos - held * sin, drag * sin + held * cos]
    }

    /// All speeds after a step, then the pose.
    #[inline(always)]
    fn advance(&self, s: &mut State<T>, sum: &Sum<T>) {
        let (h, half, mass) = (self.step, real::<T>(0.5), self.robot.mass);
        let [c, n] = s.heading;
        let w = s.yaw_rate;
        let g = self.robot.ground.slope;
        // Gravity along the ground, and the axes that turn with the body.
        let apparent = [g[0] * c + g[1] * n + w * s.velocity[1], g[1] * c - g[0] * n - w * s.velocity[0]];
        let mut right =
            [h * (sum.force[0] + mass * apparent[0]), h * (sum.force[1] + mass * apparent[1]), h * sum.force[2]];
        let mut m = sum.stiffness.map(|k| h * k);
        m[0] += mass;
        m[3] += mass;
        m[5] += self.robot.yaw_inertia;
        let mut push = [T::zero(); MOST];
        let mut per = [T::zero(); MOST];
        for k in 0..MOST {
            if self.robot.wheels[k].is_none() || self.group[k] != k {
                continue;
            }
            per[k] = h / sum.inertia[k];
            push[k] = sum.torque[k] * per[k];
            let [x, y, z] = sum.coupled[k];
            let less = h * per[k];
            let squares = [x * x, x * y, x * z, y * y, y * z, z * z];
            for (to, square) in m.iter_mut().zip(squares) {
                *to -= less * square;
            }
            for (to, v) in right.iter_mut().zip(sum.coupled[k]) {
                *to += h * push[k] * v;
            }
        }
        let change = solve(m, right);
        for k in 0..MOST {
            if self.robot.wheels[k].is_none() || self.group[k] != k {
                continue;
            }
            let [x, y, z] = sum.coupled[k];
            s.wheel_speed[k] += push[k] + per[k] * (x * change[0] + y * change[1] + z * change[2]);
        }
        for i in 0..MOST {
            s.wheel_speed[i] = s.wheel_speed[self.group[i] % MOST];
            s.wheel_angle[i] += h * s.wheel_speed[i];
        }
        let per_step = T::one() / h;
        // What the contacts did to the body moves the loads of the next step.
        s.specific = [change[0] * per_step - apparent[0], change[1] * per_step - apparent[1]];
        let before = s.velocity;
        s.velocity = [before[0] + change[0], before[1] + change[1]];
        s.yaw_rate = w + change[2];
        let mean = half * (w + s.yaw_rate);
        self.swing_casters(s, h);

        // Velocity of the origin in the middle of the step, in the axes of the middle.
        let com = self.robot.com;
        let v =
            [half * (before[0] + s.velocity[0]) + mean * com[1], half * (before[1] + s.velocity[1]) - mean * com[0]];
        let turn = h * mean;
        s.turned += turn;
        let quarter = half * turn;
        let (cq, sq) = (T::one() - half * quarter * quarter, quarter - quarter * quarter * quarter * real(1.0 / 6.0));
        let (cm, sm) = (c * cq - n * sq, n * cq + c * sq);
        s.position[0] += h * (v[0] * cm - v[1] * sm);
        s.position[1] += h * (v[0] * sm + v[1] * cm);
        let (c2, n2) = (cm * cq - sm * sq, sm * cq + cm * sq);
        let fix = real::<T>(1.5) - half * (c2 * c2 + n2 * n2);
        s.heading = [c2 * fix, n2 * fix];
    }

    /// Place of a point of the robot in the world, m.
    pub fn place_of(&self, s: &State<T>, point: [T; 2]) -> [T; 2] {
        let [c, n] = s.heading;
        [s.position[0] + c * point[0] - n * point[1], s.position[1] + n * point[0] + c * point[1]]
    }
}

/// `x` of `m x = b`, `m` symmetric and positive definite: 11, 12, 13, 22, 23, 33. By hand, for lanes have no order to pivot by, which
/// nalgebra's solvers ask for.
#[inline(always)]
pub(super) fn solve<T: Scalar>(m: [T; 6], b: [T; 3]) -> [T; 3] {
    let [a11, a12, a13, a22, a23, a33] = m;
    let per = T::one() / a11;
    let (l2, l3) = (a12 * per, a13 * per);
    let (b22, b23, b33) = (a22 - l2 * a12, a23 - l2 * a13, a33 - l3 * a13);
    let (y2, y3) = (b[1] - l2 * b[0], b[2] - l3 * b[0]);
    let l = b23 / b22;
    let z = (y3 - l * y2) / (b33 - l * b23);
    let y = (y2 - b23 * z) / b22;
    [(b[0] - a12 * y - a13 * z) * per, y, z]
}
