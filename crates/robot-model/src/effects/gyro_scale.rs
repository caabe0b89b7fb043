//! Gyro scale error.

use crate::effect::export::{Residual, Way};
use crate::effect::{Effect, EffectSpec, Export, Parameter, Readings, Redundancy, Values};
use crate::scalar::Scalar;

/// ω_gyro = (1 + s) ω
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "gyro_scale",
    name: "gyro scale error",
    law: "ω_gyro = (1 + s) ω",
    seen: "The gyro turns more (less) than the robot, in proportion.",
    parameters: &[Parameter::strength("s", "-", [-0.5, 0.5], &[0.02])],
    signed: true,
    redundancy: Redundancy::GyroGain,
    interest: 0.015,
    revealed_by: "several full turns both ways",
    resembles: "effective track: only a second heading sensor tells",
    source: "sensor model",
    export: Export {
        mjcf: Way::Added("its sensors have no gain"),
        sdf: Way::Added("its sensors have no gain"),
        residual: Residual::Reading(&["y[\"gyro\"] *= 1.0 + {0}"]),
        ..Export::SENSOR
    },
    ..EffectSpec::SENSOR
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn sense(&self, v: &Values<T>, y: &mut Readings<T>) {
        y.gyro *= T::one() + v[0];
    }
}
