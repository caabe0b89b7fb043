//! Scale error of one encoder.

use crate::effect::{Card, Effect, Kind, ONE_SIDE, Parameter, Readings, Redundancy, Role, Scale, Values};
use crate::scalar::Scalar;

/// ω_enc = (1 + s) ω on one side
pub struct Law;

const CARD: Card = Card {
    id: "encoder_scale",
    name: "encoder scale error on one side",
    kind: Kind::Sensor,
    law: "ω_enc = (1 + s) ω on one side",
    seen: "The wheel seems to turn more (less) than it does, in the same proportion always.",
    parameters: &[
        Parameter { name: "s", unit: "-", role: Role::Strength, bounds: [-0.9, 4.0], neutral: 0.0, probes: &[0.3], scale: Scale::Own },
    ],
    signed: true,
    axes: &[],
    wears: ONE_SIDE,
    redundancy: Redundancy::WheelScale,
    interest: 0.25,
    rarity: 3.0,
    revealed_by: "a long straight drive both ways, with a pose",
    resembles: "wheel_radius_mismatch: the same to every sensor, so below a quarter, which no tyre differs by, nothing is said; a side that slips all the time",
    source: "sensor model; wrong counts per turn or decoding",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn sense(&self, v: &Values<T>, y: &mut Readings<T>) {
        for w in &mut y.wheel_speed {
            *w *= T::one() + v[0];
        }
    }
}
