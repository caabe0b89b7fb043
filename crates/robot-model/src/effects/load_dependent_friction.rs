//! Loss of the gears in proportion to the torque they transmit.

use crate::effect::export::{Residual, Section, Way};
use crate::effect::{Coefficients, Effect, EffectSpec, Export, OperatingPoint, Parameter, Values};
use crate::scalar::Scalar;

/// T = β |T_drive| sign ω on each side
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "load_dependent_friction",
    name: "load-dependent friction of the gears",
    law: "T = β |T_drive| sign ω on each side: the gears pass η = 1 − β of the torque when \
        driving, and hold back β of it when driven",
    seen: "The harder it pulls or brakes the more torque is lost; nothing when coasting.",
    parameters: &[Parameter::strength("β", "-", [0.0, 0.9], &[0.05])],
    interest: 0.04,
    rarity: 3.0,
    revealed_by: "hard acceleration and hard braking at the same speed, and coasting",
    resembles: "torque_constant as long as it never brakes; coulomb_friction at constant load",
    source: "Hamon, Gautier & Garrec 2010, IROS: dry friction that depends on load and velocity; \
        gear efficiency η = 1 − β",
    export: Export {
        section: Section::Wheels,
        residual: Residual::Force(&[
            "for j in {sides}:",
            "    torque[j] -= {0} * abs(T[j]) * sign(w[j])",
        ]),
        ..Export::ADDED_BY_HAND
            .everywhere(Way::Added("friction of a joint does not depend on its torque"))
    },
    ..EffectSpec::PHYSICS
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn apply(&self, v: &Values<T>, at: &OperatingPoint<T>, c: &mut Coefficients<T>) {
        for j in 0..2 {
            c.coulomb[j] += v[0] * at.torque[j].abs();
        }
    }
}
