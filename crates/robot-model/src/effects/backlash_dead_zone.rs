//! Dead band of the transmission.

use crate::effect::{Card, Effect, Kind, Parameter, Redundancy, Role, Scale, Values, WHOLE};
use crate::robot::Robot;
use crate::scalar::Scalar;

/// no torque within ±d, beyond it T − d sign T
pub struct Law;

const CARD: Card = Card {
    id: "backlash_dead_zone",
    name: "dead band of the transmission",
    kind: Kind::Command,
    law: "no torque within ±d, beyond it T − d sign T",
    seen: "Ignores small torques.",
    parameters: &[
        Parameter { name: "d", unit: "N m", role: Role::Shaped, bounds: [0.0, 20.0], neutral: 0.0, probes: &[0.15, 0.4], scale: Scale::Own },
    ],
    signed: false,
    axes: &[],
    wears: WHOLE,
    redundancy: Redundancy::None,
    interest: 0.08,
    rarity: 0.0,
    revealed_by: "slow drives with small torques of both signs",
    resembles: "Coulomb friction as long as torque and motion have the same sign",
    source: "dead zone",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn robot(&self, v: &Values<T>, r: &mut Robot<T>) {
        r.drive.dead_band += v[0];
    }
}
