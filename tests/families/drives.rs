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
    for (seed, effect, drive) in
        [(117, EffectId::QuadraticDrag, Manoeuvre::Loop), (217, EffectId::ViscousFriction, Manoeuvre::Straight)]
    {
        let mixed = Settings { severity: Some(Severity::Mild), ..strong(&[effect]) };
        let alike = Settings { drives: vec![drive], ..mixed.clone() };
        let ((_, mixed), (_, alike)) = (diagnosed(seed, &mixed), diagnosed(seed, &alike));
        is_named(&mixed, effect);
        nothing_is_claimed_but(&alike, &[effect]);
        let leads = [&alike, &mixed].map(|d| lead(d, effect));
        assert!(leads[0] < leads[1], "{leads:?}: {} {}", told(&alike), told(&mixed));
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
