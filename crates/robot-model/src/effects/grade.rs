//! Sloping ground.

use crate::effect::{Card, Effect, Kind, Parameter, Redundancy, Role, Scale, Situation, WHOLE, World};
use crate::scalar::Scalar;

/// F = m g sin α along the downhill direction, fixed in the world
pub struct Law;

const CARD: Card = Card {
    id: "grade",
    name: "sloping ground",
    kind: Kind::Physics,
    law: "F = m g sin α along the downhill direction, fixed in the world",
    seen: "Costs torque uphill and saves it downhill; changes with the heading.",
    parameters: &[
        Parameter { name: "downhill x", unit: "rad", role: Role::Strength, bounds: [-0.6, 0.6], neutral: 0.0, probes: &[0.02], scale: Scale::Own },
        Parameter { name: "downhill y", unit: "rad", role: Role::Strength, bounds: [-0.6, 0.6], neutral: 0.0, probes: &[0.02], scale: Scale::Own },
    ],
    signed: false,
    axes: &[],
    wears: WHOLE,
    redundancy: Redundancy::None,
    interest: 0.01,
    revealed_by: "the same path in the opposite direction",
    resembles: "rolling_resistance or constant_pull as long as all drives go one way",
    source: "statics",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn act(&self, v: &[T], at: &Situation<T>, w: &mut World<T>) {
        let [c, s] = at.heading;
        w.tilt[0] += at.gravity * (v[0] * c + v[1] * s);
        w.tilt[1] += at.gravity * (v[1] * c - v[0] * s);
    }
}
