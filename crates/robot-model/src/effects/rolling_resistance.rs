//! Rolling resistance.

use crate::effect::export::{Exception, Residual, Section, Way, When};
use crate::effect::{
    Coefficients, Effect, EffectSpec, Export, LoadTerm, OperatingPoint, Parameter, Scopes, Values,
};
use crate::scalar::Scalar;

/// T = Δf_r N r sign ω at each wheel
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "rolling_resistance",
    name: "rolling resistance",
    law: "T = Δf_r N r sign ω at each wheel",
    seen: "Every metre costs more torque, in proportion to the load and whatever the speed.",
    parameters: &[Parameter::added("Δf_r", |robot| robot.rolling_resistance, [-0.2, 1.0], &[0.03])],
    scopes: Scopes::GROUND,
    load_term: Some(LoadTerm::Rolling),
    interest: 0.01,
    revealed_by: "straight drives both ways and coasting down",
    resembles: "grade and constant_pull in one-way drives; Coulomb friction at constant load",
    source: "Hendzel & Trojnacki 2014, a6 to a8 of Eq. 8",
    export: Export {
        section: Section::Ground,
        residual: Residual::Force(&[
            "at_wheel = [{rolling}]  # N m",
            "for i in range(4):",
            "    torque[i % 2] -= at_wheel[i] * share(i, {place}) * sign(w[i % 2])",
        ]),
        exceptions: &[Exception {
            engine: None,
            when: When::AtPlace,
            why: "joint friction is the same wherever the robot is",
        }],
        ..Export::ADDED_BY_HAND
            .everywhere(Way::Held("dry friction of the wheel joints, at the loads at rest"))
    },
    ..EffectSpec::PHYSICS
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn apply(&self, v: &Values<T>, _at: &OperatingPoint<T>, c: &mut Coefficients<T>) {
        for f in &mut c.rolling {
            *f += v[0];
        }
    }
}
