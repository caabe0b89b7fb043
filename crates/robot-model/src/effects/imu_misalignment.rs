//! IMU that is turned about the vertical.

use crate::effect::export::{Carrier, Section, Way};
use crate::effect::{Effect, EffectSpec, Export, Parameter, Readings, Redundancy, Values};
use crate::scalar::Scalar;

/// a_IMU = R(−ψ) a: the IMU's axes are turned by ψ to the left
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "imu_misalignment",
    name: "IMU turned about the vertical",
    law: "a_IMU = R(−ψ) a: the IMU's axes are turned by ψ to the left",
    seen: "Accelerating shows sideways and turning shows as acceleration.",
    parameters: &[Parameter::strength("ψ", "rad", [-0.8, 0.8], &[0.05])],
    signed: true,
    redundancy: Redundancy::AccelTurn,
    interest: 0.05,
    rarity: 3.0,
    revealed_by: "hard acceleration and fast arcs",
    resembles: "centripetal acceleration of an IMU off the centre; accelerometer_bias in drives \
        that only turn one way",
    source: "rotation about z",
    export: Export {
        section: Section::Sensors,
        mjcf: Way::Held("orientation of the accelerometer's site"),
        urdf: Way::Held("orientation of the link imu"),
        sdf: Way::Held("orientation of the IMU"),
        carrier: Carrier::AccelerometerYaw,
        ..Export::BY_CONSTANTS
    },
    ..EffectSpec::SENSOR
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn sense(&self, v: &Values<T>, y: &mut Readings<T>) {
        let (s, c) = v[0].sin_cos();
        let [x, z] = y.accel;
        y.accel = [c * x + s * z, c * z - s * x];
    }
}
