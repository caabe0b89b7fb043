//! Turning (lateral scrub) resistance.

use crate::effect::export::{Section, Way};
use crate::effect::{
    Coefficients, Effect, EffectSpec, Export, LoadTerm, OperatingPoint, Parameter, Values,
};
use crate::scalar::Scalar;

/// lateral adhesion times (1 + σ)
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "turning_resistance",
    name: "turning (lateral scrub) resistance",
    law: "lateral adhesion times (1 + σ)",
    seen: "Turning costs more (less), straight driving the same.",
    parameters: &[Parameter::strength("σ", "-", [-0.9, 3.0], &[-0.1])],
    signed: true,
    load_term: Some(LoadTerm::Turning),
    interest: 0.08,
    revealed_by: "spins both ways at two speeds",
    resembles: "adhesion_patch in turns; yaw inertia in fast turns",
    source: "Kozłowski & Pazderski 2004, Int. J. Appl. Math. Comput. Sci. 14(4)",
    export: Export {
        section: Section::Ground,
        mjcf: Way::Held("friction of the contacts along the axles"),
        urdf: Way::Held("mu1 of the wheels, in gazebo tags"),
        sdf: Way::Held("mu of the wheels' surfaces"),
        ..Export::BY_CONSTANTS
    },
    ..EffectSpec::PHYSICS
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn apply(&self, v: &Values<T>, _at: &OperatingPoint<T>, c: &mut Coefficients<T>) {
        for k in &mut c.lateral {
            *k *= T::one() + v[0];
        }
    }
}
