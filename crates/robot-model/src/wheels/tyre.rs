//! The law of a tyre: between Kiencke's and the brush model.

use crate::contact::shape;
use crate::scalar::{Scalar, real};
use crate::wheels::robot::Ground;

/// Slip at which a brush slides whole over the slip at the peak of Kiencke's law of the same stiffness.
const WHOLE: f64 = 1.5;

/// Force over load and grip per slip speed, `K/s`.
///
/// `K = (1 − β) K_Kiencke + β K_brush` with `K_brush = 3ρ − 3ρ² + ρ³` for `ρ = 2 λ/(3 λp)` below 1, where the whole contact
/// slides, and 1 beyond: both begin with the stiffness `2/λp`.
///
/// Source: Pacejka 2012, *Tire and Vehicle Dynamics*, Section 3.2 (brush model with a parabolic pressure); β is of this crate:
/// tyres lie between the two.
#[inline(always)]
pub(super) fn tyre<T: Scalar>(slip: [T; 2], reference_speed2: T, ground: &Ground<T>) -> T {
    let (kiencke, _, inverse_s2) = shape(slip, reference_speed2, ground.slip_at_peak, ground.sliding_share);

    let s = (slip[0] * slip[0] + slip[1] * slip[1]).sqrt();
    let per_whole = T::one() / (real::<T>(WHOLE) * ground.slip_at_peak * reference_speed2.sqrt());
    let (rho, stiffness) = (s * per_whole, real::<T>(3.0) * per_whole);
    let rising = stiffness * (T::one() - rho * (T::one() - rho * real(1.0 / 3.0)));
    let brush = rho.if_less(T::one(), rising, s * inverse_s2);
    kiencke + ground.brush_share * (brush - kiencke)
}

/// Force of a wheel without rollers over load and grip, and by what it falls per slip, symmetric: 11, 12, 22; in body axes, `slip`
/// there, `e` the direction in which the wheel rolls.
///
/// Sideways the slip counts `lateral_stiffness` times: so much stiffer is the wheel there, and no less does it hold.
#[inline(always)]
pub(super) fn of_wheel<T: Scalar>(
    slip: [T; 2],
    e: [T; 2],
    reference_speed2: T,
    ground: &Ground<T>,
) -> ([T; 2], [T; 3]) {
    let kappa = ground.lateral_stiffness;
    let own = [slip[0] * e[0] + slip[1] * e[1], kappa * (slip[1] * e[0] - slip[0] * e[1])];
    let along = tyre(own, reference_speed2, ground);
    let across = kappa * along;

    // From the axes of the wheel to those of the body.
    let [x, y] = e;
    let per_slip = [along * x * x + across * y * y, (along - across) * x * y, along * y * y + across * x * x];
    let [a, b, c] = per_slip;
    ([a * slip[0] + b * slip[1], b * slip[0] + c * slip[1]], per_slip)
}
