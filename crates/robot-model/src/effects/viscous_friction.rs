//! Viscous drivetrain friction.

use crate::effect::{Card, Effect, Kind, Parameter, Redundancy, Role, Scale, Situation, Values, WHOLE, World};
use crate::scalar::Scalar;

/// T = c ω on each side
pub struct Law;

const CARD: Card = Card {
    id: "viscous_friction",
    name: "viscous drivetrain friction",
    kind: Kind::Physics,
    law: "T = c ω on each side",
    seen: "Costs more torque the faster the wheels turn, straight and in turns alike.",
    parameters: &[
        Parameter { name: "c", unit: "N m s/rad", role: Role::Strength, bounds: [0.0, 2.0], neutral: 0.0, probes: &[0.04], scale: Scale::Own },
    ],
    signed: false,
    axes: &[],
    wears: WHOLE,
    redundancy: Redundancy::None,
    interest: 0.02,
    rarity: 0.0,
    revealed_by: "constant speeds of different size, then coasting down",
    resembles: "quadratic_drag over a narrow range of speed; torque_constant when friction dominates",
    source: "Armstrong-Hélouvry et al. 1994, Automatica 30(7)",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn act(&self, v: &Values<T>, _at: &Situation<T>, w: &mut World<T>) {
        for c in &mut w.viscous {
            *c += v[0];
        }
    }
}
