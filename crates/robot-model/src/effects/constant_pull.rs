//! Constant pull at the hitch.

use crate::effect::{Card, Effect, Kind, Parameter, Redundancy, Role, Scale, Situation, Values, WHOLE, World};
use crate::scalar::Scalar;

/// F = −P along the body's x at the rear hitch
pub struct Law;

const CARD: Card = Card {
    id: "constant_pull",
    name: "constant pull at the hitch",
    kind: Kind::Physics,
    law: "F = −P along the body's x at the rear hitch",
    seen: "Costs torque forward and saves it backward, whatever the heading.",
    parameters: &[
        Parameter { name: "P", unit: "N", role: Role::Strength, bounds: [0.0, 500.0], neutral: 0.0, probes: &[4.0], scale: Scale::Own },
    ],
    signed: false,
    axes: &[],
    wears: WHOLE,
    redundancy: Redundancy::None,
    interest: 2.0,
    rarity: 0.0,
    revealed_by: "straight drives forward and backward",
    resembles: "grade while the heading does not change; rolling_resistance in forward drives",
    source: "statics",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn act(&self, v: &Values<T>, at: &Situation<T>, w: &mut World<T>) {
        w.force[0] -= v[0];
        w.moment += v[0] * at.hitch[1];
    }
}
