//! A wheel that hangs in the air.

use crate::effect::{Card, Effect, Kind, Parameter, Redundancy, Role, Scale, Situation, Values, WHOLE, World};
use crate::scalar::{Scalar, real};

/// N ∓ q m g/4 on the diagonals: positive q lifts front left and rear right, negative q the other two; |q| = 1 lifts a wheel off
pub struct Law;

const CARD: Card = Card {
    id: "contact_loss",
    name: "a wheel that loses contact",
    kind: Kind::Physics,
    law: "N ∓ q m g/4 on the diagonals: positive q lifts front left and rear right, negative q the other two; |q| = 1 lifts a wheel off",
    seen: "Two wheels on a diagonal carry the robot: it rocks, and turns differently both ways.",
    parameters: &[
        Parameter { name: "q", unit: "-", role: Role::Strength, bounds: [-1.0, 1.0], neutral: 0.0, probes: &[0.5], scale: Scale::Own },
    ],
    signed: true,
    axes: &[],
    wears: WHOLE,
    redundancy: Redundancy::None,
    interest: 0.4,
    rarity: 6.0,
    revealed_by: "spins and tight arcs both ways",
    resembles: "com_offset and turning_resistance in turns; weak in straight drives",
    source: "statics of four wheels on twisted ground: one load is free",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn act(&self, v: &Values<T>, at: &Situation<T>, w: &mut World<T>) {
        w.twist += v[0] * at.mass * at.gravity * real(0.25);
    }
}
