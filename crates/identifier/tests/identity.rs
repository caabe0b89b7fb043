//! Properties of the midpoint law: the exact identity, decrease without approximation error, the mean-square bound.

use identifier::{Identifier, Ledger, Midpoint};
use proptest::prelude::*;

const POLE: f64 = 8.0;

fn regressor() -> impl Strategy<Value = [f64; 6]> {
    prop::array::uniform6(-1.0..1.0_f64)
}

fn weights() -> impl Strategy<Value = [f64; 6]> {
    prop::array::uniform6(-50.0..50.0_f64)
}

/// Uniform in the logarithm between two powers of ten.
fn decades(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (low.log10()..high.log10()).prop_map(|e| 10_f64.powf(e))
}

fn identifier(gain: f64) -> Identifier<f64, 6> {
    Identifier::new(POLE, Midpoint::new(gain).expect("positive"), 0.0).expect("valid")
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn the_identity_is_exact(
        h in decades(1e-4, 10.0),
        gain in decades(0.5, 5e5),
        comparison in weights(),
        steps in prop::collection::vec((regressor(), -10.0..10.0_f64), 2..40),
    ) {
        let mut identifier = identifier(gain);
        let mut ledger = Ledger::new(POLE);
        let mut x = 0.0;
        for (phi, next) in steps {
            let step = identifier.step(x, next, &phi, h);
            let certificate = identifier.certificate(&step, &comparison);
            prop_assert!(certificate.residual <= 1e-10, "{certificate:?}");
            prop_assert!(certificate.change <= certificate.bound + 1e-10 * (certificate.before + certificate.after));
            ledger.add(&certificate);
            x = next;
        }
        prop_assert!(ledger.holds(), "{ledger:?}");
    }

    #[test]
    fn without_approximation_error_the_lyapunov_function_never_rises(
        h in decades(1e-4, 10.0),
        gain in decades(0.5, 5e5),
        truth in weights(),
        steps in prop::collection::vec(regressor(), 2..60),
    ) {
        let mut identifier = identifier(gain);
        let mut x = 1.0;
        let mut last = f64::INFINITY;
        let mut ledger = Ledger::new(POLE);
        for phi in steps {
            // The system whose midpoint rule has exactly the weights `truth`.
            let force: f64 = truth.iter().zip(&phi).map(|(w, p)| w * p).sum();
            let next = ((1.0 - 0.5 * POLE * h) * x + h * force) / (1.0 + 0.5 * POLE * h);
            let step = identifier.step(x, next, &phi, h);
            let certificate = identifier.certificate(&step, &truth);
            prop_assert!(certificate.after <= certificate.before * (1.0 + 1e-12), "{certificate:?}");
            prop_assert!(certificate.before <= last * (1.0 + 1e-12));
            last = certificate.after;
            ledger.add(&certificate);
            x = next;
        }
        // Nothing but the initial L feeds the error here.
        prop_assert!(ledger.holds(), "{ledger:?}");
    }
}
