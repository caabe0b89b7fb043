//! No drive in which the simulation was right: the robot file stands in its place.

use examiner::{Content, EffectId, Outsider, Settings};
use inference::{Options, SearchForLaw};
use verdict::{Claim, Diagnosis};

use crate::common::{self, case_of, draw, settings, told};
use crate::rules::{are_in_the_first_three, diagnosed, is_named, nothing_is_missing, strong};

/// The answer to a drawn case without its references, and whether a law is looked for.
fn searched(seed: u64, settings: &Settings, law: SearchForLaw) -> Diagnosis {
    let mut case = case_of(&draw(settings, seed));
    case.references.clear();
    let d = common::answer(&case, &Options { law, ..Options::default() });
    eprintln!("seed {seed}, no reference: {}", told(&d));
    d
}

fn without_references(seed: u64, settings: &Settings) -> Diagnosis {
    searched(seed, settings, SearchForLaw::Never)
}

#[test]
fn what_hides_in_a_constant_is_named_far_beyond_its_sigma_and_nothing_is_invented() {
    for effect in [EffectId::ViscousFriction, EffectId::TorqueConstant] {
        is_named(&without_references(131, &strong(&[effect])), effect);
    }
    nothing_is_missing(&without_references(133, &strong(&[])));
}

#[test]
fn a_second_effect_that_hides_in_a_constant_is_found_beside_the_first() {
    let both = [EffectId::Grade, EffectId::Stiction];
    are_in_the_first_three(&without_references(134, &strong(&both)), &both);
}

#[test]
fn wheels_out_of_true_that_press_harder_are_named() {
    let (_, d) = diagnosed(135, &Settings { other_laws: true, ..strong(&[EffectId::WheelEccentricity]) });
    is_named(&d, EffectId::WheelEccentricity);
}

#[test]
fn what_has_no_name_is_told_as_a_law_and_none_is_looked_for_where_the_answer_is_another() {
    let ratchet = settings(Content::Outsider(Outsider::Ratchet), 16.0, 0);
    let d = searched(137, &ratchet, SearchForLaw::Unknown);
    let found = d.law.as_ref().expect("a search");
    let law = found.law.as_ref().unwrap_or_else(|| panic!("{}", told(&d)));
    assert_eq!((found.claim, law.place.as_str()), (Claim::Law, "torque on both sides"), "{}", told(&d));
    assert_eq!(law.in_references, None);

    let d = searched(132, &strong(&[]), SearchForLaw::Always);
    nothing_is_missing(&d);
    assert_eq!(d.law, None, "{}", told(&d));
}
