//! Why wheel motion and pose cannot be compared.

use hierarchical_fit::CaseError;

/// Why wheel motion and pose cannot be compared.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OdometryError {
    /// The wheels leave a motion open.
    #[error(
        "robot '{robot}': its wheels do not determine {motion}; add a wheel with counts, a wheel without counts that \
         cannot slide sideways, or correct places and directions"
    )]
    Undetermined {
        /// Name of the robot.
        robot: String,
        /// The motion that is left open.
        motion: String,
    },
    /// A number of a wheel cannot be.
    #[error("robot '{robot}', wheel '{wheel}': {what}")]
    Wheel {
        /// Name of the robot.
        robot: String,
        /// Name of the wheel.
        wheel: String,
        /// What is wrong, and what to do.
        what: String,
    },
    /// As of any robot.
    #[error(transparent)]
    Case(#[from] CaseError),
}
