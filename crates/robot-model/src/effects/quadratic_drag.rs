//! Quadratic drag.

use crate::effect::{Card, Effect, Kind, Parameter, Redundancy, Role, Scale, Situation, Values, WHOLE, World};
use crate::scalar::{Scalar, real};

/// F = −c v |v|
pub struct Law;

const CARD: Card = Card {
    id: "quadratic_drag",
    name: "quadratic drag",
    kind: Kind::Physics,
    law: "F = −c v |v|",
    seen: "Costs more the faster it drives, hardly anything in spins.",
    parameters: &[
        Parameter { name: "c", unit: "N s²/m²", role: Role::Strength, bounds: [0.0, 200.0], neutral: 0.0, probes: &[4.0], scale: Scale::Own },
    ],
    signed: false,
    axes: &[],
    wears: WHOLE,
    redundancy: Redundancy::None,
    interest: 1.6,
    rarity: 0.0,
    revealed_by: "straight drives at three speeds",
    resembles: "viscous_friction over a narrow range of speed",
    source: "fluid drag",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn act(&self, v: &Values<T>, at: &Situation<T>, w: &mut World<T>) {
        let [x, y] = at.velocity;
        // At rest the square root has no derivative, the drag has.
        let speed = (x * x + y * y).max(real(1e-20)).sqrt();
        w.force[0] -= v[0] * speed * x;
        w.force[1] -= v[0] * speed * y;
    }
}
