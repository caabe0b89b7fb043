//! Where and when an effect is present: a limit that any law may be given.

use crate::chassis::Chassis;
use crate::effect::{Coefficients, OperatingPoint};
use crate::scalar::{Scalar, real, smooth_sign};

/// A disc on the ground.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disc<T> {
    /// Centre, m.
    pub centre: [T; 2],
    /// Radius, m.
    pub radius: T,
}

/// Width over which a disc's edge is smooth, m, so that fits can move it.
const EDGE: f64 = 0.03;

/// Where and when an effect is present.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Presence<T> {
    /// From this time on, s.
    pub from: T,
    /// Until this time, s.
    pub until: T,
    /// Only under the wheels inside this disc.
    pub disc: Option<Disc<T>>,
    /// Only on this side (0 left, 1 right).
    pub side: Option<usize>,
}

impl<T: Scalar> Default for Presence<T> {
    /// Always, everywhere, both sides.
    fn default() -> Self {
        Self { from: real(-1e12), until: real(1e12), disc: None, side: None }
    }
}

impl<T: Scalar> Presence<T> {
    /// Always, everywhere, both sides: nothing needs to be blended.
    pub fn is_unlimited(&self) -> bool {
        *self == Self::default()
    }

    /// Share of the effect under each wheel, 0 to 1. Casters count as at the middle of the driven axle, and as of no side.
    #[inline(always)]
    pub fn at(&self, at: &OperatingPoint<T>) -> [T; 4] {
        let (zero, one) = (T::zero(), T::one());
        let now = at.time.if_less(self.from, zero, at.time.if_less(self.until, one, zero));
        let mut share = [now; 4];
        if let Some(disc) = self.disc {
            let ([c, s], [a, b]) = (at.heading, at.half_base);
            for (i, share) in share.iter_mut().enumerate() {
                let (mut x, mut y) = (if i < 2 { a } else { -a }, if i % 2 == 0 { b } else { -b });
                if at.chassis == Chassis::Differential {
                    (x, y) = (zero, if i < 2 { zero } else { y });
                }
                let dx = at.position[0] + c * x - s * y - disc.centre[0];
                let dy = at.position[1] + s * x + c * y - disc.centre[1];
                let inside = disc.radius - (dx * dx + dy * dy).sqrt();
                *share *= real::<T>(0.5) * (one + smooth_sign(inside * real(1.0 / EDGE)));
            }
        }
        if let Some(side) = self.side {
            let other = 1 - side.min(1);
            share[other] = zero;
            share[other + 2] = zero;
            if at.chassis == Chassis::Differential {
                share[side.min(1)] = zero;
            }
        }
        share
    }
}

impl<T: Scalar> Coefficients<T> {
    /// Takes `share` of what `other` changes, wheel by wheel; sides and the body take the mean of their driven wheels.
    #[inline(always)]
    pub(crate) fn blend(&mut self, other: &Self, share: [T; 4], chassis: Chassis) {
        let half = real::<T>(0.5);
        let side = match chassis {
            Chassis::SkidSteer | Chassis::FourMotors => [half * (share[0] + share[2]), half * (share[1] + share[3])],
            Chassis::Differential => [share[2], share[3]],
        };
        let body = half * (side[0] + side[1]);
        let mix = |own: &mut T, with: T, part: T| *own += part * (with - *own);
        for i in 0..4 {
            mix(&mut self.adhesion[i], other.adhesion[i], share[i]);
            mix(&mut self.slip_at_peak[i], other.slip_at_peak[i], share[i]);
            mix(&mut self.lateral[i], other.lateral[i], share[i]);
            mix(&mut self.rolling[i], other.rolling[i], share[i]);
            mix(&mut self.radius[i], other.radius[i], share[i]);
            mix(&mut self.traction[i], other.traction[i], share[i]);
        }
        for i in 0..2 {
            mix(&mut self.coulomb[i], other.coulomb[i], side[i]);
            mix(&mut self.viscous[i], other.viscous[i], side[i]);
            mix(&mut self.stribeck[i], other.stribeck[i], side[i]);
            mix(&mut self.torque[i], other.torque[i], side[i]);
            mix(&mut self.force[i], other.force[i], body);
            mix(&mut self.tilt[i], other.tilt[i], body);
            // A limit does not average: it holds whole or not at all.
            self.belt_limit[i] = half.if_less(side[i], other.belt_limit[i], self.belt_limit[i]);
        }
        mix(&mut self.moment, other.moment, body);
        mix(&mut self.twist, other.twist, body);
    }
}
