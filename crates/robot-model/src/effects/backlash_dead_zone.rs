//! Dead band of the transmission.

use crate::effect::export::Way;
use crate::effect::{Effect, EffectSpec, Export, Parameter, SizedBy, Values};
use crate::robot::Robot;
use crate::scalar::Scalar;

/// no torque within ±d, beyond it T − d sign T
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "backlash_dead_zone",
    name: "dead band of the transmission",
    law: "no torque within ±d, beyond it T − d sign T",
    seen: "Ignores small torques.",
    parameters: &[Parameter::shaped("d", "N m", [0.0, 20.0], 0.0, &[0.15, 0.4])],
    sized_by: SizedBy::Traction,
    interest: 0.08,
    revealed_by: "slow drives with small torques of both signs",
    resembles: "Coulomb friction as long as torque and motion have the same sign",
    source: "dead zone",
    export: Export { mjcf: Way::Added("actuators have no dead band"), ..Export::DRIVE },
    ..EffectSpec::COMMAND
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn robot(&self, v: &Values<T>, r: &mut Robot<T>) {
        r.drive.dead_band += v[0];
    }
}
