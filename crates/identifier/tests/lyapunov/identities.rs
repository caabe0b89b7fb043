//! Properties 1 to 3: the balances are exact, and without approximation error L never rises.

use identifier::{Euler, Exponential, Law, Leaky, Ledger, Midpoint, Projection, Rate, Scalar};
use proptest::prelude::*;

use super::{
    UNITS, Weights, cast, decades, exact_system, identifier, intervals, midpoint_system, real, regressor, weights,
};

/// The largest residual of a law's balance over intervals, and whether its mean-square bound held.
fn balance<T: Scalar, L: Law<T, UNITS>>(
    law: L,
    h: f64,
    comparison: &Weights,
    intervals: &[super::Interval],
) -> (T, bool) {
    let mut identifier = identifier::<T, L>(law);
    let mut ledger = Ledger::new(real(super::POLE));
    let mut x = T::zero();
    for (phi, next) in intervals {
        let next = real(*next);
        let step = identifier.step(x, next, &cast(phi), real(h));
        ledger.add(&identifier.certificate(&step, &cast(comparison)));
        x = next;
    }
    (ledger.worst_residual(), ledger.holds())
}

/// Rounding of a balance, relative to its terms.
const DOUBLE: f64 = 1e-10;
const SINGLE: f32 = 1e-3;

/// Checks all laws in one precision.
fn all_laws<T: Scalar>(
    h: f64,
    gain: f64,
    comparison: &Weights,
    intervals: &[super::Interval],
    tolerance: T,
) -> Result<(), TestCaseError> {
    let g: T = real(gain);
    let midpoint = Midpoint::new(g).expect("valid");
    let exponential = Exponential::new(g).expect("valid");
    let found = [
        ("midpoint", balance(midpoint, h, comparison, intervals)),
        ("exponential", balance(exponential, h, comparison, intervals)),
        ("dead zone", balance(Exponential::with_dead_zone(g, real(5.0)).expect("valid"), h, comparison, intervals)),
        ("projection", balance(Projection::new(exponential, real(20.0)).expect("valid"), h, comparison, intervals)),
        (
            "projected midpoint",
            balance(Projection::new(midpoint, real(20.0)).expect("valid"), h, comparison, intervals),
        ),
        ("sigma", balance(Leaky::new(midpoint, Rate::Sigma(real(1e-3))).expect("valid"), h, comparison, intervals)),
        ("e", balance(Leaky::new(exponential, Rate::Error(real(1e-2))).expect("valid"), h, comparison, intervals)),
    ];
    for (law, (residual, holds)) in found {
        prop_assert!(residual.is_at_most(tolerance), "{law}: residual {residual:?}");
        prop_assert!(holds, "{law}: mean-square bound");
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn every_balance_holds_at_any_step_gain_and_regressor(
        h in decades(1e-4, 10.0),
        gain in decades(0.5, 5e5),
        comparison in weights(),
        intervals in intervals(40),
    ) {
        all_laws::<f64>(h, gain, &comparison, &intervals, DOUBLE)?;
    }

    #[test]
    fn single_precision_keeps_the_balances_to_its_rounding(
        h in decades(1e-3, 0.1),
        gain in decades(0.5, 5e3),
        comparison in weights(),
        intervals in intervals(40),
    ) {
        all_laws::<f32>(h, gain, &comparison, &intervals, SINGLE)?;
    }

    #[test]
    fn the_balance_of_euler_is_exact_too(
        h in decades(1e-4, 2e-3),
        gain in decades(0.5, 5e2),
        comparison in weights(),
        intervals in intervals(40),
    ) {
        let (residual, _) = balance(Euler::new(gain).expect("valid"), h, &comparison, &intervals);
        prop_assert!(residual <= DOUBLE, "{residual}");
    }

    #[test]
    fn without_approximation_error_l_never_rises(
        h in decades(1e-4, 10.0),
        gain in decades(0.5, 5e5),
        truth in weights(),
        steps in prop::collection::vec(regressor(), 2..60),
    ) {
        let mut midpoint = identifier(Midpoint::new(gain).expect("valid"));
        let mut exponential = identifier(Exponential::new(gain).expect("valid"));
        let (mut x, mut y) = (1.0, 1.0);
        for phi in steps {
            let force = super::dot(&truth, &phi);
            let next = midpoint_system(x, force, h);
            let step = midpoint.step(x, next, &phi, h);
            let c = midpoint.certificate(&step, &truth);
            prop_assert!(c.after <= c.before * (1.0 + 1e-12), "midpoint: {c:?}");
            x = next;
            let next = exact_system(y, force, h);
            let step = exponential.step(y, next, &phi, h);
            let c = exponential.certificate(&step, &truth);
            prop_assert!(c.after <= c.before * (1.0 + 1e-12), "exponential: {c:?}");
            y = next;
        }
    }
}
