//! The skeleton that `cargo xtask effect` writes: it passes what every effect must pass once its law is there.

use robot_model::effect::{Coefficients, EffectSpec, OperatingPoint, Values};
use robot_model::{Effect, Scalar};

use crate::{finite, neutral, proportion, skeleton, specs};

/// The skeleton with a law.
struct WithLaw;

impl<T: Scalar> Effect<T> for WithLaw {
    fn spec(&self) -> &'static EffectSpec {
        &skeleton::SPEC
    }

    fn apply(&self, v: &Values<T>, _at: &OperatingPoint<T>, c: &mut Coefficients<T>) {
        c.force[0] -= v[0];
    }
}

#[test]
fn a_skeleton_is_sound_and_does_nothing_before_its_law_is_there() {
    specs::is_sound(&skeleton::SPEC);
    neutral::changes_nothing::<f64>(&skeleton::Law);
    assert_eq!(finite::failures_at_corners(&skeleton::Law), Vec::<String>::new());
    assert_eq!(proportion::moved_by(&skeleton::Law), 0.0);
}

#[test]
fn a_skeleton_passes_once_its_law_is_there() {
    neutral::changes_nothing::<f64>(&WithLaw);
    assert_eq!(finite::failures_at_corners(&WithLaw), Vec::<String>::new());
    assert!(proportion::moved_by(&WithLaw) > proportion::LEAST);
    proportion::is_proportional(&WithLaw, 0);
}
