//! Transport delay.

use crate::effect::{Card, Effect, Kind, Parameter, Redundancy, Role, Scale, Values, WHOLE};
use crate::robot::Robot;
use crate::scalar::Scalar;

/// T(t) = T_logged(t − d)
pub struct Law;

const CARD: Card = Card {
    id: "transport_delay",
    name: "transport delay",
    kind: Kind::Command,
    law: "T(t) = T_logged(t − d)",
    seen: "Does everything right, but later.",
    parameters: &[
        Parameter { name: "d", unit: "s", role: Role::Shaped, bounds: [0.0, 0.5], neutral: 0.0, probes: &[0.04, 0.09], scale: Scale::Own },
    ],
    signed: false,
    axes: &[],
    wears: WHOLE,
    redundancy: Redundancy::None,
    interest: 0.03,
    rarity: 0.0,
    revealed_by: "steps of torque",
    resembles: "motor_lag in slow drives; clock offset of the recording",
    source: "pure delay",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn robot(&self, v: &Values<T>, r: &mut Robot<T>) {
        r.drive.delay += v[0];
    }
}
