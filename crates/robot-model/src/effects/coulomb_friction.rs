//! Dry friction of both drivetrains.

use crate::effect::export::{Section, Way};
use crate::effect::{Coefficients, Effect, EffectSpec, Export, OperatingPoint, Parameter, SizedBy, Values};
use crate::scalar::Scalar;

/// T = Tc sign ω on each side
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "coulomb_friction",
    name: "dry friction of the drivetrain",
    law: "T = Tc sign ω on each side",
    seen: "Takes the same extra torque on both sides at every speed and every load; the sign \
        follows the motion.",
    parameters: &[Parameter::strength("Tc", "N m", [0.0, 20.0], &[0.2])],
    sized_by: SizedBy::Traction,
    interest: 0.12,
    rarity: 3.0,
    revealed_by: "straight drives at several steady speeds, light and loaded",
    resembles: "rolling_resistance at constant load; thermal_drift over one drive; \
        viscous_friction over a narrow range of speeds",
    source: "Coulomb friction",
    export: Export {
        section: Section::Wheels,
        ..Export::BY_CONSTANTS.everywhere(Way::Held("dry friction of the wheel joints"))
    },
    ..EffectSpec::PHYSICS
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn apply(&self, v: &Values<T>, _at: &OperatingPoint<T>, c: &mut Coefficients<T>) {
        for t in &mut c.coulomb {
            *t += v[0];
        }
    }
}
