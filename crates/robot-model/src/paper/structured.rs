//! Eq. 8 as a regressor: linear in numbers that mean something.

use super::Constants;
use crate::contact::kiencke;
use crate::scalar::{Scalar, real};

/// Number of terms of Eq. 8 that can be told apart.
pub const TERMS: usize = 7;

/// What the equation of one side needs to be measured or known over an interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SideSignals<T> {
    /// Wheel speed θ̇, rad/s.
    pub speed: T,
    /// Longitudinal slip λ of the driven wheel, dimensionless.
    pub slip: T,
    /// Acceleration a_R in body axes, m/s².
    pub acceleration: [T; 2],
    /// Torque τ of the side, N m.
    pub torque: T,
}

/// The terms of Eq. 8 for one side (0 left, 1 right), so that `θ̈ = wᵀ ψ`:
/// `ψ = (τ/τ₀, K, K a_x, ∓K a_y, S, S a_x, ∓S a_y)` with `K = K(λ)` and `S = tanh(θ̇/width)`, − on the left.
///
/// `w = (τ₀/(2 a1), −a3/a1, −a4/a1, −a5/a1, −(a2 + a6)/a1, −a7/a1, −a8/a1)`; see [`Structured::weights`]. λp and the width of the sign
/// are taken as known. `torque_scale`: τ₀ in N m, to keep the terms of the order of one; accelerations count in m/s².
#[inline(always)]
pub fn terms<T: Scalar>(side: usize, s: &SideSignals<T>, constants: &Constants<T>, torque_scale: T) -> [T; TERMS] {
    let share = kiencke(s.slip, constants.slip_at_peak);
    let sign = constants.sign(s.speed);
    let [ax, ay] = s.acceleration;
    let outward = if side == 0 { -ay } else { ay };
    [s.torque / torque_scale, share, share * ax, share * outward, sign, sign * ax, sign * outward]
}

/// The terms `χ` of the torque balance `τ = aᵀχ` of a side, Eq. 8 as it stands, from its [`terms`] and its acceleration θ̈,
/// rad/s². Its weights are the constants themselves; see [`Structured::to_array`].
///
/// Least squares on this form finds the constants where `θ̈ = wᵀψ` fails: torque and traction nearly cancel there, so that a
/// little noise of the slip outweighs the inertia.
#[inline(always)]
pub fn balance<T: Scalar>(terms: &[T; TERMS], acceleration: T) -> [T; TERMS] {
    let two = real::<T>(2.0);
    let mut chi = terms.map(|t| two * t);
    chi[0] = two * acceleration;
    chi
}

/// The constants of Eq. 8 that can be told apart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Structured<T> {
    /// Wheel inertia, kg m².
    pub a1: T,
    /// Peak traction torque at rest, N m.
    pub a3: T,
    /// Its change per longitudinal acceleration, kg m.
    pub a4: T,
    /// Its change per lateral acceleration, kg m.
    pub a5: T,
    /// Coulomb torque and rolling resistance at rest together, a2 + a6, N m: both act with the sign of the speed.
    pub a2_and_a6: T,
    /// Change of the rolling resistance per longitudinal acceleration, kg m.
    pub a7: T,
    /// Its change per lateral acceleration, kg m.
    pub a8: T,
}

impl<T: Scalar> Structured<T> {
    /// The same of known constants.
    pub fn of(c: &Constants<T>) -> Self {
        Self { a1: c.a1, a3: c.a3, a4: c.a4, a5: c.a5, a2_and_a6: c.a2 + c.a6, a7: c.a7, a8: c.a8 }
    }

    /// The constants as the weights of [`balance`], in the order a1, a3, a4, a5, a2 + a6, a7, a8.
    pub fn to_array(&self) -> [T; TERMS] {
        [self.a1, self.a3, self.a4, self.a5, self.a2_and_a6, self.a7, self.a8]
    }

    /// The constants from the weights of [`balance`].
    pub fn from_array([a1, a3, a4, a5, a2_and_a6, a7, a8]: [T; TERMS]) -> Self {
        Self { a1, a3, a4, a5, a2_and_a6, a7, a8 }
    }

    /// The weights of [`terms`] that these constants give.
    pub fn weights(&self, torque_scale: T) -> [T; TERMS] {
        let over = |a: T| -(a / self.a1);
        [
            torque_scale / (real::<T>(2.0) * self.a1),
            over(self.a3),
            over(self.a4),
            over(self.a5),
            over(self.a2_and_a6),
            over(self.a7),
            over(self.a8),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::{SideSignals, Structured, balance, terms};
    use crate::paper::{PaperRobot, Parameters};

    #[test]
    fn weights_of_the_constants_give_equation_8_and_back() {
        let robot = PaperRobot::<f64>::new(&Parameters::SET_C).expect("valid");
        let c = robot.constants();
        let known = Structured::of(c);
        let (speed, slip, acceleration, torque) = ([3.0, -0.02], [0.05, -0.4], [0.7, -1.1], [6.0, -2.0]);
        let expected = c.wheel_acceleration(torque, speed, slip, acceleration);
        let weight = known.weights(20.0);
        for side in 0..2 {
            let signals = SideSignals { speed: speed[side], slip: slip[side], acceleration, torque: torque[side] };
            let psi = terms(side, &signals, c, 20.0);
            let found: f64 = psi.iter().zip(&weight).map(|(p, w)| p * w).sum();
            assert!((found - expected[side]).abs() < 1e-10 * expected[side].abs(), "{found} {expected:?}");
            let chi = balance(&psi, expected[side]);
            let balanced: f64 = chi.iter().zip(known.to_array()).map(|(c, a)| c * a).sum();
            assert!((balanced - torque[side]).abs() < 1e-10, "{balanced} {torque:?}");
        }
        assert_eq!(Structured::from_array(known.to_array()), known);
    }
}
