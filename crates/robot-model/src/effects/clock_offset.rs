//! Clock of a sensor that runs late.

use crate::effect::export::{Carrier, Engine, Exception, Residual, Way, When};
use crate::effect::{Effect, EffectSpec, Export, Parameter, Redundancy};
use crate::scalar::Scalar;

/// y_shown(t) = y(t − τ)
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "clock_offset",
    name: "clock offset between sensors",
    law: "y_shown(t) = y(t − τ)",
    seen: "Samples of the IMU or of the pose are written later (earlier) than they were taken.",
    parameters: &[
        Parameter::strength("IMU", "s", [-1.0, 1.0], &[0.03]),
        Parameter::strength("pose", "s", [-1.0, 1.0], &[0.03]),
    ],
    redundancy: Redundancy::Delay,
    interest: 0.015,
    rarity: 3.0,
    revealed_by: "quick turns both ways",
    resembles: "motor_lag and transport_delay, which delay the wheels too",
    source: "sensor model",
    export: Export {
        mjcf: Way::Held("delay of the sensors"),
        sdf: Way::Added("all its sensors share one clock"),
        robot_file: Way::ON_SAMPLES,
        carrier: Carrier::SensorDelay,
        residual: Residual::Words(
            "Shift the samples in time: write IMU samples {0} s and pose samples {1} s \
            after they were taken (before, where negative).",
        ),
        exceptions: &[Exception {
            engine: Some(Engine::Mjcf),
            when: When::Negative,
            why: "a sensor cannot show what has not happened yet",
        }],
        ..Export::SENSOR
    },
    ..EffectSpec::SENSOR
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }
}
