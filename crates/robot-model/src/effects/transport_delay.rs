//! Transport delay.

use crate::effect::export::Way;
use crate::effect::{Effect, EffectSpec, Export, Parameter, Values};
use crate::robot::Robot;
use crate::scalar::Scalar;

/// T(t) = T_logged(t − d)
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "transport_delay",
    name: "transport delay",
    law: "T(t) = T_logged(t − d)",
    seen: "Does everything right, but later.",
    parameters: &[Parameter::shaped("d", "s", [0.0, 0.5], 0.0, &[0.04, 0.09])],
    interest: 0.03,
    revealed_by: "steps of torque",
    resembles: "motor_lag in slow drives; clock offset of the recording",
    source: "pure delay",
    export: Export { mjcf: Way::Held("delay of the actuators"), ..Export::DRIVE },
    ..EffectSpec::COMMAND
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn robot(&self, v: &Values<T>, r: &mut Robot<T>) {
        r.drive.delay += v[0];
    }
}
