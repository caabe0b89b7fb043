//! Scale error of one encoder.

use crate::effect::export::{Carrier, Residual, Way};
use crate::effect::{Effect, EffectSpec, Export, Parameter, Readings, Redundancy, Scopes, Values};
use crate::scalar::Scalar;

/// ω_enc = (1 + s) ω on one side
pub struct Law;

/// What is known about it.
pub const SPEC: EffectSpec = EffectSpec {
    id: "encoder_scale",
    name: "encoder scale error on one side",
    law: "ω_enc = (1 + s) ω on one side",
    seen: "The wheel seems to turn more (less) than it does, in the same proportion always.",
    parameters: &[Parameter::strength("s", "-", [-0.9, 4.0], &[0.3])],
    signed: true,
    scopes: Scopes::ONE_SIDE,
    redundancy: Redundancy::WheelScale,
    interest: 0.25,
    rarity: 3.0,
    revealed_by: "a long straight drive both ways, with a pose",
    resembles: "wheel_radius_mismatch: the same to every sensor, so below a quarter, which no \
        tyre differs by, nothing is said; a side that slips all the time",
    source: "sensor model; wrong counts per turn or decoding",
    export: Export {
        mjcf: Way::Held("a tendon whose length the encoder reads"),
        sdf: Way::Added("its sensors have no gain"),
        carrier: Carrier::EncoderGain,
        residual: Residual::Reading(&[
            "for j in {sides}:",
            "    y[\"wheel_speed\"][j] *= 1.0 + {0}",
        ]),
        ..Export::SENSOR
    },
    ..EffectSpec::SENSOR
};

impl<T: Scalar> Effect<T> for Law {
    fn spec(&self) -> &'static EffectSpec {
        &SPEC
    }

    fn sense(&self, v: &Values<T>, y: &mut Readings<T>) {
        for w in &mut y.wheel_speed {
            *w *= T::one() + v[0];
        }
    }
}
