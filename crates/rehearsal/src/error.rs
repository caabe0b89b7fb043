//! Why nothing could be rehearsed.

use inference::DiagnosisError;
use thiserror::Error;

/// Why nothing could be rehearsed.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum RehearsalError {
    /// An effect that the catalogue does not have.
    #[error("no effect is called `{name}`; {hint}")]
    UnknownEffect {
        /// As it was given.
        name: String,
        /// Names that are near.
        hint: String,
    },
    /// A size that is no multiple.
    #[error("{size} is no size to rehearse; give multiples of the size of interest that are larger than zero")]
    Size {
        /// As it was given.
        size: f64,
    },
    /// No size at all.
    #[error("no size was given; give at least one multiple of the size of interest")]
    NoSize,
    /// No replica at all.
    #[error("no replica was asked for; give 1 or more")]
    NoReplica,
    /// More replicas than anybody can wait for.
    #[error("{replicas} replicas would take days; give {most} or fewer")]
    TooMany {
        /// As many as were asked for.
        replicas: usize,
        /// As many as there may be.
        most: usize,
    },
    /// A length that leaves nothing.
    #[error("{seconds} s of each recording is no length to rehearse; give more than zero")]
    Length {
        /// As it was given.
        seconds: f64,
    },
    /// The inputs cannot be driven, or the robot cannot exist.
    #[error(transparent)]
    Diagnosis(#[from] DiagnosisError),
}

impl RehearsalError {
    /// Whether the plan is wrong rather than the case.
    pub fn is_of_plan(&self) -> bool {
        !matches!(self, Self::Diagnosis(_))
    }
}
