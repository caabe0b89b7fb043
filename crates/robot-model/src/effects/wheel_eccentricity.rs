//! Wheels of one side out of true.

use crate::effect::{Card, Effect, Kind, ONE_SIDE, Parameter, Redundancy, Role, Scale, Situation, Values, World};
use crate::scalar::Scalar;

/// r(θ) = r + e_c cos θ + e_s sin θ on one side
pub struct Law;

const CARD: Card = Card {
    id: "wheel_eccentricity",
    name: "wheels of one side out of true",
    kind: Kind::Physics,
    law: "r(θ) = r + e_c cos θ + e_s sin θ on one side",
    seen: "Speed and heading ripple once per turn of the wheel.",
    parameters: &[
        Parameter { name: "cosine", unit: "m", role: Role::Strength, bounds: [-0.05, 0.05], neutral: 0.0, probes: &[0.003], scale: Scale::Own },
        Parameter { name: "sine", unit: "m", role: Role::Strength, bounds: [-0.05, 0.05], neutral: 0.0, probes: &[0.003], scale: Scale::Own },
    ],
    signed: false,
    axes: &[],
    wears: ONE_SIDE,
    redundancy: Redundancy::None,
    interest: 0.0018,
    rarity: 0.0,
    revealed_by: "steady straight driving at two speeds",
    resembles: "periodic ripple of the drivetrain",
    source: "geometry",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn act(&self, v: &Values<T>, at: &Situation<T>, w: &mut World<T>) {
        for j in 0..2 {
            let (s, c) = at.wheel_angle[j].sin_cos();
            for r in [j, j + 2] {
                w.radius[r] += v[0] * c + v[1] * s;
            }
        }
    }
}
