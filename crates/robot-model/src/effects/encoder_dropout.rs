//! Encoder dropout on one side.

use crate::effect::export::{Residual, Way};
use crate::effect::{Effect, EffectSpec, Export, Parameter, Redundancy, Scopes};
use crate::scalar::Scalar;

/// wheel angle frozen for short bursts, then right again
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "encoder_dropout",
    name: "encoder dropout on one side",
    law: "wheel angle frozen for short bursts, then right again",
    seen: "The wheel seems to stop and jump while the robot drives on.",
    parameters: &[Parameter::strength("share of rows", "-", [0.0, 1.0], &[0.05])],
    scopes: Scopes::ONE_SIDE,
    redundancy: Redundancy::FrozenAngle,
    interest: 0.008,
    revealed_by: "any drive",
    resembles: "slipping wheel: but the angle jumps back",
    source: "sensor model",
    export: Export {
        mjcf: Way::Added("its sensors lose nothing"),
        sdf: Way::Added("its sensors lose nothing"),
        robot_file: Way::ON_SAMPLES,
        residual: Residual::Words(
            "Freeze the {side} wheel angle in short bursts that together take a share \
            of {0} of the time; the wheel itself turns on.",
        ),
        ..Export::SENSOR
    },
    ..EffectSpec::SENSOR
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }
}
