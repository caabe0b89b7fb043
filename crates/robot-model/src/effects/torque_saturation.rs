//! Torque limit.

use crate::effect::export::Way;
use crate::effect::{Effect, EffectSpec, Export, Parameter, Scale, Values};
use crate::robot::Robot;
use crate::scalar::Scalar;

/// |T| ≤ T_max below the data sheet's
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "torque_saturation",
    name: "torque limit",
    law: "|T| ≤ T_max below the data sheet's",
    seen: "Lacks torque only when much is asked for.",
    parameters: &[Parameter {
        scale: Scale::LargestTorque,
        ..Parameter::shaped("T_max", "N m", [0.05, 1e9], 1e9, &[0.9, 0.7, 0.5])
    }],
    revealed_by: "hard acceleration and spins",
    resembles: "adhesion_patch when wheels would slip at that torque",
    source: "current limiting",
    export: Export {
        mjcf: Way::Held("range of the actuators' commands: the limit comes before the lag"),
        urdf: Way::Held("effort limit of the driven joints"),
        sdf: Way::Held("effort limit of the driven joints"),
        ..Export::DRIVE
    },
    ..EffectSpec::COMMAND
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn robot(&self, v: &Values<T>, r: &mut Robot<T>) {
        r.drive.limit = r.drive.limit.min(v[0]);
    }
}
