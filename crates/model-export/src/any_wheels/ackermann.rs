//! Angles of steered wheels over that of their joint.

use nalgebra::{Matrix5, Vector5};
use robot_model::wheels::{Joint, Wheel};

/// Angle of a joint up to which the polynomial is fitted, rad: steering of usual cars ends there (guess).
pub(super) const FARTHEST: f64 = 0.8;

/// Coefficients below this are none, 1/rad^k.
const ROUNDING: f64 = 1e-12;

/// Angle of a wheel where its joint has this one, rad (Ackermann: axles meet on the line of the axle that is not steered).
pub(super) fn angle(joint: &Joint<f64>, wheel: &Wheel<f64>, of_joint: f64) -> f64 {
    let (sin, cos) = of_joint.sin_cos();
    let length = joint.place[0] - joint.about;
    let across = wheel.place[1] - joint.place[1];
    let ahead = length.signum();
    let [x, y] = [length * cos - across * sin, (wheel.place[0] - joint.about) * sin].map(|v| v * ahead);
    y.atan2(x)
}

/// Whether a wheel has the angle of its joint.
pub(super) fn is_same(joint: &Joint<f64>, wheel: &Wheel<f64>) -> bool {
    (angle(joint, wheel, FARTHEST) - FARTHEST).abs() < 1e-9 && (angle(joint, wheel, -FARTHEST) + FARTHEST).abs() < 1e-9
}

/// Coefficients of the polynomial of fourth degree through that angle at five angles of the joint (Chebyshev's).
pub(super) fn polynomial(joint: &Joint<f64>, wheel: &Wheel<f64>) -> [f64; 5] {
    let at: [f64; 5] = std::array::from_fn(|k| FARTHEST * (std::f64::consts::PI * (2.0 * k as f64 + 1.0) / 10.0).cos());
    let powers = Matrix5::from_fn(|row, column| std::iter::repeat_n(at[row], column).product::<f64>());
    let angles = Vector5::from_fn(|row, _| angle(joint, wheel, at[row]));
    // Five angles that differ determine it.
    let solved: [f64; 5] = powers.lu().solve(&angles).map_or([0.0, 1.0, 0.0, 0.0, 0.0], Into::into);
    solved.map(|c| if c.abs() < ROUNDING { 0.0 } else { c })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(place: [f64; 2]) -> Wheel<f64> {
        Wheel { place, direction: 0.0, roller: None, radius: 0.1, inertia: 0.01, motor: None, joint: Some(0) }
    }

    #[test]
    fn axles_of_steered_wheels_meet_on_the_line_of_the_fixed_axle() {
        let joint = Joint { place: [0.6, 0.0], about: 0.0, offset: 0.0, gain: 1.0, lag: 0.0 };
        for y in [0.2, -0.2] {
            let wheel = at([0.6, y]);
            assert!(!is_same(&joint, &wheel));
            let coefficients = polynomial(&joint, &wheel);
            for of_joint in [-0.7_f64, -0.3, 0.1, 0.5] {
                // cot of the wheel's angle is that of the joint's less y over the wheelbase.
                let wanted = 1.0 / (1.0 / of_joint.tan() - y / 0.6);
                let own = angle(&joint, &wheel, of_joint);
                approx::assert_abs_diff_eq!(own.tan(), wanted, epsilon = 1e-12);
                let by_powers: f64 = coefficients.iter().rev().fold(0.0, |sum, c| sum * of_joint + c);
                approx::assert_abs_diff_eq!(by_powers, own, epsilon = 2e-3);
            }
        }
        assert!(is_same(&joint, &at([0.6, 0.0])));
    }
}
