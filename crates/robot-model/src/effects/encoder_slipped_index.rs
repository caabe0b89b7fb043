//! Encoder of one side whose angle jumps.

use crate::effect::{Card, Effect, Kind, ONE_SIDE, Parameter, Redundancy, Role, Scale};
use crate::scalar::Scalar;

/// the wheel angle jumps within a row and stays there
pub struct Law;

const CARD: Card = Card {
    id: "encoder_slipped_index",
    name: "slipped encoder index on one side",
    kind: Kind::Sensor,
    law: "the wheel angle jumps within a row and stays there",
    seen: "The wheel seems to jump while the robot drives on steadily.",
    parameters: &[
        Parameter { name: "jump", unit: "rad", role: Role::Strength, bounds: [-10.0, 10.0], neutral: 0.0, probes: &[0.3], scale: Scale::Own },
    ],
    signed: true,
    axes: &[],
    wears: ONE_SIDE,
    redundancy: Redundancy::JumpingAngle,
    interest: 0.05,
    rarity: 3.0,
    revealed_by: "any drive",
    resembles: "encoder_dropout: but there the angle stands still before it jumps",
    source: "sensor model; disc slipped on its shaft, or counts lost at the index",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }
}
