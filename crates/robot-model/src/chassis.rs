//! What a robot stands on and what turns its wheels: four wheels that turn by side, or two driven wheels and casters.

use core::fmt;

use crate::robot::Robot;
use crate::scalar::{Scalar, real};

/// What a robot stands on.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
pub enum Chassis {
    /// Four wheels, those of a side coupled by a belt: turning makes them slide.
    #[default]
    SkidSteer,
    /// Four wheels, each turned by a motor of its own: those of a side get half of its torque each and may turn unlike.
    FourMotors,
    /// Two driven wheels on one axle, and one or two casters.
    Differential,
}

impl Chassis {
    /// Those on four wheels.
    pub const ON_FOUR_WHEELS: &'static [Self] = &[Self::SkidSteer, Self::FourMotors];

    /// Whether it stands on four wheels that turn it by side.
    pub const fn is_on_four_wheels(self) -> bool {
        matches!(self, Self::SkidSteer | Self::FourMotors)
    }

    /// As in a robot file.
    pub const fn name(self) -> &'static str {
        match self {
            Self::SkidSteer => "skid-steer",
            Self::FourMotors => "four-motors",
            Self::Differential => "differential",
        }
    }
}

/// Lever on which a wheel's speed turns a body over half the track, where wheels skid: they turn it less than rolling ones
/// (guess: between those of short and of long robots on hard ground).
const WIDENING: f64 = 1.5;

impl<T: Scalar> Robot<T> {
    /// Lever b on which the wheels' speeds turn the body about as `ω = r (w_right − w_left) / (2 b)`, m.
    pub fn turning_lever(&self) -> T {
        match self.chassis {
            Chassis::SkidSteer | Chassis::FourMotors => self.half_track * real(WIDENING),
            Chassis::Differential => self.half_track,
        }
    }
}

impl fmt::Display for Chassis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Square of a speed below which a caster does not swing, m²/s².
const STANDING: f64 = 1e-20;
/// Steps towards the direction in which a caster is dragged, each of which leaves a sixth of the cube of what is left.
const TURNS: usize = 6;

/// Rate at which a caster's wheel at angle `angle` would have to swing to follow its pivot, times its trail: the part of the
/// pivot's velocity across the wheel, m/s.
#[inline(always)]
fn across<T: Scalar>(angle: T, pivot: [T; 2]) -> T {
    let (sin, cos) = angle.sin_cos();
    pivot[1] * cos - pivot[0] * sin
}

/// Angle of a caster's wheel in the body after a step of `step` seconds.
///
/// The wheel trails its pivot by `d` and rolls without sliding sideways, so that with the pivot's velocity `v` and the yaw
/// rate `ω`, both of the body, `δ' = |v|/d sin(∠v − δ) − ω`; implicit in δ to first order, for trails are short.
///
/// Source: Campion, Bastin & D'Andréa-Novel 1996, IEEE Trans. Robot. Autom. 12(1), the off-centred orientable wheel.
#[inline(always)]
pub(crate) fn swung<T: Scalar>(angle: T, pivot: [T; 2], yaw_rate: T, trail: T, step: T) -> T {
    let [x, y] = pivot;
    let speed = (x * x + y * y + real(STANDING)).sqrt();
    angle + step * (across(angle, pivot) - yaw_rate * trail) / (trail + step * speed)
}

/// Angle of a caster's wheel that a pivot at this velocity has long dragged along; ahead where it stands.
#[inline(always)]
pub(crate) fn dragged<T: Scalar>(pivot: [T; 2]) -> T {
    let [x, y] = pivot;
    let per_speed = T::one() / (x * x + y * y + real(STANDING)).sqrt();
    // From the right half of the circle: on the other one the steps below would be small.
    let mut angle = x.if_less(T::zero(), real(core::f64::consts::PI), T::zero());
    for _ in 0..TURNS {
        angle += across(angle, pivot) * per_speed;
    }
    angle
}
