//! Robots whose drives are given speeds.

use anyhow::{Result, bail};
use diagnosis::long::BUDGET;
use recordings::Recording;
use robot_file::RobotSpec;
use robot_model::Active;

use super::{Forecast, Kind};

/// Wheel speeds in, the torque that they take out.
pub(super) struct SpeedDriven;

/// How much more recorded time than of a torque-driven robot: loads are measured once, nothing is simulated again and
/// again.
const LONGER: f64 = 6.0;

impl Kind for SpeedDriven {
    fn budget(&self) -> f64 {
        LONGER * BUDGET
    }

    fn simulate(&self, robot: &RobotSpec, effects: &[Active<f64>], inputs: &Recording) -> Result<Recording> {
        Ok(torque_driven::simulate_at_speed(&robot.robot, effects, inputs)?)
    }

    fn forecast(&self, robot: &RobotSpec, _: &Recording, _: f64) -> Result<Forecast> {
        bail!("robot '{}' is speed-driven; {}", robot.name, self.no_forecast().unwrap_or_default())
    }

    fn no_forecast(&self) -> Option<&'static str> {
        Some("its drives are not forecast freely, but `lacuna simulate` computes the torque that their speeds take")
    }

    fn no_prediction(&self) -> Option<&'static str> {
        Some("held-out drives of a speed-driven robot are not predicted; the last thirds of its recordings are")
    }
}
