//! Encoder of one side whose angle jumps.

use crate::effect::export::{Residual, Way};
use crate::effect::{Effect, EffectSpec, Export, Parameter, Redundancy, Scopes};
use crate::scalar::Scalar;

/// the wheel angle jumps within a row and stays there
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "encoder_slipped_index",
    name: "slipped encoder index on one side",
    law: "the wheel angle jumps within a row and stays there",
    seen: "The wheel seems to jump while the robot drives on steadily.",
    parameters: &[Parameter::strength("jump", "rad", [-10.0, 10.0], &[0.3])],
    signed: true,
    scopes: Scopes::ONE_SIDE,
    redundancy: Redundancy::JumpingAngle,
    interest: 0.05,
    rarity: 3.0,
    revealed_by: "any drive",
    resembles: "encoder_dropout: but there the angle stands still before it jumps",
    source: "sensor model; disc slipped on its shaft, or counts lost at the index",
    export: Export {
        mjcf: Way::Added("its sensors lose nothing"),
        sdf: Way::Added("its sensors lose nothing"),
        robot_file: Way::ON_SAMPLES,
        residual: Residual::Words(
            "Add {0} rad to the {side} wheel angle from the instant at which it slips; \
            the wheel itself turns on.",
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
