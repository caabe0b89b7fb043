//! Turning (lateral scrub) resistance.

use crate::effect::{Card, Effect, Kind, Parameter, Redundancy, Role, Scale, Situation, Values, WHOLE, World};
use crate::scalar::Scalar;

/// lateral adhesion times (1 + σ)
pub struct Law;

const CARD: Card = Card {
    id: "turning_resistance",
    name: "turning (lateral scrub) resistance",
    kind: Kind::Physics,
    law: "lateral adhesion times (1 + σ)",
    seen: "Turning costs more (less), straight driving the same.",
    parameters: &[
        Parameter { name: "σ", unit: "-", role: Role::Strength, bounds: [-0.9, 3.0], neutral: 0.0, probes: &[-0.1], scale: Scale::Own },
    ],
    signed: true,
    axes: &[],
    wears: WHOLE,
    redundancy: Redundancy::None,
    interest: 0.08,
    rarity: 0.0,
    revealed_by: "spins both ways at two speeds",
    resembles: "adhesion_patch in turns; yaw inertia in fast turns",
    source: "Kozłowski & Pazderski 2004, Int. J. Appl. Math. Comput. Sci. 14(4)",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn act(&self, v: &Values<T>, _at: &Situation<T>, w: &mut World<T>) {
        for k in &mut w.lateral {
            *k *= T::one() + v[0];
        }
    }
}
