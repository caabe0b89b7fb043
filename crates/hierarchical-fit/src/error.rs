//! Why a robot cannot be compared with its drives.

/// Why a robot cannot be compared with its drives.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CaseError {
    /// The robot file cannot be.
    #[error("robot '{robot}': {what}")]
    Robot {
        /// Name of the robot or its file.
        robot: String,
        /// What is wrong, and what to do.
        what: String,
    },
    /// A drive cannot be compared.
    #[error("recording '{drive}': {what}")]
    Drive {
        /// Name of the drive.
        drive: String,
        /// What is wrong, and what to do.
        what: String,
    },
    /// There is nothing to diagnose.
    #[error("the case has no recording; at least one is needed")]
    Empty,
    /// The drives do not determine a fit.
    #[error(
        "the drives hold {windows} windows of {length} s with motion, but at least {needed} are needed; record longer"
    )]
    Short {
        /// Windows there are.
        windows: usize,
        /// Their length, s.
        length: f64,
        /// Windows needed.
        needed: usize,
    },
}
