//! Extra mass.

use crate::effect::{Card, Effect, Kind, Parameter, Redundancy, Role, Scale, Values, WHOLE};
use crate::robot::Robot;
use crate::scalar::{Scalar, real};

/// m + Δm, I_z + 0.03 m² Δm, carried 80 mm above the centre of mass
pub struct Law;

const CARD: Card = Card {
    id: "payload",
    name: "extra mass",
    kind: Kind::Physics,
    law: "m + Δm, I_z + 0.03 m² Δm, carried 80 mm above the centre of mass",
    seen: "Accelerates more slowly, rolls and scrubs harder; coasts further.",
    parameters: &[
        Parameter { name: "mass", unit: "kg", role: Role::Strength, bounds: [0.0, 200.0], neutral: 0.0, probes: &[2.0], scale: Scale::Own },
    ],
    signed: false,
    axes: &[],
    wears: WHOLE,
    redundancy: Redundancy::None,
    interest: 1.0,
    rarity: 0.0,
    revealed_by: "hard acceleration and braking, then spins both ways",
    resembles: "torque_constant on level ground; motor inertia in straight drives",
    source: "rigid body mechanics",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn robot(&self, v: &Values<T>, r: &mut Robot<T>) {
        let grown = r.mass + v[0];
        // The load sits 80 mm above the centre of mass it joins, spread over a square of 0.6 m.
        r.com[2] += real::<T>(0.08) * v[0] / grown;
        r.yaw_inertia += real::<T>(0.03) * v[0];
        r.mass = grown;
    }
}
