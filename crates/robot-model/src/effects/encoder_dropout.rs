//! Encoder dropout on one side.

use crate::effect::{Card, Effect, Kind, ONE_SIDE, Parameter, Redundancy, Role, Scale};
use crate::scalar::Scalar;

/// wheel angle frozen for short bursts, then right again
pub struct Law;

const CARD: Card = Card {
    id: "encoder_dropout",
    name: "encoder dropout on one side",
    kind: Kind::Sensor,
    law: "wheel angle frozen for short bursts, then right again",
    seen: "The wheel seems to stop and jump while the robot drives on.",
    parameters: &[
        Parameter { name: "share of rows", unit: "-", role: Role::Strength, bounds: [0.0, 1.0], neutral: 0.0, probes: &[0.05], scale: Scale::Own },
    ],
    signed: false,
    axes: &[],
    wears: ONE_SIDE,
    redundancy: Redundancy::FrozenAngle,
    interest: 0.008,
    rarity: 0.0,
    revealed_by: "any drive",
    resembles: "slipping wheel: but the angle jumps back",
    source: "sensor model",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }
}
