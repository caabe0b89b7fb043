//! Clock of a sensor that runs late.

use crate::effect::{Card, Effect, Kind, Parameter, Redundancy, Role, Scale, WHOLE};
use crate::scalar::Scalar;

/// y_shown(t) = y(t − τ)
pub struct Law;

const CARD: Card = Card {
    id: "clock_offset",
    name: "clock offset between sensors",
    kind: Kind::Sensor,
    law: "y_shown(t) = y(t − τ)",
    seen: "Samples of the IMU or of the pose are written later (earlier) than they were taken.",
    parameters: &[
        Parameter { name: "IMU", unit: "s", role: Role::Strength, bounds: [-1.0, 1.0], neutral: 0.0, probes: &[0.03], scale: Scale::Own },
        Parameter { name: "pose", unit: "s", role: Role::Strength, bounds: [-1.0, 1.0], neutral: 0.0, probes: &[0.03], scale: Scale::Own },
    ],
    signed: false,
    axes: &[],
    wears: WHOLE,
    redundancy: Redundancy::Delay,
    interest: 0.015,
    rarity: 3.0,
    revealed_by: "quick turns both ways",
    resembles: "motor_lag and transport_delay, which delay the wheels too",
    source: "sensor model",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }
}
