//! Centre of mass off the middle.

use crate::effect::{Card, Effect, Kind, Parameter, Redundancy, Role, Scale, Values, WHOLE};
use crate::robot::Robot;
use crate::scalar::Scalar;

/// centre of mass at (Δx, Δy) from its nominal place
pub struct Law;

const CARD: Card = Card {
    id: "com_offset",
    name: "centre of mass off the middle",
    kind: Kind::Physics,
    law: "centre of mass at (Δx, Δy) from its nominal place",
    seen: "Turns about another point; loads the wheels unequally.",
    parameters: &[
        Parameter { name: "Δx", unit: "m", role: Role::Strength, bounds: [-0.3, 0.3], neutral: 0.0, probes: &[0.015], scale: Scale::Own },
        Parameter { name: "Δy", unit: "m", role: Role::Strength, bounds: [-0.3, 0.3], neutral: 0.0, probes: &[0.015], scale: Scale::Own },
    ],
    signed: true,
    axes: &["x", "y"],
    wears: WHOLE,
    redundancy: Redundancy::None,
    interest: 0.015,
    rarity: 0.0,
    revealed_by: "spins both ways, then straight acceleration",
    resembles: "coulomb_side and wheel_radius_mismatch in straight drives",
    source: "rigid body mechanics",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn robot(&self, v: &Values<T>, r: &mut Robot<T>) {
        r.com[0] += v[0];
        r.com[1] += v[1];
    }
}
