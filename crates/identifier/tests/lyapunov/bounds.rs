//! Properties 4 to 6 and 9: what dead zone, projection and leak bound; the drift that the pure law allows.

use identifier::{Exponential, Law, Leaky, Midpoint, Projection, Rate};
use proptest::prelude::*;

use super::{POLE, UNITS, decades, dot, exact_system, identifier, norm, regressor, weights};

/// Property 9, the drift: `φ = (1 + t)^(−1/4)`, `x̃ = −c (1 + t)^(−1/2)`. Returns the largest |ε| and |x̃| and the weight at
/// the end, for a law that follows a system whose only right weight is zero.
fn drift<L: Law<f64, 1>>(law: L, gain: f64, seconds: usize) -> [f64; 3] {
    let (c, h) = (2e-4, 1e-3);
    let mut identifier = identifier::Identifier::<_, 1, L>::new(POLE, law, c).expect("valid");
    let (mut x, mut largest, mut error) = (0.0, 0.0_f64, 0.0_f64);
    // The output that makes the pure law's error what it shall be; ε is what a weight of zero leaves of it.
    for k in 0..1000 * seconds {
        let t = (k as f64 + 0.5) * h;
        let phi = (1.0 + t).powf(-0.25);
        let next_error = -c / (1.0 + t + 0.5 * h).sqrt();
        let weight = -4.0 * gain * c * ((1.0 + t).powf(0.25) - 1.0);
        // x̂ of the pure law moves by −a x̂ + Ŵ φ; the output is that and the error.
        let mid = identifier.model().output;
        let x_hat = ((1.0 - 0.5 * POLE * h) * mid + h * weight * phi) / (1.0 + 0.5 * POLE * h);
        let next = x_hat + next_error;
        largest = largest.max(((next - x) / h + POLE * 0.5 * (next + x)).abs());
        let step = identifier.step(x, next, &[phi], h);
        error = error.max(step.error_after.abs());
        x = next;
    }
    [largest, error, identifier.model().weight[0]]
}

#[test]
fn weights_of_the_pure_law_drift_while_the_error_stays_in_its_strip() {
    let gain = 500.0;
    let law = || Midpoint::new(gain).expect("valid");
    let [epsilon, error, early] = drift(law(), gain, 50);
    let [_, _, late] = drift(law(), gain, 1600);
    // The weight grows as t^(1/4): by 2.4 from 50 s to 1600 s, and on without bound.
    assert!(late.abs() > 2.0 * early.abs() && early.abs() > 0.3, "{early} {late}");
    assert!(epsilon < 4.1 * gain * 2e-4 && error < epsilon / POLE, "{epsilon} {error}");
    // A dead zone, a ball or a leak ends it.
    let [_, _, dead] = drift(Exponential::with_dead_zone(gain, 0.5).expect("valid"), gain, 1600);
    let [_, _, ball] = drift(Projection::new(law(), 0.2).expect("valid"), gain, 1600);
    let [_, _, leak] = drift(Leaky::new(law(), Rate::Sigma(1e-3)).expect("valid"), gain, 1600);
    assert_eq!(dead, 0.0);
    assert!(ball.abs() <= 0.2 * (1.0 + 1e-12) && leak.abs() < 0.5 * late.abs(), "{ball} {leak}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn with_a_dead_zone_l_never_rises_and_weights_stay_near(
        h in decades(1e-4, 10.0),
        gain in decades(0.5, 5e5),
        z in decades(1e-2, 50.0),
        truth in weights(),
        steps in prop::collection::vec((regressor(), -1.0..1.0_f64), 2..80),
    ) {
        let mut identifier = identifier(Exponential::with_dead_zone(gain, z).expect("valid"));
        let start = 3.0;
        let mut x = start;
        let first = (start - z / POLE).max(0.0);
        let limit = dot(&truth, &truth) + gain * first * first;
        for (phi, share) in steps {
            let next = exact_system(x, dot(&truth, &phi) + share * z, h);
            let step = identifier.step(x, next, &phi, h);
            let c = identifier.certificate(&step, &truth);
            prop_assert!(c.change <= 1e-10 * (c.before + c.after + z * z * h), "{c:?}");
            let gone = truth.iter().zip(&step.after.weight).map(|(t, w)| (t - w) * (t - w)).sum::<f64>();
            prop_assert!(gone <= limit * (1.0 + 1e-9), "{gone} {limit}");
            x = next;
        }
    }

    #[test]
    fn projected_weights_and_their_error_are_bounded_whatever_comes(
        h in decades(1e-4, 10.0),
        gain in decades(0.5, 5e5),
        truth in weights(),
        steps in prop::collection::vec((regressor(), -1.0..1.0_f64), 200..300),
    ) {
        let (radius, z, phi_max) = (norm(&truth).max(1.0), 20.0, (UNITS as f64).sqrt());
        let law = Projection::new(Exponential::new(gain).expect("valid"), radius).expect("valid");
        let mut identifier = identifier(law);
        let mut x = 0.0;
        for (phi, share) in steps {
            let next = exact_system(x, dot(&truth, &phi) + share * z, h);
            let step = identifier.step(x, next, &phi, h);
            prop_assert!(norm(&step.after.weight) <= radius * (1.0 + 1e-12));
            // From x̃ = 0 on, the bound on the limit superior holds all the time.
            prop_assert!(step.error_after.abs() <= (2.0 * radius * phi_max + z) / POLE * (1.0 + 1e-9), "{step:?}");
            x = next;
        }
    }

    #[test]
    fn leaking_weights_are_bounded_whatever_comes(
        h in decades(1e-4, 1.0),
        gain in decades(0.5, 5e4),
        sigma in decades(1e-3, 1.0),
        steps in prop::collection::vec((regressor(), -1.0..1.0_f64), 200..300),
    ) {
        // W* = 0: L̇ ≤ z²/(4a) − ½σ‖Ŵ‖² − …, so that ‖Ŵ‖² stays below what lets L fall, plus one step.
        let z = 20.0;
        let law = Leaky::new(Midpoint::new(gain).expect("valid"), Rate::Sigma(sigma)).expect("valid");
        let mut identifier = identifier(law);
        let (mut x, mut l) = (0.0, 0.0_f64);
        for (phi, share) in steps {
            let next = super::midpoint_system(x, share * z, h);
            let step = identifier.step(x, next, &phi, h);
            let c = identifier.certificate(&step, &[0.0; UNITS]);
            prop_assert!(c.residual <= 1e-10, "{c:?}");
            prop_assert!(c.change <= h * z * z / (4.0 * POLE) - h * sigma * dot(&step.after.weight, &step.after.weight)
                + 1e-9 * (1.0 + c.before + c.after), "{c:?}");
            l = l.max(c.after);
            x = next;
        }
        prop_assert!(l.is_finite());
    }
}
