//! Dragging brake on one side.

use crate::effect::{Card, Effect, Kind, ONE_SIDE, Parameter, Redundancy, Role, Scale, Situation, Values, World};
use crate::scalar::Scalar;

/// T = Tb sign ω on one side
pub struct Law;

const CARD: Card = Card {
    id: "coulomb_side",
    name: "dragging brake on one side",
    kind: Kind::Physics,
    law: "T = Tb sign ω on one side",
    seen: "Pulls to one side by the same amount at every speed; the sign follows the motion.",
    parameters: &[
        Parameter { name: "Tb", unit: "N m", role: Role::Strength, bounds: [0.0, 20.0], neutral: 0.0, probes: &[0.2], scale: Scale::Own },
    ],
    signed: false,
    axes: &[],
    wears: ONE_SIDE,
    redundancy: Redundancy::None,
    interest: 0.12,
    rarity: 0.0,
    revealed_by: "straight drives both ways at two speeds",
    resembles: "com_offset to the side; wheel_radius_mismatch at one speed",
    source: "Coulomb friction",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn act(&self, v: &Values<T>, _at: &Situation<T>, w: &mut World<T>) {
        for t in &mut w.coulomb {
            *t += v[0];
        }
    }
}
