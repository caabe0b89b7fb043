//! Bias of the accelerometer.

use crate::effect::export::{Carrier, Residual, Way};
use crate::effect::{Effect, EffectSpec, Export, Parameter, Readings, Redundancy, Values};
use crate::scalar::Scalar;

/// a_IMU = a + b
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "accelerometer_bias",
    name: "accelerometer bias",
    law: "a_IMU = a + b",
    seen: "The accelerometer shows a push at rest, the same at every heading.",
    parameters: &[
        Parameter::strength("x", "m/s²", [-5.0, 5.0], &[0.2]),
        Parameter::strength("y", "m/s²", [-5.0, 5.0], &[0.2]),
    ],
    redundancy: Redundancy::AccelOffset,
    // Raised from 0.15 with a label in view: tyres give way, and in a development case a centre of
    // mass 86 mm to the side tilts the robot by 0.15 m/s² of gravity.
    interest: 0.3,
    rarity: 3.0,
    revealed_by: "standing still at two opposite headings",
    resembles: "imu_tilt by b/g: the same on level ground; com_offset on soft tyres; grade, \
        which turns with the heading",
    source: "sensor model",
    export: Export {
        mjcf: Way::Added("noise of its sensors has no mean"),
        sdf: Way::Held("mean of the accelerometer's noise"),
        carrier: Carrier::AccelerometerMean,
        residual: Residual::Reading(&["y[\"accel\"][0] += {0}", "y[\"accel\"][1] += {1}"]),
        ..Export::SENSOR
    },
    ..EffectSpec::SENSOR
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn sense(&self, v: &Values<T>, y: &mut Readings<T>) {
        y.accel[0] += v[0];
        y.accel[1] += v[1];
    }
}
