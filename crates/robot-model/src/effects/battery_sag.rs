//! Voltage of the battery that falls with the load.

use crate::effect::{Card, Effect, Kind, Parameter, Redundancy, Role, Scale, Situation, Values, WHOLE, World};
use crate::scalar::{Scalar, real};

/// T = (1 − σ (|T_left| + |T_right|)) T_commanded
pub struct Law;

/// Share of the voltage at which a battery cuts out.
const MOST: f64 = 0.8;

const CARD: Card = Card {
    id: "battery_sag",
    name: "battery sag",
    kind: Kind::Command,
    law: "T = (1 − σ (|T_left| + |T_right|)) T_commanded: the voltage falls by the internal resistance times the current, and the torque of a motor at constant duty with it",
    seen: "Each side loses torque when the other one works, the more the harder both do; nothing at light load.",
    parameters: &[
        Parameter { name: "σ", unit: "1/(N m)", role: Role::Strength, bounds: [0.0, 0.2], neutral: 0.0, probes: &[0.01], scale: Scale::Own },
    ],
    signed: false,
    axes: &[],
    wears: WHOLE,
    redundancy: Redundancy::None,
    interest: 0.005,
    rarity: 3.0,
    revealed_by: "spins and hard acceleration, then one side alone at the same torque",
    resembles: "torque_saturation and load_dependent_friction at high torque; torque_constant at one torque",
    source: "Thévenin battery V = V0 − R I and a constant-voltage motor T ∝ V, back-EMF left out; Chen & Rincón-Mora 2006, IEEE Trans. Energy Convers. 21(2)",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn act(&self, v: &Values<T>, at: &Situation<T>, w: &mut World<T>) {
        let [a, b] = at.torque;
        let lost = (v[0] * (a.abs() + b.abs())).min(real(MOST));
        w.torque[0] -= lost * a;
        w.torque[1] -= lost * b;
    }
}
