//! Wheels of one side of another radius.

use crate::effect::export::{Section, Way};
use crate::effect::{
    Coefficients, Effect, EffectSpec, Export, OperatingPoint, Parameter, Scopes, Values,
};
use crate::scalar::Scalar;

/// r (1 + ρ) on one side
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "wheel_radius_mismatch",
    name: "wheels of one side of another radius",
    law: "r (1 + ρ) on one side",
    seen: "Drifts to one side in proportion to the distance.",
    parameters: &[Parameter::strength("ρ", "-", [-0.3, 0.3], &[0.015])],
    signed: true,
    scopes: Scopes::ONE_SIDE,
    interest: 0.012,
    revealed_by: "a long straight drive both ways",
    resembles: "com_offset to the side; encoder scale",
    source: "Borenstein & Feng 1996, IEEE Trans. Robot. Autom. 12(6)",
    export: Export {
        section: Section::Wheels,
        ..Export::BY_CONSTANTS.everywhere(Way::Held("radius of the wheels of that side"))
    },
    ..EffectSpec::PHYSICS
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn apply(&self, v: &Values<T>, _at: &OperatingPoint<T>, c: &mut Coefficients<T>) {
        for r in &mut c.radius {
            *r *= T::one() + v[0];
        }
    }
}
