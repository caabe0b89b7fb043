//! Stiction (Stribeck friction).

use crate::effect::export::{Section, Way};
use crate::effect::{Coefficients, Effect, EffectSpec, Export, OperatingPoint, Parameter, SizedBy, Values};
use crate::scalar::Scalar;

/// T = Ts exp(−(ω/ωs)²) sign ω on each side, ωs = 0.6 rad/s
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "stiction",
    name: "stiction (Stribeck friction)",
    law: "T = Ts exp(−(ω/ωs)²) sign ω on each side, ωs = 0.6 rad/s",
    seen: "Sticks at rest and jumps when it breaks loose; nothing at speed.",
    parameters: &[Parameter::strength("Ts", "N m", [0.0, 20.0], &[0.4])],
    sized_by: SizedBy::Traction,
    interest: 0.4,
    // Joints fade within 0.05 to 2 rad/s: three robots of other hands were told 1.6 to 2 times what they had.
    law_error: 0.3,
    revealed_by: "slow starts, stops and reversals",
    resembles: "backlash_dead_zone near rest",
    source: "Armstrong-Hélouvry et al. 1994, Automatica 30(7)",
    export: Export {
        section: Section::Wheels,
        ..Export::BY_CONSTANTS
            .everywhere(Way::Added("dry friction of a joint does not rise towards rest"))
    },
    ..EffectSpec::PHYSICS
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn apply(&self, v: &Values<T>, _at: &OperatingPoint<T>, c: &mut Coefficients<T>) {
        for t in &mut c.stribeck {
            *t += v[0];
        }
    }
}
