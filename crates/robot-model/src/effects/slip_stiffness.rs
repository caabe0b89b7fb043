//! Slip stiffness of the ground contact.

use crate::effect::{Card, Effect, Kind, Parameter, Redundancy, Role, Scale, Situation, Values, WHOLE, World};
use crate::scalar::Scalar;

/// λp (1 + q)
pub struct Law;

const CARD: Card = Card {
    id: "slip_stiffness",
    name: "slip stiffness of the tyres",
    kind: Kind::Physics,
    law: "λp (1 + q)",
    seen: "Slips more (less) for the same force: the effective track grows, odometry runs ahead.",
    parameters: &[Parameter {
        name: "q",
        unit: "-",
        role: Role::Strength,
        bounds: [-0.9, 20.0],
        neutral: 0.0,
        probes: &[1.0],
        scale: Scale::Own,
    }],
    signed: true,
    axes: &[],
    wears: WHOLE,
    redundancy: Redundancy::None,
    interest: 1.0,
    rarity: 0.0,
    revealed_by: "arcs and spins with a gyro or a pose",
    resembles: "adhesion and turning_resistance in turns; wheel radius in straight drives",
    source: "Hendzel & Trojnacki 2014, λp of Eq. 8",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn act(&self, v: &Values<T>, _at: &Situation<T>, w: &mut World<T>) {
        for s in &mut w.slip_at_peak {
            *s *= T::one() + v[0];
        }
    }
}
