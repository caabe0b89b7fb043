//! What is compared.

use crate::car::Car;
use crate::drive::Drive;

/// A car with its drives.
#[derive(Debug, Clone)]
pub struct Case {
    /// The car as its owner states it.
    pub car: Car,
    /// Drives in which the simulation was right; without any, the car stands in their place, as sure as it states.
    pub references: Vec<Drive>,
    /// Drives in which it was not.
    pub recordings: Vec<Drive>,
}
