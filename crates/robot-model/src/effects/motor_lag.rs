//! Motor lag.

use crate::effect::{Card, Effect, Kind, Parameter, Redundancy, Role, Scale, Values, WHOLE};
use crate::robot::Robot;
use crate::scalar::Scalar;

/// τ dT/dt = T_logged − T, in series with the current loop
pub struct Law;

const CARD: Card = Card {
    id: "motor_lag",
    name: "motor lag",
    kind: Kind::Command,
    law: "τ dT/dt = T_logged − T, in series with the current loop",
    seen: "Answers softly; overshoots in fast manoeuvres.",
    parameters: &[
        Parameter { name: "τ", unit: "s", role: Role::Shaped, bounds: [0.0, 1.0], neutral: 0.0, probes: &[0.05, 0.12], scale: Scale::Own },
    ],
    signed: false,
    axes: &[],
    wears: WHOLE,
    redundancy: Redundancy::None,
    interest: 0.04,
    rarity: 0.0,
    revealed_by: "steps of torque",
    resembles: "transport_delay in slow drives",
    source: "first-order lag",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn robot(&self, v: &Values<T>, r: &mut Robot<T>) {
        r.drive.extra_lag += v[0];
    }
}
