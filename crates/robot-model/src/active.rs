//! An effect at work: values and presence.

use crate::effect::{Effect, Kind, MAX_PARAMETERS, Readings, Situation, Values, World};
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
    /// An effect at `values` (the card's order; missing ones at their neutral value), present where `presence` says.
    pub fn new(effect: &'static dyn Effect<T>, values: &[T], presence: Presence<T>) -> Self {
        let mut v = [T::zero(); MAX_PARAMETERS];
        for (i, p) in effect.card().parameters.iter().enumerate().take(MAX_PARAMETERS) {
            v[i] = values.get(i).copied().unwrap_or_else(|| real(p.neutral));
        }
        let senses = effect.card().kind == Kind::Sensor;
        Self { effect, values: v, presence, unlimited: presence.is_unlimited(), senses }
    }

    pub(crate) fn values(&self) -> &Values<T> {
        &self.values
    }

    #[inline(always)]
    pub(crate) fn act(&self, at: &Situation<T>, world: &mut World<T>) {
        if self.unlimited {
            self.effect.act(self.values(), at, world);
        } else {
            let mut changed = *world;
            self.effect.act(self.values(), at, &mut changed);
            world.blend(&changed, self.presence.at(at));
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
