//! Constant pull at the hitch.

use crate::effect::export::{Residual, Way};
use crate::effect::{
    Coefficients, Effect, EffectSpec, Export, LoadTerm, OperatingPoint, Parameter, SizedBy, Values,
};
use crate::scalar::Scalar;

/// F = −P along the body's x at the rear hitch
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "constant_pull",
    name: "constant pull at the hitch",
    law: "F = −P along the body's x at the rear hitch",
    seen: "Costs torque forward and saves it backward, whatever the heading.",
    parameters: &[Parameter::strength("P", "N", [0.0, 500.0], &[4.0])],
    load_term: Some(LoadTerm::Pull),
    sized_by: SizedBy::Weight,
    interest: 2.0,
    revealed_by: "straight drives forward and backward",
    resembles: "grade while the heading does not change; rolling_resistance in forward drives",
    source: "statics",
    export: Export {
        mjcf: Way::Held("constant force of the actuator pull at the hitch"),
        urdf: Way::Added(
            "its constant wrenches are fixed in the world, this force turns with the \
            robot",
        ),
        sdf: Way::Added(
            "its constant wrenches are fixed in the world, this force turns with the \
            robot",
        ),
        residual: Residual::Force(&["force[0] -= {0}", "moment += {moment}"]),
        ..Export::ADDED_BY_HAND
    },
    ..EffectSpec::PHYSICS
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn apply(&self, v: &Values<T>, at: &OperatingPoint<T>, c: &mut Coefficients<T>) {
        c.force[0] -= v[0];
        c.moment += v[0] * at.hitch[1];
    }
}
