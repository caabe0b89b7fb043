//! Torque constant.

use crate::effect::export::Way;
use crate::effect::{Effect, EffectSpec, Export, Parameter, Values};
use crate::robot::Robot;
use crate::scalar::Scalar;

/// T = (1 + κ) T_logged on both sides
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "torque_constant",
    name: "torque constant",
    law: "T = (1 + κ) T_logged on both sides",
    seen: "Everything takes less (more) current than it should, in the same proportion.",
    parameters: &[Parameter::strength("κ", "-", [-0.8, 2.0], &[-0.08])],
    signed: true,
    interest: 0.045,
    revealed_by: "hard acceleration of the unloaded robot",
    resembles: "payload together with friction: exact if all are unknown",
    source: "motor equation",
    export: Export { mjcf: Way::Held("gain of the actuators"), ..Export::DRIVE },
    ..EffectSpec::COMMAND
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn robot(&self, v: &Values<T>, r: &mut Robot<T>) {
        r.drive.gain *= T::one() + v[0];
    }
}
