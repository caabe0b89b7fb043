//! Slipping belt of one side.

use crate::effect::{Card, Effect, Kind, ONE_SIDE, Parameter, Redundancy, Role, Scale, Situation, Values, World};
use crate::scalar::Scalar;

/// torque to the front wheel of one side limited to ±T_b
pub struct Law;

const CARD: Card = Card {
    id: "belt_loss",
    name: "slipping belt of one side",
    kind: Kind::Physics,
    law: "torque to the front wheel of one side limited to ±T_b",
    seen: "The front wheel of that side lags; the side scrubs less and grips less.",
    parameters: &[
        Parameter { name: "T_b", unit: "N m", role: Role::Shaped, bounds: [0.0, 1e9], neutral: 1e9, probes: &[0.9, 0.5, 0.25], scale: Scale::Own },
    ],
    signed: false,
    axes: &[],
    wears: ONE_SIDE,
    redundancy: Redundancy::None,
    interest: 0.0,
    rarity: 0.0,
    revealed_by: "spins both ways and hard acceleration",
    resembles: "adhesion loss or turning_resistance on one side",
    source: "dry friction of a belt",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn act(&self, v: &Values<T>, _at: &Situation<T>, w: &mut World<T>) {
        for b in &mut w.belt_limit {
            *b = b.min(v[0]);
        }
    }
}
