//! Slippery or grippy ground: the level everywhere, or a patch.
//!
//! One effect for both: the law is the same, and a second one that differed by its place only
//! would be a look-alike.

use crate::effect::export::{Carrier, Engine, Exception, Residual, Section, Way, When};
use crate::effect::LOST_SHARE;
use crate::effect::{
    Coefficients, Effect, EffectSpec, Export, OperatingPoint, Parameter, Scopes, Values,
};
use crate::scalar::Scalar;

/// μ (1 − q)
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "adhesion_patch",
    name: "grip of the ground",
    law: "μ (1 − q), everywhere or at one place",
    seen: "Wheels spin or slide earlier; turns come out wider or tighter; at one place or, as \
        the level of grip, everywhere.",
    parameters: &[Parameter::strength(LOST_SHARE, "-", [-2.0, 0.95], &[0.3])],
    scopes: Scopes::GROUND,
    interest: 0.2,
    revealed_by: "hard acceleration and tight turns on and off the place",
    resembles: "turning_resistance in turns; payload in spins",
    source: "Coulomb adhesion",
    export: Export {
        section: Section::Ground,
        mjcf: Way::Held("friction of the wheels' contacts with the ground"),
        urdf: Way::Held("mu1 and mu2 of the wheels, in gazebo tags"),
        sdf: Way::Held("mu and mu2 of the wheels' surfaces, or of a disc on the ground"),
        carrier: Carrier::Grip,
        residual: Residual::Ground(&[
            "for i in range(4):",
            "    grip[i] *= 1.0 - {0} * share(i, {place})",
        ]),
        exceptions: &[
            Exception {
                engine: Some(Engine::Mjcf),
                when: When::AtPlace,
                why: "soft contacts with two surfaces in one place share the load, so that a \
            disc on the ground would act by half",
            },
            Exception {
                engine: Some(Engine::Urdf),
                when: When::AtPlace,
                why: "it describes a robot, not the ground",
            },
        ],
        ..Export::ADDED_BY_HAND
    },
    ..EffectSpec::PHYSICS
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn apply(&self, v: &Values<T>, _at: &OperatingPoint<T>, c: &mut Coefficients<T>) {
        for mu in &mut c.adhesion {
            *mu *= T::one() - v[0];
        }
    }
}
