//! Dry friction of both drivetrains.

use crate::effect::{Card, Effect, Kind, Parameter, Redundancy, Role, Scale, Situation, Values, WHOLE, World};
use crate::scalar::Scalar;

/// T = Tc sign ω on each side
pub struct Law;

const CARD: Card = Card {
    id: "coulomb_friction",
    name: "dry friction of the drivetrain",
    kind: Kind::Physics,
    law: "T = Tc sign ω on each side",
    seen: "Takes the same extra torque on both sides at every speed and every load; the sign follows the motion.",
    parameters: &[
        Parameter { name: "Tc", unit: "N m", role: Role::Strength, bounds: [0.0, 20.0], neutral: 0.0, probes: &[0.2], scale: Scale::Own },
    ],
    signed: false,
    axes: &[],
    wears: WHOLE,
    redundancy: Redundancy::None,
    interest: 0.12,
    rarity: 3.0,
    revealed_by: "straight drives at several steady speeds, light and loaded",
    resembles: "rolling_resistance at constant load; thermal_drift over one drive; viscous_friction over a narrow range of speeds",
    source: "Coulomb friction",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn act(&self, v: &Values<T>, _at: &Situation<T>, w: &mut World<T>) {
        for t in &mut w.coulomb {
            *t += v[0];
        }
    }
}
