//! A robot file on the inputs of a recording.

use anyhow::Result;
use command_driven::simulate_response;
use inference::Options;
use recordings::Recording;

use crate::{Causality, RobotSpec};

/// What the robot's ideal sensors show on the inputs of a drive, its effects applied: of a torque-driven robot on commanded
/// torques, of a speed-driven robot on wheel speeds, of a command-driven robot on commanded wheel speeds.
///
/// # Errors
/// Inputs that are missing, and a simulation that does not stay finite.
pub fn simulated(robot: &RobotSpec, inputs: &Recording) -> Result<Recording> {
    let effects = robot.active(inputs.name())?;
    match robot.causality {
        Causality::TorqueDriven => Ok(torque_driven::simulate(&robot.robot, &effects, inputs, &Options::default())?),
        Causality::SpeedDriven => Ok(torque_driven::simulate_at_speed(&robot.robot, &effects, inputs)?),
        Causality::CommandDriven => {
            let response = robot.response.clone().unwrap_or_default();
            Ok(simulate_response(&robot.robot, &response, inputs)?)
        }
    }
}
