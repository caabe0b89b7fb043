//! What can be wrong with a model's parameters.

use core::fmt;

use crate::chassis::Chassis;

/// A parameter that no robot can have.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ModelError {
    /// A number that a quantity cannot be.
    #[error("{name} is {value}, but it must {must}")]
    Value {
        /// Name of the quantity.
        name: &'static str,
        /// The value given.
        value: f64,
        /// What it must do.
        must: Must,
    },
    /// A constant that must be said was not.
    #[error("{name} is missing; give it in {unit}")]
    Missing {
        /// Name of the constant.
        name: &'static str,
        /// Its unit.
        unit: &'static str,
    },
    /// A constant of robots on another chassis.
    #[error("a {chassis} robot has no `{name}`; {}", why_foreign(*chassis))]
    Foreign {
        /// The name given.
        name: &'static str,
        /// The chassis of the robot.
        chassis: Chassis,
    },
    /// Casters that hold nothing up.
    #[error(
        "{name} is {value}: a caster so near to the driven axle does not hold the robot up; give its place ahead of \
        the axle, or behind it with a minus"
    )]
    Caster {
        /// Name of the constant.
        name: &'static str,
        /// The value given, m.
        value: f64,
    },
    /// A part of a robot that is referred to and is not there.
    #[error("the {what} is not there; add it, or take the reference to it out")]
    NotThere {
        /// What it is.
        what: &'static str,
    },
    /// Wheels and casters that do not hold a robot up.
    #[error(
        "all wheels and casters stand on one line, on which no robot stands; add the casters, or correct the places"
    )]
    OnALine,
    /// No constant has this name.
    #[error("a robot has no constant `{name}`; `Robot::CONSTANTS` lists them")]
    Unknown {
        /// The name given.
        name: &'static str,
    },
}

/// What to do about a constant of another chassis.
const fn why_foreign(chassis: Chassis) -> &'static str {
    match chassis {
        Chassis::SkidSteer | Chassis::FourMotors => {
            "leave it out, or write chassis = \"differential\" if it stands on two wheels and casters"
        }
        Chassis::Differential => "leave it out: the places of its casters say where it stands",
    }
}

/// What a quantity must do, to be that of a robot.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Must {
    /// Be larger than zero.
    BePositive,
    /// Be zero or larger.
    NotBeNegative,
    /// Be neither NaN nor infinite.
    BeFinite,
    /// Lie in the interval in which the model holds, its ends included.
    LieBetween(f64, f64),
}

impl fmt::Display for Must {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::BePositive => f.write_str("be larger than zero"),
            Self::NotBeNegative => f.write_str("not be negative"),
            Self::BeFinite => f.write_str("be a finite number"),
            Self::LieBetween(low, high) => write!(f, "lie between {low} and {high}"),
        }
    }
}

fn must(name: &'static str, value: f64, must: Must, holds: bool) -> Result<(), ModelError> {
    if holds { Ok(()) } else { Err(ModelError::Value { name, value, must }) }
}

/// Refuses what is not finite and larger than zero.
pub(crate) fn positive(name: &'static str, value: f64) -> Result<(), ModelError> {
    finite(name, value)?;
    must(name, value, Must::BePositive, value > 0.0)
}

/// Refuses what is not finite or below zero.
pub(crate) fn not_negative(name: &'static str, value: f64) -> Result<(), ModelError> {
    finite(name, value)?;
    must(name, value, Must::NotBeNegative, value >= 0.0)
}

/// Refuses NaN and the infinities.
pub(crate) fn finite(name: &'static str, value: f64) -> Result<(), ModelError> {
    must(name, value, Must::BeFinite, value.is_finite())
}

/// Refuses what lies outside `low..=high`.
pub(crate) fn within(name: &'static str, value: f64, low: f64, high: f64) -> Result<(), ModelError> {
    finite(name, value)?;
    must(name, value, Must::LieBetween(low, high), value >= low && value <= high)
}
