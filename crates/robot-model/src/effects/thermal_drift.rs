//! Drift of the friction with temperature.

use crate::effect::export::{Residual, Section, Way};
use crate::effect::{
    Coefficients, Effect, EffectSpec, Export, LoadTerm, OperatingPoint, Parameter, SizedBy, Values,
};
use crate::scalar::Scalar;

/// T = A (1 − exp(−t/τ)) sign ω on each side, t from the start of a run
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "thermal_drift",
    name: "drift of the friction with temperature",
    law: "T = A (1 − exp(−t/τ)) sign ω on each side, t from the start of a run",
    seen: "Friction rises (falls) during a run and is back at the next.",
    parameters: &[
        Parameter::strength("A", "N m", [-5.0, 20.0], &[0.3]),
        Parameter::shape("τ", "s", [1.0, 600.0], 7.0, &[7.0]),
    ],
    signed: true,
    load_term: Some(LoadTerm::Drift),
    sized_by: SizedBy::Traction,
    interest: 0.14,
    revealed_by: "one long drive of steady speed after a rest",
    resembles: "stiction or rolling resistance from an instant on",
    source: "first-order thermal model",
    export: Export {
        section: Section::Wheels,
        residual: Residual::Force(&[
            "grown = {0} * (1.0 - exp(-t / {1}))  # t: s since the start of the run",
            "for j in {sides}:",
            "    torque[j] -= grown * sign(w[j])",
        ]),
        ..Export::ADDED_BY_HAND
            .everywhere(Way::Added("friction of a joint does not change in time"))
    },
    ..EffectSpec::PHYSICS
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn apply(&self, v: &Values<T>, at: &OperatingPoint<T>, c: &mut Coefficients<T>) {
        let grown = v[0] * (T::one() - (-at.time / v[1]).exp());
        for t in &mut c.coulomb {
            *t += grown;
        }
    }
}
