//! Dragging brake on one side.

use crate::effect::export::{Section, Way};
use crate::effect::{
    Coefficients, Effect, EffectSpec, Export, OperatingPoint, Parameter, Scopes, SizedBy, Values,
};
use crate::scalar::Scalar;

/// T = Tb sign ω on one side
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "coulomb_side",
    name: "dragging brake on one side",
    law: "T = Tb sign ω on one side",
    seen: "Pulls to one side by the same amount at every speed; the sign follows the motion.",
    parameters: &[Parameter::strength("Tb", "N m", [0.0, 20.0], &[0.2])],
    scopes: Scopes::ONE_SIDE_OR_LATER,
    sized_by: SizedBy::Traction,
    interest: 0.12,
    revealed_by: "straight drives both ways at two speeds",
    resembles: "com_offset to the side; wheel_radius_mismatch at one speed",
    source: "Coulomb friction",
    export: Export {
        section: Section::Wheels,
        ..Export::BY_CONSTANTS.everywhere(Way::Held("dry friction of the wheel joints"))
    },
    ..EffectSpec::PHYSICS
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn apply(&self, v: &Values<T>, _at: &OperatingPoint<T>, c: &mut Coefficients<T>) {
        for t in &mut c.coulomb {
            *t += v[0];
        }
    }
}
