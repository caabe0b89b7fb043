//! Torque of one side that ripples with the wheel angle.

use crate::effect::export::{Residual, Section, Way};
use crate::effect::{
    Coefficients, Effect, EffectSpec, Export, OperatingPoint, Parameter, Scopes, SizedBy, Values,
};
use crate::scalar::Scalar;

/// T = T_c cos θ + T_s sin θ on one side, once per turn of the wheel
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "drivetrain_ripple",
    name: "torque ripple of one drivetrain",
    law: "T = T_c cos θ + T_s sin θ on one side, once per turn of the wheel",
    seen: "The torque ripples once per turn of the wheel, also at crawling speed, and hardly \
        moves the robot when fast.",
    parameters: &[
        Parameter::strength("cosine", "N m", [-10.0, 10.0], &[0.2]),
        Parameter::strength("sine", "N m", [-10.0, 10.0], &[0.2]),
    ],
    scopes: Scopes::ONE_SIDE,
    sized_by: SizedBy::Traction,
    interest: 0.15,
    rarity: 6.0,
    revealed_by: "slow steady straight driving, then fast",
    resembles: "wheel_eccentricity, which ripples with the speed instead: the commoner of the \
        two; stiction at crawling speed",
    source: "first harmonic of a torque that is periodic in the angle; Holtz & Springob 1996, \
        IEEE Trans. Ind. Electron. 43(2)",
    export: Export {
        section: Section::Wheels,
        residual: Residual::Force(&[
            "for j in {sides}:",
            "    torque[j] += {0} * cos(angle[j]) + {1} * sin(angle[j])",
        ]),
        ..Export::ADDED_BY_HAND
            .everywhere(Way::Added("torques of a joint do not depend on its angle in this way"))
    },
    ..EffectSpec::PHYSICS
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn apply(&self, v: &Values<T>, at: &OperatingPoint<T>, c: &mut Coefficients<T>) {
        for j in 0..2 {
            let (sin, cos) = at.wheel_angle[j].sin_cos();
            c.torque[j] += v[0] * cos + v[1] * sin;
        }
    }
}
