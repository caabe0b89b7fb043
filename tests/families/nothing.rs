//! Nothing is missing, or nothing that shows: families 1, 4 and 7.

use examiner::{EffectId, Setting, Settings, Severity};

use crate::rules::{diagnosed, is_named, nothing_is_missing, strong};

#[test]
fn nothing_missing_is_no_mismatch() {
    nothing_is_missing(&diagnosed(101, &strong(&[])).1);
}

#[test]
fn friction_that_differs_from_run_to_run_is_no_mismatch() {
    let settings = Settings { setting: Some(Setting::Weak), ..strong(&[]) };
    nothing_is_missing(&diagnosed(201, &settings).1);
}

#[test]
fn constants_that_moved_within_a_third_of_their_sigma_are_re_tuned_and_not_named() {
    for seed in [301, 401] {
        nothing_is_missing(&diagnosed(seed, &Settings { moved: 0.3, ..strong(&[]) }).1);
    }
}

#[test]
fn constants_that_moved_within_their_sigma_are_re_tuned_and_not_named() {
    for seed in [301, 401] {
        nothing_is_missing(&diagnosed(seed, &Settings { moved: 1.0, ..strong(&[]) }).1);
    }
}

#[test]
fn an_effect_below_the_noise_is_not_named() {
    for (seed, effect) in [(104, EffectId::CoulombSide), (204, EffectId::Grade)] {
        let faint = Settings { severity: Some(Severity::Mild), size: 0.03, least_excess: 0.0, ..strong(&[effect]) };
        let (drawn, d) = diagnosed(seed, &faint);
        assert!(drawn.truth.below_noise, "{:?}", drawn.truth.effects);
        nothing_is_missing(&d);
    }
}

// The diagnosis knows torques only: no reference of a controller is logged in any case.
#[test]
fn another_gain_of_the_controller_is_no_mismatch() {
    for (seed, gain) in [(107, 0.5), (207, 2.0)] {
        nothing_is_missing(&diagnosed(seed, &Settings { controller_gain: gain, ..strong(&[]) }).1);
    }
}

#[test]
fn another_gain_of_the_controller_hides_no_effect() {
    let settings = Settings { controller_gain: 0.5, ..strong(&[EffectId::Payload]) };
    is_named(&diagnosed(307, &settings).1, EffectId::Payload);
}
