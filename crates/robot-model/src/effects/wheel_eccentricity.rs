//! Wheels of one side out of true.

use crate::chassis::Chassis;
use crate::effect::export::{Carrier, Section, Way};
use crate::effect::{
    Coefficients, Effect, EffectSpec, Export, OperatingPoint, Parameter, Scopes, SizedBy, Values,
};
use crate::scalar::Scalar;

/// r(θ) = r + e(θ), e(θ) = (e_c ± d_c) cos θ + (e_s ± d_s) sin θ on one side, + at its front wheel and − at its rear wheel;
/// grip and rolling resistance of each in proportion to its load, times 1 + κ e(θ), from 0 to 2
///
/// Two wheels are out of true by amounts and at angles of their own; `√(e_c² + e_s² + d_c² + d_s²)` is the root mean
/// square of their amounts; where a side has one wheel, d does nothing. A wheel presses harder while its long side is
/// down, by its stiffness over its load at rest, κ, if the body stays where it is; κ = 0 if the body follows every rise.
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "wheel_eccentricity",
    name: "wheels of one side out of true",
    law: "r(θ) = r + e(θ), e(θ) = (e_c ± d_c) cos θ + (e_s ± d_s) sin θ on one side, + at its front wheel, − at its rear \
        wheel; grip and rolling resistance of each times 1 + κ e(θ), from 0 to 2",
    seen: "Speed and heading ripple once per turn of the wheel, most of all in turns where the load on the wheel ripples too.",
    parameters: &[
        Parameter::strength("cosine", "m", [-0.05, 0.05], &[0.003]),
        Parameter::strength("sine", "m", [-0.05, 0.05], &[0.003]),
        Parameter::strength("front cosine", "m", [-0.05, 0.05], &[0.003]),
        Parameter::strength("front sine", "m", [-0.05, 0.05], &[0.003]),
        Parameter::shape("κ", "1/m", [0.0, 200.0], 0.0, &[30.0]),
    ],
    scopes: Scopes::ONE_SIDE,
    sized_by: SizedBy::WheelRadius,
    interest: 0.0018,
    revealed_by: "steady straight driving at two speeds",
    resembles: "periodic ripple of the drivetrain",
    source: "geometry; a wheel as a spring under a body that is too heavy to follow",
    export: Export {
        section: Section::Wheels,
        mjcf: Way::Held("place of the wheels' shapes off their axles; wheel angles count"),
        urdf: Way::Held("origin of the wheels' shapes off their axles; wheel angles count"),
        sdf: Way::Held("pose of the wheels' shapes off their axles; wheel angles count"),
        carrier: Carrier::WheelCentre,
        ..Export::BY_CONSTANTS
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
            let rise = [(v[0] + v[2]) * cos + (v[1] + v[3]) * sin, (v[0] - v[2]) * cos + (v[1] - v[3]) * sin];
            let wheels = match at.chassis {
                Chassis::SkidSteer | Chassis::FourMotors => [(j, rise[0]), (j + 2, rise[1])],
                // One wheel, and d would say what e says: half of each of two like it.
                Chassis::Differential => [(j, T::zero()), (j + 2, v[0] * cos + v[1] * sin)],
            };
            for (i, rise) in wheels {
                // Not below nothing, and not above twice: it lifts its neighbour then.
                let load = (T::one() + v[4] * rise).max(T::zero()).min(T::one() + T::one());
                c.radius[i] += rise;
                c.adhesion[i] *= load;
                c.rolling[i] *= load;
            }
        }
    }
}
