//! One step of the plant in time.

use super::rates::{Rates, Velocities};
use super::{Belt, PaperRobot, State, Tyre};
use crate::scalar::{Scalar, real};

/// The velocities of a state, in the order of [`Rates`].
#[inline(always)]
pub(super) fn velocities<T: Scalar>(s: &State<T>) -> Velocities<T> {
    [s.vx, s.vy, s.yaw_rate, s.speed[0], s.speed[1]]
}

impl<T: Scalar> PaperRobot<T> {
    /// One step of `h` seconds of the classical fourth-order Runge-Kutta scheme under the torques τ3, τ4 in N m.
    ///
    /// The velocities do not depend on the pose, so the pose is a quadrature over the four stages. The heading of the later
    /// stages is that of the first, turned by a small angle δ = h ω; the series of its sine and cosine end at δ⁷ and δ⁸,
    /// which is less than rounding up to δ = 0.05 and far less than the error of the scheme beyond.
    ///
    /// Explicit: stable while `h` times the fastest rate stays below 2.78; [`PaperRobot::step_implicit`] has no such limit.
    #[inline(always)]
    pub fn step_rk4(&self, state: &mut State<T>, torque: [T; 2], h: T) {
        self.steps_rk4(state, torque, h, 1);
    }

    /// `steps` such steps under the same torques.
    #[inline(always)]
    pub fn steps_rk4(&self, state: &mut State<T>, torque: [T; 2], h: T, steps: usize) {
        let rates = &self.rates;
        match (self.variant.belt, self.variant.tyre) {
            (Belt::Literal, Tyre::Uncoupled) => steps_of::<T, false, false>(rates, state, &torque, h, steps),
            (Belt::SideSum, Tyre::Uncoupled) => steps_of::<T, true, false>(rates, state, &torque, h, steps),
            (Belt::Literal, Tyre::Combined) => steps_of::<T, false, true>(rates, state, &torque, h, steps),
            (Belt::SideSum, Tyre::Combined) => steps_of::<T, true, true>(rates, state, &torque, h, steps),
        }
    }
}

#[inline(always)]
fn steps_of<T: Scalar, const SIDE_SUM: bool, const COMBINED: bool>(
    rates: &Rates<T>,
    state: &mut State<T>,
    torque: &[T; 2],
    h: T,
    steps: usize,
) {
    let (rates, torque) = (*rates, *torque);
    let mut s = *state;
    for _ in 0..steps {
        s = rk4::<T, SIDE_SUM, COMBINED>(&rates, &s, &torque, h);
    }
    *state = s;
}

/// Where the velocities would be after `h` seconds at the rate `k`.
#[inline(always)]
pub(super) fn moved<T: Scalar>(v: &Velocities<T>, k: &Velocities<T>, h: T) -> Velocities<T> {
    [v[0] + h * k[0], v[1] + h * k[1], v[2] + h * k[2], v[3] + h * k[3], v[4] + h * k[4]]
}

/// Sine and cosine of an angle turned on by the small angle `d`.
#[inline(always)]
fn turned<T: Scalar>((sin, cos): (T, T), d: T) -> (T, T) {
    let (one, z) = (T::one(), d * d);
    let s = d * (one - z * (real::<T>(1.0 / 6.0) - z * (real::<T>(1.0 / 120.0) - z * real(1.0 / 5040.0))));
    let c = one
        - z * (real::<T>(0.5) - z * (real::<T>(1.0 / 24.0) - z * (real::<T>(1.0 / 720.0) - z * real(1.0 / 40320.0))));
    (sin * c + cos * s, cos * c - sin * s)
}

/// A velocity in body axes, turned into the plane.
#[inline(always)]
fn in_plane<T: Scalar>(v: &Velocities<T>, (sin, cos): (T, T)) -> [T; 2] {
    [v[0] * cos - v[1] * sin, v[0] * sin + v[1] * cos]
}

#[inline(always)]
fn rk4<T: Scalar, const SIDE_SUM: bool, const COMBINED: bool>(
    rates: &Rates<T>,
    s: &State<T>,
    torque: &[T; 2],
    h: T,
) -> State<T> {
    let half = real::<T>(0.5) * h;
    let v1 = velocities(s);
    let k1 = rates.of::<SIDE_SUM, COMBINED>(&v1, torque);
    let v2 = moved(&v1, &k1, half);
    let k2 = rates.of::<SIDE_SUM, COMBINED>(&v2, torque);
    let v3 = moved(&v1, &k2, half);
    let k3 = rates.of::<SIDE_SUM, COMBINED>(&v3, torque);
    let v4 = moved(&v1, &k3, h);
    let k4 = rates.of::<SIDE_SUM, COMBINED>(&v4, torque);

    let first = s.yaw.sin_cos();
    let p1 = in_plane(&v1, first);
    let p2 = in_plane(&v2, turned(first, half * v1[2]));
    let p3 = in_plane(&v3, turned(first, half * v2[2]));
    let p4 = in_plane(&v4, turned(first, h * v3[2]));
    let sixth = h * real(1.0 / 6.0);
    let mean = |a: T, b: T, c: T, d: T| sixth * (a + real::<T>(2.0) * (b + c) + d);
    let turned_by = |i: usize| mean(v1[i], v2[i], v3[i], v4[i]);
    let gained = |i: usize| mean(k1[i], k2[i], k3[i], k4[i]);
    State {
        x: s.x + mean(p1[0], p2[0], p3[0], p4[0]),
        y: s.y + mean(p1[1], p2[1], p3[1], p4[1]),
        yaw: s.yaw + turned_by(2),
        vx: v1[0] + gained(0),
        vy: v1[1] + gained(1),
        yaw_rate: v1[2] + gained(2),
        angle: [s.angle[0] + turned_by(3), s.angle[1] + turned_by(4)],
        speed: [v1[3] + gained(3), v1[4] + gained(4)],
    }
}
