//! Clock of a sensor that runs fast or slow.

use crate::effect::{Card, Effect, Kind, Parameter, Redundancy, Role, Scale, WHOLE};
use crate::scalar::Scalar;

/// y_shown(t) = y(t − ε t)
pub struct Law;

const CARD: Card = Card {
    id: "clock_drift",
    name: "clock drift between sensors",
    kind: Kind::Sensor,
    law: "y_shown(t) = y(t − ε t)",
    seen: "The IMU and the pose fall apart in time, the further the longer the drive lasts.",
    parameters: &[
        Parameter { name: "IMU", unit: "-", role: Role::Strength, bounds: [-0.1, 0.1], neutral: 0.0, probes: &[0.002], scale: Scale::Own },
        Parameter { name: "pose", unit: "-", role: Role::Strength, bounds: [-0.1, 0.1], neutral: 0.0, probes: &[0.002], scale: Scale::Own },
    ],
    signed: false,
    axes: &[],
    wears: WHOLE,
    redundancy: Redundancy::DelayGrowth,
    interest: 0.001,
    rarity: 6.0,
    revealed_by: "quick turns at the beginning and at the end of a long drive",
    resembles: "clock_offset over a short drive: the commoner; gyro_scale, which a drift changes by its own size",
    source: "sensor model",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }
}
