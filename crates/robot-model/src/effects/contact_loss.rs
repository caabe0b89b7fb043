//! A wheel that hangs in the air.

use crate::chassis::Chassis;
use crate::effect::export::{Section, Way};
use crate::effect::{Coefficients, Effect, EffectSpec, Export, OperatingPoint, Parameter, Values};
use crate::scalar::{Scalar, real};

/// N ∓ q m g/4 on the diagonals: positive q lifts front left and rear right, negative q the other
/// two; |q| = 1 lifts a wheel off
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "contact_loss",
    name: "a wheel that loses contact",
    law: "N ∓ q m g/4 on the diagonals: positive q lifts front left and rear right, negative q \
        the other two; |q| = 1 lifts a wheel off",
    seen: "Two wheels on a diagonal carry the robot: it rocks, and turns differently both ways.",
    parameters: &[Parameter::strength("q", "-", [-1.0, 1.0], &[0.5])],
    signed: true,
    chassis: Chassis::ON_FOUR_WHEELS,
    interest: 0.4,
    rarity: 6.0,
    revealed_by: "spins and tight arcs both ways",
    resembles: "com_offset and turning_resistance in turns; weak in straight drives",
    source: "statics of four wheels on twisted ground: one load is free",
    export: Export {
        section: Section::Ground,
        mjcf: Way::Held("friction of each wheel's contact in proportion to the load that it has"),
        urdf: Way::Held("mu1 and mu2 of each wheel in proportion to the load that it has"),
        sdf: Way::Held("mu and mu2 of each wheel in proportion to the load that it has"),
        ..Export::BY_CONSTANTS
    },
    ..EffectSpec::PHYSICS
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn apply(&self, v: &Values<T>, at: &OperatingPoint<T>, c: &mut Coefficients<T>) {
        c.twist += v[0] * at.mass * at.gravity * real(0.25);
    }
}
