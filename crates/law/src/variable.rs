//! What a law may depend on.

use scalar::{Scalar, real};

use crate::error::LawError;
use crate::motion::{Input, Motion};
use crate::place::Place;
use crate::settings::SETTINGS;
use crate::unit::Unit;

/// Whose variables a place sees.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Of {
    /// Those of one side.
    Side(usize),
    /// The mean of both sides.
    Body,
    /// Half of right minus left: what turns the body.
    Difference,
    /// The body's, with the velocity along this axis as its velocity.
    Axis(usize),
}

/// What a law may depend on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Variable {
    /// Wheel speed, rad/s.
    WheelSpeed,
    /// Torque of the drive, N m.
    Torque,
    /// Power of the drive, N m rad/s.
    Power,
    /// Speed at which the rim slips forward over the ground, m/s.
    Slip,
    /// Velocity along the place's axis, forward unless it is a lateral one, m/s.
    Velocity,
    /// Lateral velocity, m/s.
    LateralVelocity,
    /// Yaw rate, rad/s.
    YawRate,
    /// Wheel angle, rad.
    WheelAngle,
    /// Heading, rad.
    Heading,
    /// Time since the start, s.
    Time,
}

impl Variable {
    /// All of them.
    pub const ALL: [Self; 10] = [
        Self::WheelSpeed,
        Self::Torque,
        Self::Power,
        Self::Slip,
        Self::Velocity,
        Self::LateralVelocity,
        Self::YawRate,
        Self::WheelAngle,
        Self::Heading,
        Self::Time,
    ];

    /// Its symbol in a formula.
    pub const fn symbol(self) -> &'static str {
        match self {
            Self::WheelSpeed => "omega",
            Self::Torque => "T",
            Self::Power => "P",
            Self::Slip => "slip",
            Self::Velocity => "v",
            Self::LateralVelocity => "v_lat",
            Self::YawRate => "yaw_rate",
            Self::WheelAngle => "phi",
            Self::Heading => "heading",
            Self::Time => "t",
        }
    }

    /// Its name for people.
    pub const fn name(self) -> &'static str {
        match self {
            Self::WheelSpeed => "wheel speed",
            Self::Torque => "torque of the drive",
            Self::Power => "power of the drive",
            Self::Slip => "slip speed of the wheel",
            Self::Velocity => "velocity",
            Self::LateralVelocity => "lateral velocity",
            Self::YawRate => "yaw rate",
            Self::WheelAngle => "wheel angle",
            Self::Heading => "heading",
            Self::Time => "time since the start",
        }
    }

    /// Its unit.
    pub fn unit(self) -> Unit {
        match self {
            Self::WheelSpeed | Self::YawRate => Unit::RATE,
            Self::Torque => Unit::TORQUE,
            Self::Power => Unit::POWER,
            Self::Slip | Self::Velocity | Self::LateralVelocity => Unit::SPEED,
            Self::WheelAngle | Self::Heading => Unit::RADIAN,
            Self::Time => Unit::SECOND,
        }
    }

    /// Whether it turns round: harmonics of it make sense, powers do not.
    pub const fn is_angle(self) -> bool {
        matches!(self, Self::WheelAngle | Self::Heading)
    }

    /// Whether it grows and falls about zero.
    pub const fn is_amount(self) -> bool {
        !self.is_angle() && !matches!(self, Self::Time)
    }

    /// The variable of a symbol whose range in a file is `range`.
    ///
    /// # Errors
    /// Symbols that are none, and ranges that are none.
    pub fn seen(symbol: &str, range: [f64; 2]) -> Result<Self, LawError> {
        let variable = crate::text::variable(symbol)?;
        if range.iter().any(|x| !x.is_finite()) {
            return Err(LawError::NotFinite(symbol.to_owned()));
        }
        let [low, high] = range;
        if low > high {
            let (low, high) = (low.to_string(), high.to_string());
            return Err(LawError::Range { variable: symbol.to_owned(), low, high });
        }
        Ok(variable)
    }

    /// Its value at an instant as an input of a place sees it, in [`Variable::unit`], a heading within ±π; `None` where the
    /// place does not act on that input.
    pub fn seen_by(self, place: Place, input: Input, m: &Motion<f64>) -> Option<f64> {
        let (_, of) = place.inputs().iter().find(|(own, _)| *own == input)?;
        Some(if self == Self::Heading { m.heading[1].atan2(m.heading[0]) } else { self.value(m, *of) })
    }

    /// Its value at an instant; of the heading, which is no number here, zero.
    #[inline(always)]
    pub(crate) fn value<T: Scalar>(self, m: &Motion<T>, of: Of) -> T {
        let pair = |both: [T; 2]| match of {
            Of::Side(j) => held(both[j.min(1)]),
            Of::Difference => (held(both[1]) - held(both[0])) * real(0.5),
            Of::Body | Of::Axis(_) => (held(both[0]) + held(both[1])) * real(0.5),
        };
        let power = |j: usize| held(m.torque[j]) * held(m.wheel_speed[j]);
        match self {
            Self::WheelSpeed => pair(m.wheel_speed),
            Self::Torque => pair(m.torque),
            Self::Power => pair([power(0), power(1)]),
            Self::Slip => pair(m.slip),
            Self::Velocity => held(m.velocity[usize::from(of == Of::Axis(1))]),
            Self::LateralVelocity => held(m.velocity[1]),
            Self::YawRate => held(m.yaw_rate),
            Self::WheelAngle => pair(m.wheel_angle),
            Self::Heading => T::zero(),
            Self::Time => held(m.time),
        }
    }
}

/// A number within the guard, so that whatever is made of it is finite.
#[inline(always)]
pub(crate) fn held<T: Scalar>(x: T) -> T {
    x.max(real(-SETTINGS.guard.most)).min(real(SETTINGS.guard.most))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_sees_the_variables_of_its_own_side_and_a_moment_half_their_difference() {
        let m = Motion { wheel_speed: [2.0, 5.0], heading: [0.0, -1.0], ..Motion::default() };
        let of = |place, input| Variable::WheelSpeed.seen_by(place, input, &m);
        assert_eq!(of(Place::TorqueBoth, Input::Torque(1)), Some(5.0));
        assert_eq!(of(Place::TorqueLeft, Input::Torque(1)), None);
        assert_eq!(of(Place::YawMoment, Input::Moment), Some(1.5));
        assert_eq!(of(Place::ForceForward, Input::Force(0)), Some(3.5));
        let heading = Variable::Heading.seen_by(Place::YawMoment, Input::Moment, &m);
        assert_eq!(heading, Some(-std::f64::consts::FRAC_PI_2));
    }
}
