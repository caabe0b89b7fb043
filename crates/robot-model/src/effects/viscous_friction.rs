//! Viscous drivetrain friction.

use crate::effect::export::{Section, Way};
use crate::effect::{
    Coefficients, Effect, EffectSpec, Export, LoadTerm, OperatingPoint, Parameter, SizedBy, Values,
};
use crate::scalar::Scalar;

/// T = c ω on each side
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "viscous_friction",
    name: "viscous drivetrain friction",
    law: "T = c ω on each side",
    seen: "Costs more torque the faster the wheels turn, straight and in turns alike.",
    parameters: &[Parameter::strength("c", "N m s/rad", [0.0, 2.0], &[0.04])],
    load_term: Some(LoadTerm::Speed),
    sized_by: SizedBy::TractionPerSpeed,
    interest: 0.02,
    revealed_by: "constant speeds of different size, then coasting down",
    resembles: "quadratic_drag over a narrow range of speed; torque_constant when friction \
        dominates",
    source: "Armstrong-Hélouvry et al. 1994, Automatica 30(7)",
    export: Export {
        section: Section::Wheels,
        ..Export::BY_CONSTANTS.everywhere(Way::Held("damping of the wheel joints"))
    },
    ..EffectSpec::PHYSICS
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn apply(&self, v: &Values<T>, _at: &OperatingPoint<T>, c: &mut Coefficients<T>) {
        for b in &mut c.viscous {
            *b += v[0];
        }
    }
}
