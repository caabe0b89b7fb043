//! What the drives show and do not show: families 8 and 17.

use examiner::{EffectId, Manoeuvre, Settings, Severity};
use verdict::{Diagnosis, Trial};

use crate::common::told;
use crate::rules::{diagnosed, is_named, nothing_is_claimed_but, nothing_is_missing, strong};

#[test]
fn an_effect_that_one_recording_shows_is_named() {
    let drives = vec![Manoeuvre::Slalom, Manoeuvre::Straight, Manoeuvre::Straight];
    let settings = Settings { drives, ..strong(&[EffectId::TurningResistance]) };
    is_named(&diagnosed(108, &settings).1, EffectId::TurningResistance);
}

/// By how much the best trial leads before the best that does without the effect, nats.
fn lead(d: &Diagnosis, effect: EffectId) -> f64 {
    let has = |t: &Trial| t.hypothesis.iter().any(|h| h.starts_with(&effect.id()));
    let best = |with: bool| d.trials.iter().filter(|t| has(t) == with).map(|t| t.score).fold(0.0, f64::max);
    best(true) - best(false)
}

#[test]
fn one_kind_of_drive_widens_the_answer_and_claims_nothing_wrong() {
    let effect = EffectId::QuadraticDrag;
    let mixed = Settings { severity: Some(Severity::Mild), ..strong(&[effect]) };
    let alike = Settings { drives: vec![Manoeuvre::Loop], ..mixed.clone() };
    let ((_, mixed), (_, alike)) = (diagnosed(117, &mixed), diagnosed(117, &alike));
    is_named(&mixed, effect);
    nothing_is_claimed_but(&alike, &[effect]);
    let leads = [&alike, &mixed].map(|d| lead(d, effect));
    assert!(leads[0] < leads[1], "{leads:?}: {} {}", told(&alike), told(&mixed));
}

// Friction may have moved by as much since the references: another visit.
#[test]
fn friction_that_its_constant_can_stand_for_is_re_tuned_and_not_named() {
    let effect = EffectId::ViscousFriction;
    let mixed = Settings { severity: Some(Severity::Mild), ..strong(&[effect]) };
    for drives in [Vec::new(), vec![Manoeuvre::Straight]] {
        let (_, d) = diagnosed(217, &Settings { drives, ..mixed.clone() });
        nothing_is_claimed_but(&d, &[effect]);
        assert!(d.retuned.iter().any(|r| r.constant == "viscous" && r.to > r.from), "{:?}: {}", d.retuned, told(&d));
    }
}

#[test]
fn circles_alone_accuse_nothing() {
    let circles = Settings { drives: vec![Manoeuvre::Loop], ..strong(&[]) };
    nothing_is_missing(&diagnosed(317, &circles).1);
}

#[test]
fn circles_in_a_single_recording_accuse_nothing() {
    let circles = Settings { drives: vec![Manoeuvre::Loop], recordings: Some(1), ..strong(&[]) };
    nothing_is_missing(&diagnosed(417, &circles).1);
}
