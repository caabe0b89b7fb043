//! When it sets in: families 9 and 15.

use examiner::{EffectId, Place, Settings};
use verdict::Verdict;

use crate::common::told;
use crate::rules::{diagnosed, is_named, nothing_is_claimed_but, strong};

/// Rolling resistance that sets in between two shares of each recording.
fn sets_in(onset: [f64; 2]) -> Settings {
    Settings { place: Some(Place::Time), onset, least_excess: 0.0, ..strong(&[EffectId::RollingResistance]) }
}

#[test]
fn an_effect_that_sets_in_at_the_very_beginning_is_named() {
    is_named(&diagnosed(109, &sets_in([0.0, 0.05])).1, EffectId::RollingResistance);
}

#[test]
fn an_effect_that_sets_in_at_the_very_end_is_named_or_missed_but_never_taken_for_another() {
    let (_, d) = diagnosed(209, &sets_in([0.95, 1.0]));
    nothing_is_claimed_but(&d, &[EffectId::RollingResistance]);
    assert_ne!(d.verdict, Verdict::Unknown, "{}", told(&d));
}

#[test]
fn a_slow_drift_is_not_taken_for_a_step() {
    let (_, d) = diagnosed(115, &strong(&[EffectId::ThermalDrift]));
    is_named(&d, EffectId::ThermalDrift);
    nothing_is_claimed_but(&d, &[EffectId::ThermalDrift]);
}

#[test]
fn a_step_is_not_taken_for_a_slow_drift() {
    let (_, d) = diagnosed(215, &Settings { place: Some(Place::Time), ..strong(&[EffectId::RollingResistance]) });
    is_named(&d, EffectId::RollingResistance);
    nothing_is_claimed_but(&d, &[EffectId::RollingResistance]);
}
