//! Sloping ground: grade and side slope are one effect, for a heading turns one into the other.

use crate::effect::export::{Residual, Section, Way};
use crate::effect::{
    Coefficients, Effect, EffectSpec, Export, LoadTerm, OperatingPoint, Parameter, Values,
};
use crate::scalar::{Scalar, real};

/// F = m g sin α along the downhill direction, fixed in the world
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "grade",
    name: "sloping ground",
    law: "F = m g sin α along the downhill direction, any, fixed in the world: grade and side \
        slope alike",
    seen: "Costs torque uphill, saves it downhill and pulls sideways across the slope; changes \
        with the heading.",
    parameters: &[
        Parameter::strength("downhill x", "rad", [-0.6, 0.6], &[0.02]),
        Parameter::strength("downhill y", "rad", [-0.6, 0.6], &[0.02]),
    ],
    load_term: Some(LoadTerm::Slope),
    interest: 0.01,
    revealed_by: "the same path in the opposite direction",
    resembles: "rolling_resistance or constant_pull as long as all drives go one way",
    source: "statics",
    export: Export {
        section: Section::Ground,
        mjcf: Way::Held("direction of gravity"),
        urdf: Way::Added(
            "it describes a robot, not the world; in Gazebo gravity is a property of \
            the world",
        ),
        sdf: Way::Held("direction of the world's gravity"),
        residual: Residual::Force(&[
            "# {force x} {force y} N in the world's axes",
            "force[0] += {force x} * ch + {force y} * sh",
            "force[1] += {force y} * ch - {force x} * sh",
        ]),
        ..Export::ADDED_BY_HAND
    },
    ..EffectSpec::PHYSICS
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn apply(&self, v: &Values<T>, at: &OperatingPoint<T>, c: &mut Coefficients<T>) {
        let [cos, sin] = at.heading;
        // sin α along the slope'sin direction, to third order: 0.02 % at 0.6 rad.
        let a2 = v[0] * v[0] + v[1] * v[1];
        let g = at.gravity * (T::one() - a2 / real(6.0) + a2 * a2 / real(120.0));
        c.tilt[0] += g * (v[0] * cos + v[1] * sin);
        c.tilt[1] += g * (v[1] * cos - v[0] * sin);
    }
}
