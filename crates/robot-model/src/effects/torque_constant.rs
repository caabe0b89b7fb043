//! Torque constant.

use crate::effect::{Card, Effect, Kind, Parameter, Redundancy, Role, Scale, Values, WHOLE};
use crate::robot::Robot;
use crate::scalar::Scalar;

/// T = (1 + κ) T_logged on both sides
pub struct Law;

const CARD: Card = Card {
    id: "torque_constant",
    name: "torque constant",
    kind: Kind::Command,
    law: "T = (1 + κ) T_logged on both sides",
    seen: "Everything takes less (more) current than it should, in the same proportion.",
    parameters: &[
        Parameter { name: "κ", unit: "-", role: Role::Strength, bounds: [-0.8, 2.0], neutral: 0.0, probes: &[-0.08], scale: Scale::Own },
    ],
    signed: true,
    axes: &[],
    wears: WHOLE,
    redundancy: Redundancy::None,
    interest: 0.045,
    rarity: 0.0,
    revealed_by: "hard acceleration of the unloaded robot",
    resembles: "payload together with friction: exact if all are unknown",
    source: "motor equation",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn robot(&self, v: &Values<T>, r: &mut Robot<T>) {
        r.drive.gain *= T::one() + v[0];
    }
}
