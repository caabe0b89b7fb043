//! Why constants could not be fitted.

/// Why constants could not be fitted.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OutputErrorError {
    /// There is nothing to fit, or nothing to fit to.
    #[error("an output-error fit needs at least one {what}")]
    Empty {
        /// "constant" or "recording".
        what: &'static str,
    },
    /// No robot has such a constant.
    #[error("no constant '{id}' can be re-tuned; there are {known}")]
    NoSuchConstant {
        /// What was named.
        id: String,
        /// All of them.
        known: String,
    },
    /// A number must be positive.
    #[error("{what} is {value}, but must be a finite number above 0")]
    NotPositive {
        /// Which number.
        what: String,
        /// Its value.
        value: f64,
    },
    /// Rows are missing.
    #[error(
        "recording '{recording}' has {torques} rows of torque and {outputs} of outputs; it needs as many, at least one"
    )]
    Rows {
        /// Name of the recording.
        recording: String,
        /// Rows of torque.
        torques: usize,
        /// Rows of outputs.
        outputs: usize,
    },
    /// A torque is no number.
    #[error("recording '{recording}' has a torque in row {row} that is not finite; cut the recording there")]
    Torque {
        /// Name of the recording.
        recording: String,
        /// Row, counted from 0.
        row: usize,
    },
    /// The start is none.
    #[error("the start has {given} values for {constants} constants; it needs one finite value for each")]
    Start {
        /// Values there are.
        given: usize,
        /// Constants there are.
        constants: usize,
    },
    /// The run from the start leaves the numbers, or the start is no robot.
    #[error(
        "recording '{recording}' cannot be run freely from the start: its outputs are not finite, or the constants are those of \
         no robot; check its start state and the start values"
    )]
    NotFinite {
        /// Name of the recording.
        recording: String,
    },
    /// The data do not determine constants.
    #[error(
        "the recordings do not determine {constants}; fix some of these, or record drives in which each has a trace of its own"
    )]
    NotDetermined {
        /// Which constants, or which of them together.
        constants: String,
    },
    /// The robot cannot be.
    #[error(transparent)]
    Model(#[from] robot_model::ModelError),
}
