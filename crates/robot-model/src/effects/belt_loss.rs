//! Slipping belt of one side.

use crate::chassis::Chassis;
use crate::effect::export::{Residual, Section, Way};
use crate::effect::{
    Coefficients, Effect, EffectSpec, Export, OperatingPoint, Parameter, Scopes, SizedBy, Values,
};
use crate::scalar::Scalar;

/// torque to the front wheel of one side limited to ±T_b
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "belt_loss",
    name: "slipping belt of one side",
    law: "torque to the front wheel of one side limited to ±T_b",
    seen: "The front wheel of that side lags; the side scrubs less and grips less.",
    parameters: &[Parameter::shaped("T_b", "N m", [0.0, 1e9], 1e9, &[0.9, 0.5, 0.25])],
    scopes: Scopes::ONE_SIDE,
    chassis: &[Chassis::SkidSteer],
    sized_by: SizedBy::Traction,
    revealed_by: "spins both ways and hard acceleration",
    resembles: "adhesion loss or turning_resistance on one side",
    source: "dry friction of a belt",
    export: Export {
        section: Section::Wheels,
        mjcf: Way::Held(
            "dry friction of a tendon over both wheels of that side, in place of their \
            equality",
        ),
        urdf: Way::Added("wheels that mimic each other do so at any torque"),
        sdf: Way::Added("wheels that mimic each other do so at any torque"),
        residual: Residual::Words(
            "Take <mimic> out of the front wheel joint ({side}) and couple it to the \
            rear one by a torque that never exceeds {0} N m: torque = clip(gain * (rear \
            speed - front speed), -{0}, {0}) on the front joint and its opposite on the rear \
            one, the gain as large as the step allows.",
        ),
        ..Export::ADDED_BY_HAND
    },
    ..EffectSpec::PHYSICS
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn apply(&self, v: &Values<T>, _at: &OperatingPoint<T>, c: &mut Coefficients<T>) {
        for b in &mut c.belt_limit {
            *b = b.min(v[0]);
        }
    }
}
