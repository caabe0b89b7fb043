//! Wheels of one side of another radius.

use crate::effect::{Card, Effect, Kind, ONE_SIDE, Parameter, Redundancy, Role, Scale, Situation, Values, World};
use crate::scalar::Scalar;

/// r (1 + ρ) on one side
pub struct Law;

const CARD: Card = Card {
    id: "wheel_radius_mismatch",
    name: "wheels of one side of another radius",
    kind: Kind::Physics,
    law: "r (1 + ρ) on one side",
    seen: "Drifts to one side in proportion to the distance.",
    parameters: &[
        Parameter { name: "ρ", unit: "-", role: Role::Strength, bounds: [-0.3, 0.3], neutral: 0.0, probes: &[0.015], scale: Scale::Own },
    ],
    signed: true,
    axes: &[],
    wears: ONE_SIDE,
    redundancy: Redundancy::None,
    interest: 0.012,
    rarity: 0.0,
    revealed_by: "a long straight drive both ways",
    resembles: "com_offset to the side; encoder scale",
    source: "Borenstein & Feng 1996, IEEE Trans. Robot. Autom. 12(6)",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn act(&self, v: &Values<T>, _at: &Situation<T>, w: &mut World<T>) {
        for r in &mut w.radius {
            *r *= T::one() + v[0];
        }
    }
}
