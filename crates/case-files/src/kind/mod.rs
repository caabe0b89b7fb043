//! What can be asked of each kind of robot: one file for each.

use anyhow::Result;
use recordings::Recording;
use robot_file::{Causality, RobotSpec};
use robot_model::Active;
use verdict::Prediction;

mod command_driven;
mod speed_driven;
mod torque_driven;

/// A kind of robot, by what drives it.
pub trait Kind: Sync {
    /// Recorded time that a diagnosis rests on at most when nobody says otherwise, s.
    fn budget(&self) -> f64;

    /// What ideal sensors would show on the inputs of a drive.
    ///
    /// # Errors
    /// Inputs that are missing, a simulation that does not stay finite, and an effect that cannot be simulated.
    fn simulate(&self, robot: &RobotSpec, effects: &[Active<f64>], inputs: &Recording) -> Result<Recording>;

    /// A drive forecast freely, from a known state at most every `restart` seconds, and its errors.
    ///
    /// # Errors
    /// Inputs or states that are missing, and a simulation that does not stay finite.
    fn forecast(&self, robot: &RobotSpec, drive: &Recording, restart: f64) -> Result<Forecast>;

    /// Why drives cannot be forecast freely; `None` where they can.
    fn no_forecast(&self) -> Option<&'static str> {
        None
    }

    /// Why no row-by-row prediction of a held-out drive can be written; `None` where it can.
    fn no_prediction(&self) -> Option<&'static str> {
        None
    }

    /// Why the robot cannot be exported as a model with masses and forces; `None` where it can.
    fn no_forces(&self) -> Option<&'static str> {
        None
    }
}

/// A drive forecast by a robot file.
#[derive(Debug, Clone)]
pub struct Forecast {
    /// Root mean squared errors by quantity with its unit; `None` where the drive does not hold what is predicted.
    pub errors: Vec<(String, Option<f64>)>,
    /// What was forecast, row by row, of kinds that predict rows.
    pub prediction: Option<Prediction>,
}

/// The kind of a robot.
pub fn of(causality: Causality) -> &'static dyn Kind {
    match causality {
        Causality::TorqueDriven => &torque_driven::TorqueDriven,
        Causality::SpeedDriven => &speed_driven::SpeedDriven,
        Causality::CommandDriven => &command_driven::CommandDriven,
    }
}
