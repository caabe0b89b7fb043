//! What is kept, and that keeping it leaves every certificate as it is.

use identifier::{
    Identifier, IdentifierError, LeastSquaresSettings, Ledger, Memory, MemorySettings, Midpoint, Retaining, Sample,
};
use proptest::prelude::*;

use super::{POLE, UNITS, Weights, decades, dot, midpoint_system, norm, regressor, weights};

/// A memory that takes over at once what it fits, so that tests need no minutes.
fn quick() -> MemorySettings<f64> {
    let default = MemorySettings::<f64>::default();
    let long = LeastSquaresSettings { lead: 0.0, forgetting: 0.0, ridge: 1e-9, ..default.long };
    MemorySettings { long, consolidation: 1e6, ..default }
}

fn retaining(settings: MemorySettings<f64>) -> Retaining<f64, UNITS> {
    let memory = Memory::new(settings).expect("valid");
    Retaining::new(POLE, Midpoint::new(500.0).expect("valid"), 0.0, memory).expect("valid")
}

/// Learns the equation that a sample shows.
fn learn<const N: usize>(memory: &mut Memory<f64, N>, sample: &Sample<f64, N>) {
    memory.learn(sample.right_hand_side(POLE), &sample.regressor, sample.h);
}

fn sample<const N: usize>(start: f64, end: f64, regressor: [f64; N], h: f64) -> Sample<f64, N> {
    Sample { start, end, regressor, known: 0.0, h }
}

#[test]
fn settings_that_cannot_work_are_refused() {
    let refused = |change: &dyn Fn(&mut MemorySettings<f64>)| {
        let mut settings = MemorySettings::default();
        change(&mut settings);
        Memory::<f64, 2>::new(settings).expect_err("must be refused").to_string()
    };
    assert!(refused(&|s| s.long.bandwidth = 0.0).contains("bandwidth"));
    assert!(refused(&|s| s.short.ridge = f64::NAN).contains("ridge"));
    assert!(refused(&|s| s.long.forgetting = -1.0).contains("forgetting"));
    assert!(refused(&|s| s.short.lead = f64::INFINITY).contains("lead"));
    assert!(refused(&|s| s.consolidation = 0.0).contains("consolidation"));
    let recalled = Memory::recalling(MemorySettings::default(), [1.0, f64::NAN]);
    assert_eq!(recalled.err(), Some(IdentifierError::NotFinite { name: "weight that is recalled" }));
}

#[test]
fn input_that_is_not_finite_leaves_the_weights_finite() {
    let mut memory = Memory::<f64, 2>::new(quick()).expect("valid");
    learn(&mut memory, &sample(0.0, 0.1, [1.0, 0.5], 1e-2));
    let learned = (memory.kept(), memory.acting());
    learn(&mut memory, &sample(0.0, 0.1, [f64::NAN, 0.0], 1e-2));
    assert_eq!((memory.kept(), memory.acting()), learned);
}

#[test]
fn old_samples_fade_at_the_rate_of_forgetting() {
    // A weight that changes from 1 to 3: the long memory follows in the time it keeps; one for ever takes the mean.
    let after = |forgetting: f64| {
        let mut settings = quick();
        settings.long.forgetting = forgetting;
        let mut memory = Memory::<f64, 1>::new(settings).expect("valid");
        for k in 0..2000 {
            let x = if k < 1000 { 1.0 } else { 3.0 } / POLE;
            learn(&mut memory, &sample(x, x, [1.0], 1e-2));
        }
        memory.kept()[0]
    };
    assert!((after(0.0) - 2.0).abs() < 0.05, "{}", after(0.0));
    assert!((after(1.0) - 3.0).abs() < 0.01, "{}", after(1.0));
}

#[test]
fn what_is_kept_acts_where_the_present_says_nothing() {
    // Two weights are learned; then only the first one's regressor is seen, with another weight.
    let mut memory = Memory::recalling(MemorySettings::default(), [4.0, -2.0]).expect("valid");
    for _ in 0..5000 {
        learn(&mut memory, &sample(0.0, 0.0, [1.0, 0.0], 1e-3));
    }
    let [seen, unseen] = memory.acting();
    assert!(seen.abs() < 0.5 * 4.0 && unseen == -2.0, "{seen} {unseen}");
    assert!(memory.kept()[0] > 3.0, "what is kept moves slowly: {}", memory.kept()[0]);
}

#[test]
fn a_memory_makes_the_next_lap_better_and_frozen_weights_predict() {
    // A system that the regressor explains, driven twice over the same course.
    let (h, truth) = (1e-3, [6.0, -3.0]);
    let course = |k: u32| {
        let t = f64::from(k) * h;
        [1.0, if t < 2.0 { 0.0 } else { 1.0 } * (2.0 * t).sin()]
    };
    let lap = |x: &mut f64, follow: &mut dyn FnMut(&Sample<f64, 2>) -> f64| {
        let mut squares = 0.0;
        for k in 0..8000 {
            let phi = course(k);
            let force = truth[0] * phi[0] + truth[1] * phi[1];
            let next = midpoint_system(*x, force, h);
            let error = follow(&sample(*x, next, phi, h));
            (*x, squares) = (next, squares + error * error);
        }
        (squares / 8000.0_f64).sqrt()
    };
    let law = Midpoint::new(500.0).expect("valid");
    let mut plain = Identifier::<_, 2>::new(POLE, law, 0.0).expect("valid");
    let memory = Memory::<f64, 2>::new(MemorySettings::default()).expect("valid");
    let mut keeps = Retaining::new(POLE, law, 0.0, memory).expect("valid");
    let mut laps = [0.0; 6];
    let mut x = 0.0;
    for rmse in &mut laps {
        *rmse = lap(&mut x, &mut |s| keeps.follow(s).error_after);
    }
    let without = lap(&mut 0.0, &mut |s| plain.follow(s).error_after);
    assert!(laps[0] < without && laps[5] < 0.5 * laps[0], "{without} {laps:?}");
    for (kept, truth) in keeps.memory().kept().iter().zip(truth) {
        assert!((kept - truth).abs() < 0.35 * truth.abs(), "{kept} {truth}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn weights_that_explain_everything_are_found(
        truth in weights(),
        h in decades(1e-2, 1e-1),
        steps in prop::collection::vec(regressor(), 100..200),
    ) {
        let mut memory = Memory::new(quick()).expect("valid");
        let mut x = 0.0;
        for phi in steps {
            let next = midpoint_system(x, dot(&truth, &phi), h);
            learn(&mut memory, &sample(x, next, phi, h));
            x = next;
        }
        for (found, truth) in memory.kept().iter().zip(&truth) {
            prop_assert!((found - truth).abs() < 1e-2 * (1.0 + truth.abs()), "{found} {truth}");
        }
    }

    #[test]
    fn certificates_hold_with_a_memory_and_what_is_kept_is_bounded(
        comparison in weights(),
        h in decades(1e-4, 1.0),
        forgetting in 0.0..2.0_f64,
        ridge in decades(1e-4, 1.0),
        steps in prop::collection::vec((regressor(), -10.0..10.0_f64), 2..80),
    ) {
        let mut settings = MemorySettings::default();
        (settings.long.forgetting, settings.long.ridge) = (forgetting, ridge);
        let mut identifier = retaining(settings);
        let mut ledger = Ledger::new(POLE);
        let (mut x, mut squares, mut filtered) = (0.0, 0.0, [0.0; 2]);
        let mut largest = 0.0_f64;
        for (phi, next) in steps {
            let step = identifier.follow(&sample(x, next, phi, h));
            let c = identifier.certificate(&step, &comparison);
            prop_assert!(c.residual <= 1e-10, "{c:?}");
            ledger.add(&c);
            let share = settings.long.bandwidth * h / (1.0 + settings.long.bandwidth * h);
            filtered[0] += share * ((next - x) / h + POLE * 0.5 * (next + x) - filtered[0]);
            filtered[1] += share * (filtered[0] - filtered[1]);
            squares += h * filtered[1] * filtered[1];
            largest = largest.max((squares / ridge).sqrt() / 2.0);
            let kept: Weights = identifier.memory().kept();
            prop_assert!(norm(&kept) <= largest * (1.0 + 1e-6), "{kept:?}");
            x = next;
        }
        prop_assert!(ledger.holds(), "{ledger:?}");
    }
}

#[test]
fn single_precision_keeps_learning_for_long() {
    let memory = Memory::<f32, 2>::new(MemorySettings::default()).expect("valid");
    let mut identifier = Retaining::new(8.0, Midpoint::new(500.0).expect("valid"), 0.0_f32, memory).expect("valid");
    let (h, mut x) = (1e-3_f32, 0.0_f32);
    for k in 0..200_000_u32 {
        let phase = (k % 6283) as f32 * 1e-3;
        let phi = [1.0, phase.sin()];
        let next = ((1.0 - 4.0 * h) * x + h * (4.0 * phi[0] - 2.0 * phi[1])) / (1.0 + 4.0 * h);
        identifier.follow(&Sample { start: x, end: next, regressor: phi, known: 0.0, h });
        x = next;
    }
    let [a, b] = identifier.memory().kept();
    assert!((a - 4.0).abs() < 0.05 && (b + 2.0).abs() < 0.05, "{a} {b}");
}
