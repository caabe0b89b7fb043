//! What is kept, and that keeping it leaves every certificate as it is.

use identifier::{Ledger, Memory, MemorySettings, Midpoint, Retaining, Sample};
use proptest::prelude::*;

use super::{POLE, UNITS, Weights, decades, dot, midpoint_system, norm, regressor, weights};

const SETTINGS: MemorySettings<f64> = MemorySettings { bandwidth: 30.0, forgetting: 0.0, ridge: 1e-6 };

fn retaining(settings: MemorySettings<f64>) -> Retaining<f64, UNITS> {
    Retaining::new(POLE, Midpoint::new(500.0).expect("valid"), 0.0, settings).expect("valid")
}

#[test]
fn settings_that_cannot_work_are_refused() {
    let refused = |s: MemorySettings<f64>| Memory::<f64, 2>::new(s).expect_err("must be refused").to_string();
    assert!(refused(MemorySettings { bandwidth: 0.0, ..SETTINGS }).contains("bandwidth"));
    assert!(refused(MemorySettings { ridge: f64::NAN, ..SETTINGS }).contains("ridge"));
    assert!(refused(MemorySettings { forgetting: -1.0, ..SETTINGS }).contains("forgetting"));
}

#[test]
fn input_that_is_not_finite_leaves_the_weights_finite() {
    let mut memory = Memory::<f64, 2>::new(SETTINGS).expect("valid");
    let sample = Sample { start: 0.0, end: 0.1, regressor: [1.0, 0.5], known: 0.0, h: 1e-2 };
    memory.learn(POLE, &sample);
    let learned = memory.weight();
    memory.learn(POLE, &Sample { regressor: [f64::NAN, 0.0], ..sample });
    assert_eq!(memory.weight(), learned);
}

#[test]
fn old_samples_fade_at_the_rate_of_forgetting() {
    // A weight that changes from 1 to 3: the memory follows in the time it keeps, a memory for ever takes the mean.
    let after = |forgetting: f64| {
        let mut memory = Memory::<f64, 1>::new(MemorySettings { forgetting, ..SETTINGS }).expect("valid");
        let h = 1e-2;
        for k in 0..2000 {
            let x = if k < 1000 { 1.0 } else { 3.0 } / POLE;
            memory.learn(POLE, &Sample { start: x, end: x, regressor: [1.0], known: 0.0, h });
        }
        memory.weight()[0]
    };
    assert!((after(0.0) - 2.0).abs() < 0.05, "{}", after(0.0));
    assert!((after(1.0) - 3.0).abs() < 0.01, "{}", after(1.0));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn weights_that_explain_everything_are_found(
        truth in weights(),
        h in decades(1e-2, 1e-1),
        steps in prop::collection::vec(regressor(), 100..200),
    ) {
        let mut memory = Memory::new(MemorySettings { ridge: 1e-9, ..SETTINGS }).expect("valid");
        let mut x = 0.0;
        for phi in steps {
            let next = midpoint_system(x, dot(&truth, &phi), h);
            memory.learn(POLE, &Sample { start: x, end: next, regressor: phi, known: 0.0, h });
            x = next;
        }
        for (found, truth) in memory.weight().iter().zip(&truth) {
            prop_assert!((found - truth).abs() < 1e-2 * (1.0 + truth.abs()), "{found} {truth}");
        }
    }

    #[test]
    fn certificates_hold_with_a_memory_and_its_weights_are_bounded(
        comparison in weights(),
        h in decades(1e-4, 1.0),
        forgetting in 0.0..2.0_f64,
        ridge in decades(1e-4, 1.0),
        steps in prop::collection::vec((regressor(), -10.0..10.0_f64), 2..80),
    ) {
        let mut identifier = retaining(MemorySettings { forgetting, ridge, ..SETTINGS });
        let mut ledger = Ledger::new(POLE);
        let (mut x, mut squares) = (0.0, 0.0);
        let mut filtered = 0.0;
        for (phi, next) in steps {
            let sample = Sample { start: x, end: next, regressor: phi, known: 0.0, h };
            let step = identifier.follow(&sample);
            let c = identifier.certificate(&step, &comparison);
            prop_assert!(c.residual <= 1e-10, "{c:?}");
            ledger.add(&c);
            let share = SETTINGS.bandwidth * h / (1.0 + SETTINGS.bandwidth * h);
            filtered += share * ((next - x) / h + POLE * 0.5 * (next + x) - filtered);
            squares += h * filtered * filtered;
            let kept: Weights = identifier.memory().weight();
            prop_assert!(norm(&kept) <= (squares / ridge).sqrt() / 2.0 * (1.0 + 1e-6), "{kept:?}");
            x = next;
        }
        prop_assert!(ledger.holds(), "{ledger:?}");
    }
}

#[test]
fn single_precision_keeps_learning_for_long() {
    let settings = MemorySettings { bandwidth: 30.0_f32, forgetting: 0.01, ridge: 1e-3 };
    let mut identifier =
        Retaining::<f32, 2>::new(8.0, Midpoint::new(500.0).expect("valid"), 0.0, settings).expect("valid");
    let (h, mut x) = (1e-3_f32, 0.0_f32);
    for k in 0..200_000_u32 {
        let phase = (k % 6283) as f32 * 1e-3;
        let phi = [1.0, phase.sin()];
        let next = ((1.0 - 4.0 * h) * x + h * (4.0 * phi[0] - 2.0 * phi[1])) / (1.0 + 4.0 * h);
        identifier.follow(&Sample { start: x, end: next, regressor: phi, known: 0.0, h });
        x = next;
    }
    let [a, b] = identifier.memory().weight();
    assert!((a - 4.0).abs() < 0.01 && (b + 2.0).abs() < 0.01, "{a} {b}");
}
