//! Properties 7 and 8: forward Euler as it is.

use identifier::{Euler, Exponential, Identifier, Law, Midpoint};
use proptest::prelude::*;

use super::{POLE, UNITS, decades, dot, identifier, regressor, weights};

/// The next output of a system with weights `truth`, advanced by Euler as the identifier is: no approximation error.
fn system(x: f64, force: f64, h: f64) -> f64 {
    x + h * (force - POLE * x)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn below_its_largest_step_euler_raises_l_by_little(
        share in 0.01..1.0_f64,
        gain in decades(0.5, 5e3),
        truth in weights(),
        steps in prop::collection::vec(regressor(), 2..60),
    ) {
        let law = Euler::new(gain).expect("valid");
        let h = share * law.largest_step(POLE, UNITS as f64);
        let mut identifier = identifier(law);
        let mut x = 1.0;
        for phi in steps {
            let next = system(x, dot(&truth, &phi), h);
            let step = identifier.step(x, next, &phi, h);
            let c = identifier.certificate(&step, &truth);
            let e = dot(&truth, &phi) - dot(&step.before.weight, &phi);
            prop_assert!(c.change <= 0.5 * h * h * (1.0 + POLE * h) * e * e + 1e-10 * c.before, "{c:?}");
            x = next;
        }
    }
}

#[test]
fn where_the_error_is_zero_euler_raises_l_at_any_step() {
    for h in [1e-6, 1e-4, 1e-2] {
        let mut identifier = Identifier::<f64, 1, _>::new(POLE, Euler::new(500.0).expect("valid"), 0.0).expect("valid");
        let step = identifier.step(0.0, system(0.0, 2.0, h), &[1.0], h);
        let c = identifier.certificate(&step, &[2.0]);
        assert!((c.change / (0.5 * h * h * 4.0) - 1.0).abs() < 1e-9, "{c:?}");
    }
}

#[test]
fn a_frozen_regressor_is_stable_up_to_the_known_step_and_not_beyond() {
    let (gain, phi) = (500.0, [1.0; UNITS]);
    let threshold = POLE / (gain * dot(&phi, &phi));
    let size = |h: f64| {
        let mut identifier = identifier(Euler::new(gain).expect("valid"));
        let mut x = 1.0;
        for _ in 0..20_000 {
            let next = system(x, 0.0, h);
            identifier.step(x, next, &phi, h);
            x = next;
        }
        identifier.model().output.abs().max(dot(&identifier.model().weight, &phi).abs())
    };
    assert!(size(0.9 * threshold) < 1e-6, "{}", size(0.9 * threshold));
    let beyond = size(1.1 * threshold);
    assert!(beyond > 1.0 || beyond.is_nan(), "{beyond}");
}

/// A sequence against the law: φ along the weight error, then across it, then none until the output has died away.
/// Returns the growth of ‖W̃‖² over so many cycles.
fn adversary<L: Law<f64, 2>>(law: L, cycles: usize, h: f64, next: impl Fn(f64, f64) -> f64) -> f64 {
    let mut identifier = Identifier::<f64, 2, L>::new(POLE, law, 0.0).expect("valid");
    // The right weights are (1, 0), the model's start at zero.
    let truth = [1.0, 0.0];
    let wrong = |w: &[f64; 2]| [truth[0] - w[0], truth[1] - w[1]];
    let mut x = 0.0;
    for _ in 0..cycles {
        let w = wrong(&identifier.model().weight);
        let size = w[0].hypot(w[1]);
        let along = [w[0] / size, w[1] / size];
        for phi in [along, [-along[1], along[0]]] {
            let to = next(x, truth[0] * phi[0] + truth[1] * phi[1]);
            identifier.step(x, to, &phi, h);
            x = to;
        }
        for _ in 0..400 {
            let to = next(x, 0.0);
            identifier.step(x, to, &[0.0; 2], h);
            x = to;
        }
    }
    let w = wrong(&identifier.model().weight);
    w[0] * w[0] + w[1] * w[1]
}

#[test]
fn an_adversary_makes_euler_grow_as_predicted_and_the_other_laws_not() {
    let (gain, h, cycles) = (500.0, 1e-2, 200);
    let euler = adversary(Euler::new(gain).expect("valid"), cycles, h, |x, f| system(x, f, h));
    let predicted = (1.0 + gain * gain * h.powi(4)).powi(200);
    assert!((euler / predicted - 1.0).abs() < 1e-3, "{euler} {predicted}");
    assert!(euler > 1.28);
    let midpoint = adversary(Midpoint::new(gain).expect("valid"), cycles, h, |x, f| super::midpoint_system(x, f, h));
    let exact = adversary(Exponential::new(gain).expect("valid"), cycles, h, |x, f| super::exact_system(x, f, h));
    assert!(midpoint < 1.0 && exact < 1.0, "{midpoint} {exact}");
}
