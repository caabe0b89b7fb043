//! Quadratic drag.

use crate::effect::export::{Carrier, Residual, Way};
use crate::effect::{Coefficients, Effect, EffectSpec, Export, OperatingPoint, Parameter, SizedBy, Values};
use crate::scalar::{Scalar, real};

/// F = −c v |v|
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "quadratic_drag",
    name: "quadratic drag",
    law: "F = −c v |v|",
    seen: "Costs more the faster it drives, hardly anything in spins.",
    parameters: &[Parameter::strength("c", "N s²/m²", [0.0, 200.0], &[4.0])],
    sized_by: SizedBy::Mass,
    interest: 1.6,
    // Brush tyres and warm grease: prototype without references, on the development cases.
    form_error: 2.5,
    revealed_by: "straight drives at three speeds",
    resembles: "viscous_friction over a narrow range of speed",
    source: "fluid drag",
    export: Export {
        mjcf: Way::Held(
            "blunt drag of a sphere at the centre of mass, in a medium too thin for \
            anything else",
        ),
        urdf: Way::Added("it has no medium, and Gazebo's drags differ by axis"),
        sdf: Way::Added("its drags differ by axis"),
        carrier: Carrier::Drag,
        residual: Residual::Force(&[
            "speed = hypot(v[0], v[1])",
            "force[0] -= {0} * speed * v[0]",
            "force[1] -= {0} * speed * v[1]",
        ]),
        ..Export::ADDED_BY_HAND
    },
    ..EffectSpec::PHYSICS
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn apply(&self, v: &Values<T>, at: &OperatingPoint<T>, c: &mut Coefficients<T>) {
        let [x, y] = at.velocity;
        // At rest the square root has no derivative, the drag has.
        let speed = (x * x + y * y).max(real(1e-20)).sqrt();
        c.force[0] -= v[0] * speed * x;
        c.force[1] -= v[0] * speed * y;
    }
}
