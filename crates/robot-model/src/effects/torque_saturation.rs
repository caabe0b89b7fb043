//! Torque limit.

use crate::effect::{Card, Effect, Kind, Parameter, Redundancy, Role, Scale, Values, WHOLE};
use crate::robot::Robot;
use crate::scalar::Scalar;

/// |T| ≤ T_max below the data sheet's
pub struct Law;

const CARD: Card = Card {
    id: "torque_saturation",
    name: "torque limit",
    kind: Kind::Command,
    law: "|T| ≤ T_max below the data sheet's",
    seen: "Lacks torque only when much is asked for.",
    parameters: &[
        Parameter { name: "T_max", unit: "N m", role: Role::Shaped, bounds: [0.05, 1e9], neutral: 1e9, probes: &[0.9, 0.7, 0.5], scale: Scale::LargestTorque },
    ],
    signed: false,
    axes: &[],
    wears: WHOLE,
    redundancy: Redundancy::None,
    interest: 0.0,
    rarity: 0.0,
    revealed_by: "hard acceleration and spins",
    resembles: "adhesion_patch when wheels would slip at that torque",
    source: "current limiting",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn robot(&self, v: &Values<T>, r: &mut Robot<T>) {
        r.drive.limit = r.drive.limit.min(v[0]);
    }
}
