//! Extra mass.

use crate::effect::export::{Carrier, Way};
use crate::effect::{Effect, EffectSpec, Export, Parameter, SizedBy, Values};
use crate::robot::Robot;
use crate::scalar::{Scalar, real};

/// m + Δm, I_z + (a² + b²)/3 Δm, carried 0.8 r above the centre of mass
///
/// a: half the wheelbase, b: half the track, r: radius of the wheels.
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "payload",
    name: "extra mass",
    law: "m + Δm, I_z + (a² + b²)/3 Δm, carried 0.8 r above the centre of mass",
    seen: "Accelerates more slowly, rolls and scrubs harder; coasts further.",
    parameters: &[Parameter::strength("mass", "kg", [0.0, 200.0], &[2.0])],
    sized_by: SizedBy::Mass,
    interest: 1.0,
    revealed_by: "hard acceleration and braking, then spins both ways",
    resembles: "torque_constant on level ground; motor inertia in straight drives",
    source: "rigid body mechanics",
    export: Export {
        carrier: Carrier::OwnBody,
        ..Export::BY_CONSTANTS
            .everywhere(Way::Held("mass, height and inertia of a body of its own, payload"))
    },
    ..EffectSpec::PHYSICS
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn robot(&self, v: &Values<T>, r: &mut Robot<T>) {
        let grown = r.mass + v[0];
        // The load lies on a deck above the centre of mass it joins, spread over the rectangle between the wheels.
        let spread = r.half_wheelbase * r.half_wheelbase + r.half_track * r.half_track;
        r.com[2] += real::<T>(0.8) * r.wheel_radius * v[0] / grown;
        r.yaw_inertia += spread / real(3.0) * v[0];
        r.mass = grown;
    }
}
