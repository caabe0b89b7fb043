//! Gyro scale error.

use crate::effect::{Card, Effect, Kind, Parameter, Readings, Redundancy, Role, Scale, Values, WHOLE};
use crate::scalar::Scalar;

/// ω_gyro = (1 + s) ω
pub struct Law;

const CARD: Card = Card {
    id: "gyro_scale",
    name: "gyro scale error",
    kind: Kind::Sensor,
    law: "ω_gyro = (1 + s) ω",
    seen: "The gyro turns more (less) than the robot, in proportion.",
    parameters: &[
        Parameter { name: "s", unit: "-", role: Role::Strength, bounds: [-0.5, 0.5], neutral: 0.0, probes: &[0.02], scale: Scale::Own },
    ],
    signed: true,
    axes: &[],
    wears: WHOLE,
    redundancy: Redundancy::GyroGain,
    interest: 0.015,
    rarity: 0.0,
    revealed_by: "several full turns both ways",
    resembles: "effective track: only a second heading sensor tells",
    source: "sensor model",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn sense(&self, v: &Values<T>, y: &mut Readings<T>) {
        y.gyro *= T::one() + v[0];
    }
}
