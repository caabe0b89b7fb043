//! The elementary functions against `libm`, over random and special values, and lanes against single numbers.

use proptest::prelude::*;
use scalar::{Lanes, Scalar};

/// Distance in units in the last place of `wanted`; NaN agrees with NaN only.
fn ulps(found: f64, wanted: f64) -> f64 {
    if found.is_nan() || wanted.is_nan() || found.is_infinite() || wanted.is_infinite() {
        let same = found.to_bits() == wanted.to_bits() || (found.is_nan() && wanted.is_nan());
        return if same { 0.0 } else { f64::INFINITY };
    }
    let size = wanted.abs().max(f64::MIN_POSITIVE);
    let ulp = f64::from_bits(size.to_bits() + 1) - size;
    (found - wanted).abs() / ulp
}

/// Functions with their references and their bounds in ulp; the reference has an error of up to one of its own.
type Function = (&'static str, fn(f64) -> f64, fn(Lanes<4>) -> Lanes<4>, fn(f64) -> f64, f64);
const FUNCTIONS: [Function; 6] = [
    ("exp", |x| Scalar::exp(x), |x| x.exp(), libm::exp, 2.0),
    ("exp_m1", |x| Scalar::exp_m1(x), |x| x.exp_m1(), libm::expm1, 3.0),
    ("tanh", |x| Scalar::tanh(x), |x| x.tanh(), libm::tanh, 4.0),
    ("sin", |x| Scalar::sin_cos(x).0, |x| x.sin_cos().0, libm::sin, 3.0),
    ("cos", |x| Scalar::sin_cos(x).1, |x| x.sin_cos().1, libm::cos, 3.0),
    ("logistic", |x| Scalar::logistic(x), |x| x.logistic(), |x| 1.0 / (1.0 + libm::exp(-x)), 4.0),
];

fn check(x: f64) {
    for (name, function, in_lanes, reference, bound) in FUNCTIONS {
        let (found, wanted) = (function(x), reference(x));
        let error = ulps(found, wanted);
        let absent = name == "logistic" && found.abs() < 1e-307 && wanted.abs() < 1e-307;
        assert!(error <= bound || absent, "{name}({x:e}): {found:e} instead of {wanted:e}, {error} ulp");
        let lanes = in_lanes(Lanes([x, 0.3, x, -1e9]));
        for lane in [0, 2] {
            let same = lanes.0[lane].to_bits() == found.to_bits() || (found.is_nan() && lanes.0[lane].is_nan());
            assert!(same, "{name}({x:e}): lane {lane} is {:e} instead of {found:e}", lanes.0[lane]);
        }
    }
}

#[test]
fn special_values_have_their_limits() {
    use std::f64::consts::{FRAC_PI_2, LN_2, PI};
    let sizes = [
        0.0,
        f64::MIN_POSITIVE,
        5e-324,
        1e-310,
        1e-20,
        1e-9,
        0.5 * LN_2,
        LN_2,
        1.0,
        FRAC_PI_2,
        PI,
        1e3 * PI,
        19.0,
        21.9,
        22.1,
        36.0,
        40.0,
        44.0,
        45.0,
        700.0,
        708.3,
        709.0,
        709.78,
        709.79,
        710.0,
        720.0,
        744.0,
        745.1,
        745.2,
        746.0,
        750.0,
        1e4,
        9.99e5,
        1e6,
        1e7,
        1e15,
        1e22,
        1e300,
        f64::MAX,
        f64::INFINITY,
        f64::NAN,
    ];
    for size in sizes {
        check(size);
        check(-size);
    }
    assert_eq!((Scalar::exp(f64::NEG_INFINITY), Scalar::exp(1e4_f64)), (0.0, f64::INFINITY));
    assert_eq!((Scalar::tanh(50.0_f64), Scalar::tanh(f64::NEG_INFINITY)), (1.0, -1.0));
    assert_eq!((-0.0_f64).to_bits(), Scalar::tanh(-0.0_f64).to_bits());
    assert_eq!((Scalar::logistic(1e4_f64), Scalar::logistic(-1e4_f64), Scalar::logistic(0.0_f64)), (1.0, 0.0, 0.5));
}

#[test]
fn multiples_of_a_right_angle_keep_their_digits() {
    for k in 0..600_000_u32 {
        check_angle(f64::from(k) * std::f64::consts::FRAC_PI_2);
    }
}

fn check_angle(x: f64) {
    let ((s, c), (sine, cosine)) = (Scalar::sin_cos(x), libm::sincos(x));
    assert!(ulps(s, sine) <= 3.0 && ulps(c, cosine) <= 3.0, "at {x}: {s:e} {sine:e}, {c:e} {cosine:e}");
}

#[test]
fn tanh_of_both_is_tanh_of_each() {
    for k in -4000..4000 {
        let (x, y) = (f64::from(k) * 0.01, f64::from(k) * -1e-3 + 1e-9);
        let [a, b] = f64::tanh_of_both([x, y]);
        assert!(ulps(a, libm::tanh(x)) <= 5.0 && ulps(b, libm::tanh(y)) <= 5.0, "{x} {a} {y} {b}");
        let lanes = Lanes::tanh_of_both([Lanes([x, 1.0]), Lanes([y, 0.0])]);
        assert_eq!((lanes[0].0[0].to_bits(), lanes[1].0[0].to_bits()), (a.to_bits(), b.to_bits()));
    }
    assert!(f64::tanh_of_both([f64::NAN, 1.0])[0].is_nan());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn any_bits(bits in any::<u64>()) {
        check(f64::from_bits(bits));
    }

    #[test]
    fn usual_sizes(x in -50.0..50.0_f64, exponent in -12..0_i32) {
        check(x);
        check(x * 10.0_f64.powi(exponent));
        check(x * 15.0);
        check(x * 2e4);
    }
}

#[test]
fn questions_hold_only_if_they_hold_in_every_lane() {
    let (one, mixed) = (Lanes([1.0, 1.0]), Lanes([0.5, 1.0]));
    assert!(mixed.is_at_most(one) && !mixed.is_less(one) && !Lanes([0.5, f64::NAN]).is_at_most(one));
    assert!(one.is_finite() && !Lanes([1.0, f64::INFINITY]).is_finite());
}
