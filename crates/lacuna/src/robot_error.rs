//! Why a robot file cannot be used.

use robot_model::ModelError;

/// Why a robot file cannot be used. `place` is the file, with the line where that is known.
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
        /// File.
        place: String,
    },
    /// The text is not what a robot file looks like.
    #[error("{place}: {message}")]
    Syntax {
        /// File, line and column.
        place: String,
        /// What is wrong.
        message: String,
    },
    /// A parameter is in a unit that does not fit.
    #[error("{place}: parameter `{key}` has unit `{unit}`; give it in {expected}")]
    Unit {
        /// File and line.
        place: String,
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
        /// File.
        place: String,
        /// Parameter.
        key: String,
        /// Unit expected.
        expected: String,
    },
    /// A parameter has a value that no robot can have.
    #[error("{place}: parameter `{key}`: {source}; correct it")]
    Model {
        /// File and line.
        place: String,
        /// Key in the file.
        key: String,
        /// What is wrong.
        source: ModelError,
    },
    /// An effect that the simulation is to be given is not as the catalogue has it.
    #[error("{place}: {message}")]
    Effect {
        /// File and line.
        place: String,
        /// What is wrong.
        message: String,
    },
    /// A number is not what it must be.
    #[error("{place}: {what} of `{key}` is {value}, but it must be {must}; correct it")]
    Value {
        /// File and line.
        place: String,
        /// Key in the file.
        key: String,
        /// Which of its numbers.
        what: &'static str,
        /// The number given.
        value: f64,
        /// What it must be.
        must: &'static str,
    },
}
