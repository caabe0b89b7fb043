//! Sloping ground: grade and side slope are one effect, for a heading turns one into the other.

use crate::effect::{Card, Effect, Kind, Parameter, Redundancy, Role, Scale, Situation, Values, WHOLE, World};
use crate::scalar::{Scalar, real};

/// F = m g sin α along the downhill direction, fixed in the world
pub struct Law;

const CARD: Card = Card {
    id: "grade",
    name: "sloping ground",
    kind: Kind::Physics,
    law: "F = m g sin α along the downhill direction, any, fixed in the world: grade and side slope alike",
    seen: "Costs torque uphill, saves it downhill and pulls sideways across the slope; changes with the heading.",
    parameters: &[
        Parameter { name: "downhill x", unit: "rad", role: Role::Strength, bounds: [-0.6, 0.6], neutral: 0.0, probes: &[0.02], scale: Scale::Own },
        Parameter { name: "downhill y", unit: "rad", role: Role::Strength, bounds: [-0.6, 0.6], neutral: 0.0, probes: &[0.02], scale: Scale::Own },
    ],
    signed: false,
    axes: &[],
    wears: WHOLE,
    redundancy: Redundancy::None,
    interest: 0.01,
    rarity: 0.0,
    revealed_by: "the same path in the opposite direction",
    resembles: "rolling_resistance or constant_pull as long as all drives go one way",
    source: "statics",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn act(&self, v: &Values<T>, at: &Situation<T>, w: &mut World<T>) {
        let [c, s] = at.heading;
        // sin α along the slope's direction, to third order: 0.02 % at 0.6 rad.
        let a2 = v[0] * v[0] + v[1] * v[1];
        let g = at.gravity * (T::one() - a2 / real(6.0) + a2 * a2 / real(120.0));
        w.tilt[0] += g * (v[0] * c + v[1] * s);
        w.tilt[1] += g * (v[1] * c - v[0] * s);
    }
}
