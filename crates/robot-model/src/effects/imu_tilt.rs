//! IMU that does not lie level.

use crate::effect::export::{Carrier, Section, Way};
use crate::effect::{Effect, EffectSpec, Export, Parameter, Readings, Redundancy, Values};
use crate::scalar::{Scalar, real};

/// a_IMU = a + g sin α along each axis that points up by α
pub struct Law;

/// Gravity, m/s².
const GRAVITY: f64 = 9.81;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "imu_tilt",
    name: "tilted IMU",
    law: "a_IMU = a + g sin α along each axis that points up by α",
    seen: "The accelerometer shows a part of gravity, the same at every heading.",
    parameters: &[
        Parameter::strength("up x", "rad", [-0.6, 0.6], &[0.03]),
        Parameter::strength("up y", "rad", [-0.6, 0.6], &[0.03]),
    ],
    redundancy: Redundancy::AccelOffset,
    interest: 0.03,
    rarity: 6.0,
    revealed_by: "the same place at two opposite headings",
    resembles: "accelerometer_bias of g sin α: the same on level ground, and the commoner; \
        grade, which turns with the heading",
    source: "statics",
    export: Export {
        section: Section::Sensors,
        mjcf: Way::Held("orientation of the accelerometer's site"),
        urdf: Way::Held("orientation of the link imu"),
        sdf: Way::Held("orientation of the IMU"),
        carrier: Carrier::AccelerometerTilt,
        ..Export::BY_CONSTANTS
    },
    ..EffectSpec::SENSOR
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn sense(&self, v: &Values<T>, y: &mut Readings<T>) {
        for i in 0..2 {
            let a2 = v[i] * v[i];
            // sin α to fifth order: exact to the last digits within the bounds.
            y.accel[i] +=
                real::<T>(GRAVITY) * v[i] * (T::one() - a2 / real(6.0) + a2 * a2 / real(120.0));
        }
    }
}
