//! The simulator itself as the cause, and as its own examiner: families 13 and 18.

use examiner::{Content, EffectId, Outsider};
use verdict::Verdict;

use crate::common::{settings, told};
use crate::rules::{diagnosed, no_physics_is_claimed_but};

#[test]
fn friction_bounded_by_a_box_is_unknown_or_friction_of_the_tyres() {
    let (_, d) = diagnosed(113, &settings(Content::Outsider(Outsider::FrictionBox), 16.0, 0));
    no_physics_is_claimed_but(&d, &[EffectId::TurningResistance]);
    assert_ne!(d.verdict, Verdict::NoMismatch, "{}", told(&d));
}

#[test]
fn coarse_explicit_steps_are_not_taken_for_physics() {
    // Seeds 213, 413 and 513 draw steps that the noise drowns.
    let (drawn, d) = diagnosed(613, &settings(Content::Outsider(Outsider::ExplicitSteps), 16.0, 0));
    assert!(!drawn.truth.below_noise, "{:?}", drawn.truth.effects);
    no_physics_is_claimed_but(&d, &[]);
}

// All families rest on this: a law or an integrator shared with the diagnosis would find itself again.
#[test]
fn the_truth_is_made_by_other_code_than_the_diagnosis() {
    let manifest = include_str!("../../crates/examiner/Cargo.toml");
    for shared in ["robot-model", "diagnosis", "sim", "identifier", "controller", "lacuna"] {
        let used = manifest.lines().any(|l| l.split(['.', ' ', '=']).next() == Some(shared));
        assert!(!used, "the examiner uses {shared}");
    }
}
