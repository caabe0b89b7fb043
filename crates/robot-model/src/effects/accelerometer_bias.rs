//! Bias of the accelerometer.

use crate::effect::{Card, Effect, Kind, Parameter, Readings, Redundancy, Role, Scale, Values, WHOLE};
use crate::scalar::Scalar;

/// a_IMU = a + b
pub struct Law;

const CARD: Card = Card {
    id: "accelerometer_bias",
    name: "accelerometer bias",
    kind: Kind::Sensor,
    law: "a_IMU = a + b",
    seen: "The accelerometer shows a push at rest, the same at every heading.",
    parameters: &[
        Parameter { name: "x", unit: "m/s²", role: Role::Strength, bounds: [-5.0, 5.0], neutral: 0.0, probes: &[0.2], scale: Scale::Own },
        Parameter { name: "y", unit: "m/s²", role: Role::Strength, bounds: [-5.0, 5.0], neutral: 0.0, probes: &[0.2], scale: Scale::Own },
    ],
    signed: false,
    axes: &[],
    wears: WHOLE,
    redundancy: Redundancy::AccelOffset,
    // Raised from 0.15 with a label in view: tyres give way, and in a development case a centre of mass 86 mm to the
    // side tilts the robot by 0.15 m/s² of gravity.
    interest: 0.3,
    rarity: 3.0,
    revealed_by: "standing still at two opposite headings",
    resembles: "imu_tilt by b/g: the same on level ground; com_offset on soft tyres; grade, which turns with the heading",
    source: "sensor model",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn sense(&self, v: &Values<T>, y: &mut Readings<T>) {
        y.accel[0] += v[0];
        y.accel[1] += v[1];
    }
}
