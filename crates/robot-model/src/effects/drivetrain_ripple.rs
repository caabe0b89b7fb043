//! Torque of one side that ripples with the wheel angle.

use crate::effect::{Card, Effect, Kind, ONE_SIDE, Parameter, Redundancy, Role, Scale, Situation, Values, World};
use crate::scalar::Scalar;

/// T = T_c cos θ + T_s sin θ on one side, once per turn of the wheel
pub struct Law;

const CARD: Card = Card {
    id: "drivetrain_ripple",
    name: "torque ripple of one drivetrain",
    kind: Kind::Physics,
    law: "T = T_c cos θ + T_s sin θ on one side, once per turn of the wheel",
    seen: "The torque ripples once per turn of the wheel, also at crawling speed, and hardly moves the robot when fast.",
    parameters: &[
        Parameter { name: "cosine", unit: "N m", role: Role::Strength, bounds: [-10.0, 10.0], neutral: 0.0, probes: &[0.2], scale: Scale::Own },
        Parameter { name: "sine", unit: "N m", role: Role::Strength, bounds: [-10.0, 10.0], neutral: 0.0, probes: &[0.2], scale: Scale::Own },
    ],
    signed: false,
    axes: &[],
    wears: ONE_SIDE,
    redundancy: Redundancy::None,
    interest: 0.15,
    rarity: 6.0,
    revealed_by: "slow steady straight driving, then fast",
    resembles: "wheel_eccentricity, which ripples with the speed instead: the commoner of the two; stiction at crawling speed",
    source: "first harmonic of a torque that is periodic in the angle; Holtz & Springob 1996, IEEE Trans. Ind. Electron. 43(2)",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn act(&self, v: &Values<T>, at: &Situation<T>, w: &mut World<T>) {
        for j in 0..2 {
            let (s, c) = at.wheel_angle[j].sin_cos();
            w.torque[j] += v[0] * c + v[1] * s;
        }
    }
}
