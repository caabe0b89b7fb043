//! What is compared.

use crate::drive::Drive;
use crate::wheel::WheeledRobot;

/// A robot with its drives.
#[derive(Debug, Clone)]
pub struct Case {
    /// The robot as its owner states it.
    pub robot: WheeledRobot,
    /// Drives in which the calibration was right; without any, the robot stands in their place, as sure as it states.
    pub references: Vec<Drive>,
    /// Drives in which it was not.
    pub recordings: Vec<Drive>,
}
