//! Drift of the friction with temperature.

use crate::effect::{Card, Effect, Kind, Parameter, Redundancy, Role, Scale, Situation, Values, WHOLE, World};
use crate::scalar::Scalar;

/// T = A (1 − exp(−t/τ)) sign ω on each side, t from the start of a run
pub struct Law;

const CARD: Card = Card {
    id: "thermal_drift",
    name: "drift of the friction with temperature",
    kind: Kind::Physics,
    law: "T = A (1 − exp(−t/τ)) sign ω on each side, t from the start of a run",
    seen: "Friction rises (falls) during a run and is back at the next.",
    parameters: &[
        Parameter { name: "A", unit: "N m", role: Role::Strength, bounds: [-5.0, 20.0], neutral: 0.0, probes: &[0.3], scale: Scale::Own },
        Parameter { name: "τ", unit: "s", role: Role::Shape, bounds: [1.0, 600.0], neutral: 7.0, probes: &[7.0], scale: Scale::Own },
    ],
    signed: true,
    axes: &[],
    wears: WHOLE,
    redundancy: Redundancy::None,
    interest: 0.14,
    rarity: 0.0,
    revealed_by: "one long drive of steady speed after a rest",
    resembles: "stiction or rolling resistance from an instant on",
    source: "first-order thermal model",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn act(&self, v: &Values<T>, at: &Situation<T>, w: &mut World<T>) {
        let grown = v[0] * (T::one() - (-at.time / v[1]).exp());
        for t in &mut w.coulomb {
            *t += grown;
        }
    }
}
