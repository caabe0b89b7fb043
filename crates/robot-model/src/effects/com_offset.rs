//! Centre of mass off the middle.

use crate::effect::export::Way;
use crate::effect::{Effect, EffectSpec, Export, Parameter, SizedBy, Values};
use crate::robot::Robot;
use crate::scalar::Scalar;

/// centre of mass at (Δx, Δy) from its nominal place
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "com_offset",
    name: "centre of mass off the middle",
    law: "centre of mass at (Δx, Δy) from its nominal place",
    seen: "Turns about another point; loads the wheels unequally.",
    parameters: &[
        Parameter::strength("Δx", "m", [-0.3, 0.3], &[0.015]),
        Parameter::strength("Δy", "m", [-0.3, 0.3], &[0.015]),
    ],
    signed: true,
    axes: &["x", "y"],
    sized_by: SizedBy::Wheelbase,
    interest: 0.015,
    revealed_by: "spins both ways, then straight acceleration",
    resembles: "coulomb_side and wheel_radius_mismatch in straight drives",
    source: "rigid body mechanics",
    export: Export::BY_CONSTANTS.everywhere(Way::Held("centre of mass of the chassis")),
    ..EffectSpec::PHYSICS
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn robot(&self, v: &Values<T>, r: &mut Robot<T>) {
        r.com[0] += v[0];
        r.com[1] += v[1];
    }
}
