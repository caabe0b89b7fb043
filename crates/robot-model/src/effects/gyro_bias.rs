//! Gyro bias.

use crate::effect::{Card, Effect, Kind, Parameter, Readings, Redundancy, Role, Scale, Values, WHOLE};
use crate::scalar::Scalar;

/// ω_gyro = ω + b
pub struct Law;

const CARD: Card = Card {
    id: "gyro_bias",
    name: "gyro bias",
    kind: Kind::Sensor,
    law: "ω_gyro = ω + b",
    seen: "The gyro turns at rest.",
    parameters: &[
        Parameter { name: "b", unit: "rad/s", role: Role::Strength, bounds: [-1.0, 1.0], neutral: 0.0, probes: &[0.02], scale: Scale::Own },
    ],
    signed: true,
    axes: &[],
    wears: WHOLE,
    redundancy: Redundancy::GyroOffset,
    interest: 0.008,
    rarity: 0.0,
    revealed_by: "standing still",
    resembles: "a constant turn: only a second heading sensor tells",
    source: "sensor model",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn sense(&self, v: &Values<T>, y: &mut Readings<T>) {
        y.gyro += v[0];
    }
}
