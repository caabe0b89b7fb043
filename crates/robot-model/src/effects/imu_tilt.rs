//! IMU that does not lie level.

use crate::effect::{Card, Effect, Kind, Parameter, Readings, Redundancy, Role, Scale, Values, WHOLE};
use crate::scalar::{Scalar, real};

/// a_IMU = a + g sin α along each axis that points up by α
pub struct Law;

/// Gravity, m/s².
const GRAVITY: f64 = 9.81;

const CARD: Card = Card {
    id: "imu_tilt",
    name: "tilted IMU",
    kind: Kind::Sensor,
    law: "a_IMU = a + g sin α along each axis that points up by α",
    seen: "The accelerometer shows a part of gravity, the same at every heading.",
    parameters: &[
        Parameter { name: "up x", unit: "rad", role: Role::Strength, bounds: [-0.6, 0.6], neutral: 0.0, probes: &[0.03], scale: Scale::Own },
        Parameter { name: "up y", unit: "rad", role: Role::Strength, bounds: [-0.6, 0.6], neutral: 0.0, probes: &[0.03], scale: Scale::Own },
    ],
    signed: false,
    axes: &[],
    wears: WHOLE,
    redundancy: Redundancy::AccelOffset,
    interest: 0.03,
    rarity: 6.0,
    revealed_by: "the same place at two opposite headings",
    resembles: "accelerometer_bias of g sin α: the same on level ground, and the commoner; grade, which turns with the heading",
    source: "statics",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn sense(&self, v: &Values<T>, y: &mut Readings<T>) {
        for i in 0..2 {
            let a2 = v[i] * v[i];
            // sin α to fifth order: exact to the last digits within the bounds.
            y.accel[i] += real::<T>(GRAVITY) * v[i] * (T::one() - a2 / real(6.0) + a2 * a2 / real(120.0));
        }
    }
}
