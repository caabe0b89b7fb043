//! IMU that is turned about the vertical.

use crate::effect::{Card, Effect, Kind, Parameter, Readings, Redundancy, Role, Scale, Values, WHOLE};
use crate::scalar::Scalar;

/// a_IMU = R(−ψ) a: the IMU's axes are turned by ψ to the left
pub struct Law;

const CARD: Card = Card {
    id: "imu_misalignment",
    name: "IMU turned about the vertical",
    kind: Kind::Sensor,
    law: "a_IMU = R(−ψ) a: the IMU's axes are turned by ψ to the left",
    seen: "Accelerating shows sideways and turning shows as acceleration.",
    parameters: &[
        Parameter { name: "ψ", unit: "rad", role: Role::Strength, bounds: [-0.8, 0.8], neutral: 0.0, probes: &[0.05], scale: Scale::Own },
    ],
    signed: true,
    axes: &[],
    wears: WHOLE,
    redundancy: Redundancy::AccelTurn,
    interest: 0.05,
    rarity: 3.0,
    revealed_by: "hard acceleration and fast arcs",
    resembles: "centripetal acceleration of an IMU off the centre; accelerometer_bias in drives that only turn one way",
    source: "rotation about z",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn sense(&self, v: &Values<T>, y: &mut Readings<T>) {
        let (s, c) = v[0].sin_cos();
        let [x, z] = y.accel;
        y.accel = [c * x + s * z, c * z - s * x];
    }
}
