//! Why a robot file cannot be used.

use recordings::Spot;
use robot_model::Must;

/// Why a robot file cannot be used. `place` is the file, with line and column where they are known.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RobotFileError {
    /// No such built-in robot, and no such file.
    #[error("'{name}' is neither a robot file nor a built-in robot; {hint}")]
    Unknown {
        /// What was asked for.
        name: String,
        /// What to write instead.
        hint: String,
    },
    /// Nothing in it.
    #[error("{place}: the file is empty; a robot file holds at least name, causality and parameters")]
    Empty {
        /// Where.
        place: Spot,
    },
    /// The text is not what a robot file looks like.
    #[error("{place}: {message}")]
    Syntax {
        /// Where.
        place: Spot,
        /// What is wrong.
        message: String,
    },
    /// A parameter is in a unit that does not fit.
    #[error("{place}: parameter `{key}` has unit `{unit}`; give it in {expected}")]
    Unit {
        /// Where.
        place: Spot,
        /// Parameter.
        key: String,
        /// Unit given.
        unit: String,
        /// Unit expected.
        expected: String,
    },
    /// A parameter is missing.
    #[error(
        "{place}: parameter `{key}` is missing; \
         add `{key} = {{ value = ..., unit = \"{expected}\", source = \"...\" }}` to the parameters"
    )]
    Missing {
        /// Where.
        place: Spot,
        /// Parameter.
        key: String,
        /// Unit expected.
        expected: String,
    },
    /// A parameter has a value that no robot can have.
    #[error("{place}: parameter `{key}` is {value}, but it must {must}; correct it")]
    Model {
        /// Where.
        place: Spot,
        /// Key in the file.
        key: String,
        /// The number given.
        value: f64,
        /// What it must do.
        must: Must,
    },
    /// An effect that the simulation is to be given is not as the catalogue has it.
    #[error("{place}: {message}")]
    Effect {
        /// Where.
        place: Spot,
        /// What is wrong.
        message: String,
    },
    /// A number is not what it must be.
    #[error("{place}: {what} of `{key}` is {value}, but it must be {must}; correct it")]
    Value {
        /// Where.
        place: Spot,
        /// Key in the file.
        key: String,
        /// Which of its numbers.
        what: &'static str,
        /// The number given.
        value: f64,
        /// What it must be.
        must: &'static str,
    },
    /// A robot that has no form as text.
    #[error("this robot cannot be written as {form}: {reason}")]
    Unwritable {
        /// TOML or JSON.
        form: &'static str,
        /// Why.
        reason: String,
    },
}

impl RobotFileError {
    /// The place in the robot file, where it is about one.
    pub fn spot(&self) -> Option<&Spot> {
        match self {
            Self::Unknown { .. } | Self::Unwritable { .. } => None,
            Self::Empty { place }
            | Self::Syntax { place, .. }
            | Self::Unit { place, .. }
            | Self::Missing { place, .. }
            | Self::Effect { place, .. }
            | Self::Model { place, .. }
            | Self::Value { place, .. } => Some(place),
        }
    }
}
