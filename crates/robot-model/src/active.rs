//! An effect at work: values and presence.

use crate::effect::{Coefficients, Effect, Kind, MAX_PARAMETERS, OperatingPoint, Readings, Values};
use crate::presence::Presence;
use crate::scalar::{Scalar, real};

/// An effect at given values, present somewhere.
#[derive(Clone, Copy)]
pub struct Active<T: Scalar> {
    pub(crate) effect: &'static dyn Effect<T>,
    values: Values<T>,
    presence: Presence<T>,
    unlimited: bool,
    /// Whether it changes what sensors show.
    pub(crate) senses: bool,
}

impl<T: Scalar> Active<T> {
    /// An effect at `values` (the order of its specification; missing ones at their neutral value), present where `presence` says.
    pub fn new(effect: &'static dyn Effect<T>, values: &[T], presence: Presence<T>) -> Self {
        let mut v = [T::zero(); MAX_PARAMETERS];
        for (i, p) in effect.spec().parameters.iter().enumerate().take(MAX_PARAMETERS) {
            v[i] = values.get(i).copied().unwrap_or_else(|| real(p.neutral));
        }
        let senses = effect.spec().kind == Kind::Sensor;
        Self { effect, values: v, presence, unlimited: presence.is_unlimited(), senses }
    }

    pub(crate) fn values(&self) -> &Values<T> {
        &self.values
    }

    /// Changes the coefficients of an instant, as far as the effect is present.
    #[inline(always)]
    pub fn apply(&self, at: &OperatingPoint<T>, c: &mut Coefficients<T>) {
        if self.unlimited {
            self.effect.apply(self.values(), at, c);
        } else {
            let mut changed = *c;
            self.effect.apply(self.values(), at, &mut changed);
            c.blend(&changed, self.presence.at(at), at.chassis);
        }
    }

    /// A sensor of one side keeps to that side; when and where do not limit what sensors show.
    #[inline(always)]
    pub(crate) fn sense(&self, readings: &mut Readings<T>) {
        let before = *readings;
        self.effect.sense(self.values(), readings);
        if let Some(side) = self.presence.side {
            let other = 1 - side.min(1);
            readings.wheel_speed[other] = before.wheel_speed[other];
            readings.torque[other] = before.torque[other];
        }
    }
}
