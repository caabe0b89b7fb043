//! Casters that roll hard.

use crate::chassis::Chassis;
use crate::effect::export::{Section, Way};
use crate::effect::{Coefficients, Effect, EffectSpec, Export, OperatingPoint, Parameter, Values};
use crate::scalar::Scalar;

/// F = −Δf_c N along each caster's direction of rolling
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "caster_drag",
    name: "casters that roll hard",
    law: "F = −Δf_c N along each caster's direction of rolling, at its pivot",
    seen: "Driving and turning cost more torque, turning on the spot most of all, where the casters go the longest way.",
    parameters: &[Parameter::added("Δf_c", |robot| robot.caster_rolling, [-0.5, 3.0], &[0.08])],
    chassis: &[Chassis::Differential],
    interest: 0.05,
    revealed_by: "straight drives both ways, then spins both ways",
    resembles: "rolling_resistance and coulomb_friction in straight drives",
    source: "rolling resistance of a small wheel, hair and dirt in its bearing (guess of sizes)",
    export: Export {
        section: Section::Wheels,
        ..Export::ADDED_BY_HAND
            .everywhere(Way::Held("friction of the casters' spheres, which slide as hard as casters roll"))
    },
    ..EffectSpec::PHYSICS
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn apply(&self, v: &Values<T>, at: &OperatingPoint<T>, c: &mut Coefficients<T>) {
        if at.chassis == Chassis::Differential {
            c.rolling[0] += v[0];
            c.rolling[1] += v[0];
        }
    }
}
