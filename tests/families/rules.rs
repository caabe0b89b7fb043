//! What a family starts from, and the rules that answers are held to.

use examiner::{Content, DrawnCase, EffectId, Settings};
use inference::{Options, SearchForLaw};
use robot_model::{Kind, effects};
use torque_driven::Case;
use verdict::{Diagnosis, Verdict};

use crate::common::{self, told};

/// Above this a name is a claim.
const CONFIDENT: f64 = 0.9;

/// One or two strong effects, or none.
pub(crate) fn strong(effects: &[EffectId]) -> Settings {
    let content = if effects.is_empty() { Content::Null } else { Content::Effects(effects.to_vec()) };
    common::settings(content, 16.0, 0)
}

/// The answer to a case, printed for whoever runs the families by hand. What the rules ask are verdicts and causes, which
/// no search for a law changes: none is made.
pub(crate) fn answer(what: &str, case: &Case) -> Diagnosis {
    let out = common::answer(case, &Options { law: SearchForLaw::Never, ..Options::default() });
    eprintln!("{what}: {}", told(&out));
    out
}

/// A drawn case and its answer.
pub(crate) fn diagnosed(seed: u64, settings: &Settings) -> (DrawnCase, Diagnosis) {
    let drawn = common::draw(settings, seed);
    let hidden = drawn.truth.effects.iter();
    let hidden: Vec<_> = hidden.map(|e| format!("{} {:.3} (excess {:.2})", e.id, e.magnitude, e.excess)).collect();
    let out = answer(&format!("seed {seed}, hidden {hidden:?}"), &common::case_of(&drawn));
    (drawn, out)
}

/// The effect is the first cause.
pub(crate) fn is_named(d: &Diagnosis, effect: EffectId) {
    assert_eq!(d.verdict, Verdict::Explained, "{}", told(d));
    assert_eq!(d.ranked[0].effect, effect.id(), "{}", told(d));
    assert!(d.ranked[0].probability > 0.5, "{}", told(d));
}

/// Nothing is claimed to be missing.
pub(crate) fn nothing_is_missing(d: &Diagnosis) {
    assert_eq!(d.verdict, Verdict::NoMismatch, "{}", told(d));
    assert_eq!(d.ranked[0].effect, "none", "{}", told(d));
}

/// Nothing but these is claimed, neither physics nor faults of sensors.
pub(crate) fn nothing_is_claimed_but(d: &Diagnosis, right: &[EffectId]) {
    claims(d, right, |_| true);
}

/// No physics but these is claimed; what is said about sensors is free.
pub(crate) fn no_physics_is_claimed_but(d: &Diagnosis, right: &[EffectId]) {
    let of_sensors =
        |id: &str| effects::catalogue::<f64>().iter().any(|e| e.spec().id == id && e.spec().kind == Kind::Sensor);
    claims(d, right, |id| !of_sensors(id));
}

fn claims(d: &Diagnosis, right: &[EffectId], counts: impl Fn(&str) -> bool) {
    for c in d.ranked.iter().filter(|c| c.probability > CONFIDENT && counts(&c.effect)) {
        let fine = ["none", "unknown"].contains(&c.effect.as_str()) || right.iter().any(|e| e.id() == c.effect);
        assert!(fine, "{} is claimed: {}", c.effect, told(d));
    }
}

/// All of these are among the first three causes.
pub(crate) fn are_in_the_first_three(d: &Diagnosis, effects: &[EffectId]) {
    let first: Vec<&str> = d.ranked.iter().take(3).map(|c| c.effect.as_str()).collect();
    for effect in effects {
        assert!(first.contains(&effect.id().as_str()), "{} is missing: {}", effect.id(), told(d));
    }
}
