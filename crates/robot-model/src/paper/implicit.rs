//! A linearly implicit step for low speeds, where the slip makes the plant stiff.

use super::rates::{Rates, Velocities};
use super::step::{moved, velocities};
use super::{Belt, PaperRobot, State, Tyre};
use crate::scalar::{Scalar, real};

/// γ = 1 − 1/√2.
const GAMMA: f64 = 1.0 - core::f64::consts::FRAC_1_SQRT_2;
/// Shift of the velocities for the Jacobian, m/s or rad/s. The order does not depend on an exact Jacobian.
const SHIFT: f64 = 1e-6;

type Matrix<T> = [[T; 5]; 5];

impl<T: Scalar> PaperRobot<T> {
    /// One step of `h` seconds of the Rosenbrock scheme ROS2 under the torques τ3, τ4 in N m: for low speeds.
    ///
    /// For the velocities v with `v̇ = f(v)`, the Jacobian `J = ∂f/∂v` and `γ = 1 − 1/√2`:
    /// `(I − γ h J) k₁ = f(v)`, `(I − γ h J) k₂ = f(v + h k₁) − 2 k₁`, `v⁺ = v + h (3 k₁ + k₂)/2`.
    /// The pose is a quadrature by the trapezoidal rule, its heading that of the middle.
    ///
    /// Two stages, second order (whatever stands for J, here differences), L-stable: slip that decays within a small part of
    /// the step is damped, where [`PaperRobot::step_rk4`] would oscillate or grow.
    ///
    /// Source: Verwer, Spee, Blom & Hundsdorfer 1999, SIAM J. Sci. Comput. 20(4).
    #[inline(always)]
    pub fn step_implicit(&self, state: &mut State<T>, torque: [T; 2], h: T) {
        let rates = &self.rates;
        *state = match (self.variant.belt, self.variant.tyre) {
            (Belt::Literal, Tyre::Uncoupled) => ros2::<T, false, false>(rates, state, &torque, h),
            (Belt::SideSum, Tyre::Uncoupled) => ros2::<T, true, false>(rates, state, &torque, h),
            (Belt::Literal, Tyre::Combined) => ros2::<T, false, true>(rates, state, &torque, h),
            (Belt::SideSum, Tyre::Combined) => ros2::<T, true, true>(rates, state, &torque, h),
        };
    }
}

#[inline(always)]
fn ros2<T: Scalar, const SIDE_SUM: bool, const COMBINED: bool>(
    rates: &Rates<T>,
    s: &State<T>,
    torque: &[T; 2],
    h: T,
) -> State<T> {
    let v = velocities(s);
    let f = rates.of::<SIDE_SUM, COMBINED>(&v, torque);
    // I − γ h J, column by column.
    let scale = -(real::<T>(GAMMA / SHIFT) * h);
    let mut m = [[T::zero(); 5]; 5];
    for j in 0..5 {
        let mut shifted = v;
        shifted[j] += real(SHIFT);
        let there = rates.of::<SIDE_SUM, COMBINED>(&shifted, torque);
        for i in 0..5 {
            m[i][j] = scale * (there[i] - f[i]);
        }
        m[j][j] += T::one();
    }
    factorise(&mut m);
    let mut k1 = f;
    solve(&m, &mut k1);
    let mut k2 = rates.of::<SIDE_SUM, COMBINED>(&moved(&v, &k1, h), torque);
    for i in 0..5 {
        k2[i] -= k1[i] + k1[i];
    }
    solve(&m, &mut k2);
    let mut next = v;
    for i in 0..5 {
        next[i] += h * (real::<T>(1.5) * k1[i] + real::<T>(0.5) * k2[i]);
    }

    let half = real::<T>(0.5);
    let mean = |i: usize| half * (v[i] + next[i]);
    let (sin, cos) = (s.yaw + half * (h * mean(2))).sin_cos();
    State {
        x: s.x + h * (mean(0) * cos - mean(1) * sin),
        y: s.y + h * (mean(0) * sin + mean(1) * cos),
        yaw: s.yaw + h * mean(2),
        vx: next[0],
        vy: next[1],
        yaw_rate: next[2],
        angle: [s.angle[0] + h * mean(3), s.angle[1] + h * mean(4)],
        speed: [next[3], next[4]],
    }
}

/// LU factors in place, inverses on the diagonal. Without pivots: lanes would not agree on one, and `I − γ h J` of a plant
/// whose slip decays has a dominant diagonal.
#[inline(always)]
fn factorise<T: Scalar>(m: &mut Matrix<T>) {
    for i in 0..5 {
        m[i][i] = T::one() / m[i][i];
        for k in i + 1..5 {
            let share = m[k][i] * m[i][i];
            m[k][i] = share;
            for j in i + 1..5 {
                let taken = share * m[i][j];
                m[k][j] -= taken;
            }
        }
    }
}

#[inline(always)]
fn solve<T: Scalar>(m: &Matrix<T>, b: &mut Velocities<T>) {
    for i in 1..5 {
        for j in 0..i {
            let taken = m[i][j] * b[j];
            b[i] -= taken;
        }
    }
    for i in (0..5).rev() {
        for j in i + 1..5 {
            let taken = m[i][j] * b[j];
            b[i] -= taken;
        }
        b[i] *= m[i][i];
    }
}
