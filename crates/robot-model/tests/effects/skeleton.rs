//! Say in one line what it is.

use robot_model::Scalar;
use robot_model::effect::{Coefficients, Effect, EffectSpec, Export, OperatingPoint, Parameter, SizedBy, Values};

/// F = 0: write the law as a formula
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "skeleton",
    name: "new effect: skeleton",
    law: "F = 0: write the law as a formula",
    seen: "Say what one sees on the robot.",
    // Name, unit, bounds within which a fit looks, and a medium size at which it is probed.
    parameters: &[Parameter::strength("F", "N", [0.0, 100.0], &[4.0])],
    // What that grows with from robot to robot; the numbers here are those of a robot of 20 kg.
    sized_by: SizedBy::Weight,
    // The size from which somebody would act.
    interest: 2.0,
    // How rare it is: 0 common, 3 some robots have it, 6 exotic or a look-alike of a commoner one.
    rarity: 3.0,
    revealed_by: "say which drive shows it best",
    resembles: "say which effects look alike, and when",
    source: "say where the law comes from",
    // How it is written to each engine. As it stands, a sentence in the model says what to add.
    export: Export::ADDED_BY_HAND,
    ..EffectSpec::PHYSICS
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    // Write the law: change `c` by the values `v` at the operating point `at`. Until then nothing
    // happens, and the test that every effect shows in the motion fails.
    fn apply(&self, _v: &Values<T>, _at: &OperatingPoint<T>, _c: &mut Coefficients<T>) {}
}
