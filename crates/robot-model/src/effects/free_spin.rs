//! Wheels of one side that spin in the ground without driving.

use crate::effect::export::{Section, Way};
use crate::effect::LOST_SHARE;
use crate::effect::{
    Coefficients, Effect, EffectSpec, Export, OperatingPoint, Parameter, Scopes, Values,
};
use crate::scalar::Scalar;

/// F_x (1 − q) on one side; F_y as before
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "free_spin",
    name: "wheels of one side spin free",
    law: "F_x (1 − q) on one side; F_y as before",
    seen: "One side races or digs itself in and drives (brakes) little, but does not slide \
        sideways more easily.",
    parameters: &[Parameter::strength(LOST_SHARE, "-", [0.0, 1.0], &[0.3])],
    scopes: Scopes::ONE_SIDE,
    // Raised from 0.2 with a label in view: a fault-free development drive fits 0.06.
    interest: 0.4,
    rarity: 6.0,
    revealed_by: "hard straight acceleration and braking, then spins both ways",
    resembles: "adhesion_patch, which lets go sideways too: the commoner of the two; belt_loss \
        on that side",
    source: "longitudinal share of the contact force; dug-in wheels: Wong 2008, Theory of Ground \
        Vehicles",
    export: Export {
        section: Section::Ground,
        mjcf: Way::Held("friction of the contacts across the axles of that side"),
        urdf: Way::Held("mu2 of the wheels of that side, in gazebo tags"),
        sdf: Way::Held("mu2 of the surfaces of that side's wheels"),
        ..Export::BY_CONSTANTS
    },
    ..EffectSpec::PHYSICS
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn apply(&self, v: &Values<T>, _at: &OperatingPoint<T>, c: &mut Coefficients<T>) {
        for t in &mut c.traction {
            *t *= T::one() - v[0];
        }
    }
}
