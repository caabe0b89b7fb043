//! Voltage of the battery that falls with the load.

use crate::effect::export::{Residual, Way};
use crate::effect::{Coefficients, Effect, EffectSpec, Export, OperatingPoint, Parameter, SizedBy, Values};
use crate::scalar::{Scalar, real};

/// T = (1 − σ (|T_left| + |T_right|)) T_commanded
pub struct Law;

/// Share of the voltage at which a battery cuts out.
const MOST: f64 = 0.8;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "battery_sag",
    name: "battery sag",
    law: "T = (1 − σ (|T_left| + |T_right|)) T_commanded: the voltage falls by the internal \
        resistance times the current, and the torque of a motor at constant duty with it",
    seen: "Each side loses torque when the other one works, the more the harder both do; nothing \
        at light load.",
    parameters: &[Parameter::strength("σ", "1/(N m)", [0.0, 0.2], &[0.01])],
    sized_by: SizedBy::PerTraction,
    interest: 0.005,
    rarity: 3.0,
    revealed_by: "spins and hard acceleration, then one side alone at the same torque",
    resembles: "torque_saturation and load_dependent_friction at high torque; torque_constant at \
        one torque",
    source: "Thévenin battery V = V0 − R I and a constant-voltage motor T ∝ V, back-EMF left \
        out; Chen & Rincón-Mora 2006, IEEE Trans. Energy Convers. 21(2)",
    export: Export {
        mjcf: Way::Added("the torque of an actuator does not depend on that of another"),
        residual: Residual::Force(&[
            "lost = min({0} * (abs(T[0]) + abs(T[1])), 0.8)",
            "for j in (0, 1):",
            "    torque[j] -= lost * T[j]",
        ]),
        ..Export::DRIVE
    },
    ..EffectSpec::COMMAND
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn apply(&self, v: &Values<T>, at: &OperatingPoint<T>, c: &mut Coefficients<T>) {
        let [a, b] = at.torque;
        let lost = (v[0] * (a.abs() + b.abs())).min(real(MOST));
        c.torque[0] -= lost * a;
        c.torque[1] -= lost * b;
    }
}
