//! Stiction (Stribeck friction).

use crate::effect::{Card, Effect, Kind, Parameter, Redundancy, Role, Scale, Situation, Values, WHOLE, World};
use crate::scalar::Scalar;

/// T = Ts exp(−(ω/ωs)²) sign ω on each side
pub struct Law;

const CARD: Card = Card {
    id: "stiction",
    name: "stiction (Stribeck friction)",
    kind: Kind::Physics,
    law: "T = Ts exp(−(ω/ωs)²) sign ω on each side",
    seen: "Sticks at rest and jumps when it breaks loose; nothing at speed.",
    parameters: &[
        Parameter { name: "Ts", unit: "N m", role: Role::Strength, bounds: [0.0, 20.0], neutral: 0.0, probes: &[0.4], scale: Scale::Own },
    ],
    signed: false,
    axes: &[],
    wears: WHOLE,
    redundancy: Redundancy::None,
    interest: 0.4,
    rarity: 0.0,
    revealed_by: "slow starts, stops and reversals",
    resembles: "backlash_dead_zone near rest",
    source: "Armstrong-Hélouvry et al. 1994, Automatica 30(7)",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn act(&self, v: &Values<T>, _at: &Situation<T>, w: &mut World<T>) {
        for t in &mut w.stribeck {
            *t += v[0];
        }
    }
}
