//! Gyro bias.

use crate::effect::export::{Carrier, Residual, Way};
use crate::effect::{Effect, EffectSpec, Export, Parameter, Readings, Redundancy, Values};
use crate::scalar::Scalar;

/// ω_gyro = ω + b
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "gyro_bias",
    name: "gyro bias",
    law: "ω_gyro = ω + b",
    seen: "The gyro turns at rest.",
    parameters: &[Parameter::strength("b", "rad/s", [-1.0, 1.0], &[0.02])],
    signed: true,
    redundancy: Redundancy::GyroOffset,
    interest: 0.008,
    revealed_by: "standing still",
    resembles: "a constant turn: only a second heading sensor tells",
    source: "sensor model",
    export: Export {
        mjcf: Way::Added("noise of its sensors has no mean"),
        sdf: Way::Held("mean of the gyro's noise"),
        carrier: Carrier::GyroMean,
        residual: Residual::Reading(&["y[\"gyro\"] += {0}"]),
        ..Export::SENSOR
    },
    ..EffectSpec::SENSOR
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn sense(&self, v: &Values<T>, y: &mut Readings<T>) {
        y.gyro += v[0];
    }
}
