//! More than one thing at a time, or something else: families 2, 3 and 14.

use examiner::{Content, EffectId, Outsider};
use verdict::Verdict;

use crate::common::{settings, told};
use crate::rules::{are_in_the_first_three, diagnosed, nothing_is_claimed_but, strong};

#[test]
fn what_is_outside_the_library_is_unknown() {
    for (seed, outsider) in [(102, Outsider::Cogging), (202, Outsider::Gusts), (302, Outsider::ContactLoss)] {
        let (_, d) = diagnosed(seed, &settings(Content::Outsider(outsider), 16.0, 0));
        assert_eq!(d.verdict, Verdict::Unknown, "{outsider:?}: {}", told(&d));
    }
}

#[test]
fn a_sagging_battery_is_named_though_its_law_is_another() {
    let (_, d) = diagnosed(402, &settings(Content::Outsider(Outsider::VoltageSag), 16.0, 0));
    let first = &d.ranked[0].effect;
    assert!(d.verdict == Verdict::Unknown || first == "battery_sag", "{}", told(&d));
}

#[test]
fn an_effect_does_not_mask_another_that_acts_alike() {
    // Both brake, one in proportion to the speed and one always backwards; both scale with the torque.
    for (seed, pair) in [
        (103, [EffectId::ViscousFriction, EffectId::ConstantPull]),
        (203, [EffectId::TorqueConstant, EffectId::ViscousFriction]),
    ] {
        let (_, d) = diagnosed(seed, &strong(&pair));
        are_in_the_first_three(&d, &pair);
        nothing_is_claimed_but(&d, &pair);
    }
}

#[test]
fn saturation_does_not_hide_an_effect() {
    let pair = [EffectId::TorqueSaturation, EffectId::ViscousFriction];
    let (_, d) = diagnosed(114, &strong(&pair));
    are_in_the_first_three(&d, &pair);
    nothing_is_claimed_but(&d, &pair);
}
