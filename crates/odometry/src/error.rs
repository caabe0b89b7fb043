//! Why wheel motion and pose cannot be compared.

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
    /// The robot as a whole cannot be.
    #[error("robot '{robot}': {what}")]
    Robot {
        /// Name of the robot.
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
