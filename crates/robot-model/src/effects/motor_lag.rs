//! Motor lag.

use crate::effect::export::Way;
use crate::effect::{Effect, EffectSpec, Export, Parameter, Values};
use crate::robot::Robot;
use crate::scalar::Scalar;

/// τ dT/dt = T_logged − T, in series with the current loop
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "motor_lag",
    name: "motor lag",
    law: "τ dT/dt = T_logged − T, in series with the current loop",
    seen: "Answers softly; overshoots in fast manoeuvres.",
    parameters: &[Parameter::shaped("τ", "s", [0.0, 1.0], 0.0, &[0.05, 0.12])],
    interest: 0.04,
    revealed_by: "steps of torque",
    resembles: "transport_delay in slow drives",
    source: "first-order lag",
    export: Export {
        mjcf: Way::Held(
            "time constant of the actuators' filter; the smaller of two lags is a \
            delay to first order",
        ),
        ..Export::DRIVE
    },
    ..EffectSpec::COMMAND
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn robot(&self, v: &Values<T>, r: &mut Robot<T>) {
        r.drive.extra_lag += v[0];
    }
}
