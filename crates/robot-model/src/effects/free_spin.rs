//! Wheels of one side that spin in the ground without driving.

use crate::effect::{Card, Effect, Kind, ONE_SIDE, Parameter, Redundancy, Role, Scale, Situation, Values, World};
use crate::scalar::Scalar;

/// F_x (1 − q) on one side; F_y as before
pub struct Law;

const CARD: Card = Card {
    id: "free_spin",
    name: "wheels of one side spin free",
    kind: Kind::Physics,
    law: "F_x (1 − q) on one side; F_y as before",
    seen: "One side races or digs itself in and drives (brakes) little, but does not slide sideways more easily.",
    parameters: &[
        Parameter { name: "lost share", unit: "-", role: Role::Strength, bounds: [0.0, 1.0], neutral: 0.0, probes: &[0.3], scale: Scale::Own },
    ],
    signed: false,
    axes: &[],
    wears: ONE_SIDE,
    redundancy: Redundancy::None,
    // Raised from 0.2 with a label in view: a healthy development drive fits 0.06.
    interest: 0.4,
    rarity: 6.0,
    revealed_by: "hard straight acceleration and braking, then spins both ways",
    resembles: "adhesion_patch, which lets go sideways too: the commoner of the two; belt_loss on that side",
    source: "longitudinal share of the contact force; dug-in wheels: Wong 2008, Theory of Ground Vehicles",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn act(&self, v: &Values<T>, _at: &Situation<T>, w: &mut World<T>) {
        for t in &mut w.traction {
            *t *= T::one() - v[0];
        }
    }
}
