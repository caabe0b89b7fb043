//! Clock of a sensor that runs fast or slow.

use crate::effect::export::{Residual, Way};
use crate::effect::{Effect, EffectSpec, Export, Parameter, Redundancy};
use crate::scalar::Scalar;

/// y_shown(t) = y(t − ε t)
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "clock_drift",
    name: "clock drift between sensors",
    law: "y_shown(t) = y(t − ε t)",
    seen: "The IMU and the pose fall apart in time, the further the longer the drive lasts.",
    parameters: &[
        Parameter::strength("IMU", "-", [-0.1, 0.1], &[0.002]),
        Parameter::strength("pose", "-", [-0.1, 0.1], &[0.002]),
    ],
    redundancy: Redundancy::DelayGrowth,
    interest: 0.001,
    rarity: 6.0,
    revealed_by: "quick turns at the beginning and at the end of a long drive",
    resembles: "clock_offset over a short drive: the commoner; gyro_scale, which a drift changes \
        by its own size",
    source: "sensor model",
    export: Export {
        mjcf: Way::Added("all its sensors share one clock"),
        sdf: Way::Added("all its sensors share one clock"),
        robot_file: Way::ON_SAMPLES,
        residual: Residual::Words(
            "Stretch the clocks: write a sample that was taken at t at t (1 + {0}) for \
            the IMU and t (1 + {1}) for the pose.",
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
