//! Slippery or grippy ground: the level everywhere, or a patch.
//!
//! One effect for both: the law is the same, and a second one that differed by its place only would be a look-alike.

use crate::effect::{Card, Effect, Kind, Parameter, Redundancy, Role, Scale, Situation, Values, Wears, World};
use crate::scalar::Scalar;

/// μ (1 − q)
pub struct Law;

const CARD: Card = Card {
    id: "adhesion_patch",
    name: "grip of the ground",
    kind: Kind::Physics,
    law: "μ (1 − q), everywhere or at one place",
    seen: "Wheels spin or slide earlier; turns come out wider or tighter; at one place or, as the level of grip, everywhere.",
    parameters: &[
        Parameter { name: "lost share", unit: "-", role: Role::Strength, bounds: [-2.0, 0.95], neutral: 0.0, probes: &[0.3], scale: Scale::Own },
    ],
    signed: false,
    axes: &[],
    wears: Wears { everywhere: true, onset: true, disc: true, side: false },
    redundancy: Redundancy::None,
    interest: 0.2,
    rarity: 0.0,
    revealed_by: "hard acceleration and tight turns on and off the place",
    resembles: "turning_resistance in turns; payload in spins",
    source: "Coulomb adhesion",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn act(&self, v: &Values<T>, _at: &Situation<T>, w: &mut World<T>) {
        for mu in &mut w.adhesion {
            *mu *= T::one() - v[0];
        }
    }
}
