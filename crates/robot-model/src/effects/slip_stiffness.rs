//! Slip stiffness of the ground contact.

use crate::effect::export::{Section, Way};
use crate::effect::{
    Coefficients, Effect, EffectSpec, Export, OperatingPoint, Parameter, Values,
};
use crate::scalar::Scalar;

/// λp (1 + q)
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "slip_stiffness",
    name: "slip stiffness of the tyres",
    law: "λp (1 + q)",
    seen: "Slips more (less) for the same force: the effective track grows, odometry runs ahead.",
    parameters: &[Parameter::strength("q", "-", [-0.9, 20.0], &[1.0])],
    signed: true,
    interest: 1.0,
    revealed_by: "arcs and spins with a gyro or a pose",
    resembles: "adhesion and turning_resistance in turns; wheel radius in straight drives",
    source: "Hendzel & Trojnacki 2014, λp of Eq. 8",
    export: Export {
        section: Section::Ground,
        mjcf: Way::Held(
            "solreffriction and solimp of the contacts: creep at a rim speed in the \
            middle",
        ),
        urdf: Way::Held("slip compliance of the wheels, by Gazebo's wheel slip plugin"),
        sdf: Way::Held("slip compliance of the wheels, by Gazebo's wheel slip plugin"),
        ..Export::BY_CONSTANTS
    },
    ..EffectSpec::PHYSICS
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn apply(&self, v: &Values<T>, _at: &OperatingPoint<T>, c: &mut Coefficients<T>) {
        for s in &mut c.slip_at_peak {
            *s *= T::one() + v[0];
        }
    }
}
