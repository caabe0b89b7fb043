//! Loss of the gears in proportion to the torque they transmit.

use crate::effect::{Card, Effect, Kind, Parameter, Redundancy, Role, Scale, Situation, Values, WHOLE, World};
use crate::scalar::Scalar;

/// T = β |T_drive| sign ω on each side
pub struct Law;

const CARD: Card = Card {
    id: "load_dependent_friction",
    name: "load-dependent friction of the gears",
    kind: Kind::Physics,
    law: "T = β |T_drive| sign ω on each side: the gears pass η = 1 − β of the torque when driving, and hold back β of it when driven",
    seen: "The harder it pulls or brakes the more torque is lost; nothing when coasting.",
    parameters: &[
        Parameter { name: "β", unit: "-", role: Role::Strength, bounds: [0.0, 0.9], neutral: 0.0, probes: &[0.05], scale: Scale::Own },
    ],
    signed: false,
    axes: &[],
    wears: WHOLE,
    redundancy: Redundancy::None,
    interest: 0.04,
    rarity: 3.0,
    revealed_by: "hard acceleration and hard braking at the same speed, and coasting",
    resembles: "torque_constant as long as it never brakes; coulomb_friction at constant load",
    source: "Hamon, Gautier & Garrec 2010, IROS: dry friction that depends on load and velocity; gear efficiency η = 1 − β",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn act(&self, v: &Values<T>, at: &Situation<T>, w: &mut World<T>) {
        for j in 0..2 {
            w.coulomb[j] += v[0] * at.torque[j].abs();
        }
    }
}
