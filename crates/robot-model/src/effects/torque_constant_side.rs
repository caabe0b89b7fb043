//! Torque constant of one side.

use crate::effect::export::{Residual, Way};
use crate::effect::{Coefficients, Effect, EffectSpec, Export, OperatingPoint, Parameter, Scopes, Values};
use crate::scalar::Scalar;

/// T = (1 + κ) T_logged on one side
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "torque_constant_side",
    name: "torque constant of one side",
    law: "T = (1 + κ) T_logged on one side",
    seen: "One side takes more (less) current than the other for the same work, in proportion to the \
        torque: it pulls to one side, the more the harder it accelerates.",
    // A speed-driven step finds the torque by that of the step before: it does where the share is below one.
    parameters: &[Parameter::strength("κ", "-", [-0.8, 0.8], &[-0.08])],
    scopes: Scopes::ONE_SIDE_OR_LATER,
    signed: true,
    interest: 0.045,
    rarity: 3.0,
    revealed_by: "hard straight acceleration and braking, then steady straight driving",
    resembles: "coulomb_side in steady straight drives; wheel_radius_mismatch where speeds are not \
        measured",
    source: "motor equation; a magnet that lost its field or a driver that scales its current \
        otherwise",
    export: Export {
        mjcf: Way::Added("the actuators of both sides have one gain"),
        residual: Residual::Force(&["for j in {sides}:", "    torque[j] += {0} * T[j]"]),
        ..Export::DRIVE
    },
    ..EffectSpec::COMMAND
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn apply(&self, v: &Values<T>, at: &OperatingPoint<T>, c: &mut Coefficients<T>) {
        for (added, delivered) in c.torque.iter_mut().zip(at.torque) {
            *added += v[0] * delivered;
        }
    }
}
