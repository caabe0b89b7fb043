//! The constants a1..a8 of Eq. 8, and Eq. 8 itself.

use super::Parameters;
use crate::contact::kiencke;
use crate::scalar::{Scalar, real};

/// The constants of Eq. 8.
///
/// | constant | formula | unit |
/// |---|---|---|
/// | a1 | wheel inertia with half of the reflected motor inertia | kg m² |
/// | a2 | Coulomb torque per wheel | N m |
/// | a3 | r μ_p m g l_f / (2 L) | N m |
/// | a4 | r μ_p m h / (2 L) | kg m |
/// | a5 | r μ_p m h / (2 W) | kg m |
/// | a6, a7, a8 | (f_r / μ_p) (a3, a4, a5) | N m, kg m, kg m |
///
/// The load of a driven rear wheel is `N = (a3 + a4 a_Rx ∓ a5 a_Ry) / (r μ_p)`, with − on the left.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constants<T> {
    /// Wheel inertia, kg m².
    pub a1: T,
    /// Coulomb torque per wheel, N m.
    pub a2: T,
    /// Peak traction torque at rest, N m.
    pub a3: T,
    /// Its change per longitudinal acceleration, kg m.
    pub a4: T,
    /// Its change per lateral acceleration, kg m.
    pub a5: T,
    /// Rolling-resistance torque at rest, N m.
    pub a6: T,
    /// Its change per longitudinal acceleration, kg m.
    pub a7: T,
    /// Its change per lateral acceleration, kg m.
    pub a8: T,
    /// Slip at the peak of the adhesion λ_p.
    pub slip_at_peak: T,
    /// Width of the smooth sign, rad/s.
    pub sign_width: T,
}

impl<T: Scalar> Constants<T> {
    pub(super) fn new(p: &Parameters) -> Self {
        let traction = p.wheel_radius * p.adhesion * p.mass;
        let a3 = traction * p.gravity * p.com_to_front_axle / (2.0 * p.wheelbase);
        let a4 = traction * p.com_height / (2.0 * p.wheelbase);
        let a5 = traction * p.com_height / (2.0 * p.track);
        let resistance = p.rolling_resistance / p.adhesion;
        Self {
            a1: real(p.wheel_inertia),
            a2: real(p.coulomb_torque),
            a3: real(a3),
            a4: real(a4),
            a5: real(a5),
            a6: real(resistance * a3),
            a7: real(resistance * a4),
            a8: real(resistance * a5),
            slip_at_peak: real(p.slip_at_peak),
            sign_width: real(p.sign_width),
        }
    }

    /// The vector C of Eq. 8, N m: what the torques of the two sides must overcome besides inertia.
    ///
    /// `C = 2 a2 sgn θ̇ + 4 λp λ/(λp² + λ²) (a3 + a4 a_Rx ∓ a5 a_Ry) + 2 (a6 + a7 a_Rx ∓ a8 a_Ry) sgn θ̇`,
    /// − for the left side (wheel 3), + for the right (wheel 4), and sgn → tanh(θ̇ / width).
    ///
    /// `speed`: θ̇3, θ̇4 in rad/s; `slip`: λ3, λ4; `acceleration`: a_Rx, a_Ry in body axes, m/s².
    #[inline(always)]
    pub fn resisting_torque(&self, speed: [T; 2], slip: [T; 2], acceleration: [T; 2]) -> [T; 2] {
        self.resisting_torque_at(speed, slip.map(|s| kiencke(s, self.slip_at_peak)), acceleration)
    }

    /// The vector C for shares K of the peak adhesion that any tyre law may have given.
    #[inline(always)]
    pub(super) fn resisting_torque_at(&self, speed: [T; 2], share: [T; 2], acceleration: [T; 2]) -> [T; 2] {
        let two = real::<T>(2.0);
        let [ax, ay] = acceleration;
        let side = |i: usize, lateral: T| {
            let sign = self.sign(speed[i]);
            two * self.a2 * sign
                + two * share[i] * (self.a3 + self.a4 * ax + self.a5 * lateral)
                + two * (self.a6 + self.a7 * ax + self.a8 * lateral) * sign
        };
        [side(0, -ay), side(1, ay)]
    }

    /// Wheel accelerations by Eq. 8, `θ̈ = (τ − C) / (2 a1)`, rad/s².
    ///
    /// `torque`: τ3, τ4 in N m; the rest as in [`Constants::resisting_torque`].
    #[inline(always)]
    pub fn wheel_acceleration(&self, torque: [T; 2], speed: [T; 2], slip: [T; 2], acceleration: [T; 2]) -> [T; 2] {
        self.accelerated(torque, self.resisting_torque(speed, slip, acceleration))
    }

    /// `θ̈ = (τ − C) / (2 a1)`, rad/s².
    #[inline(always)]
    pub(super) fn accelerated(&self, torque: [T; 2], c: [T; 2]) -> [T; 2] {
        let inertia = real::<T>(2.0) * self.a1;
        [(torque[0] - c[0]) / inertia, (torque[1] - c[1]) / inertia]
    }

    /// The smooth sign of a wheel speed, `tanh(θ̇ / width)`.
    #[inline(always)]
    pub(super) fn sign(&self, speed: T) -> T {
        (speed / self.sign_width).tanh()
    }
}
