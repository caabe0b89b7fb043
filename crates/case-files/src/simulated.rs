//! A robot file on the inputs of a recording.

use anyhow::{Result, bail};
use command_driven::simulate_response;
use inference::Options;
use recordings::Recording;
use robot_file::{Causality, RobotSpec};

use crate::sensor_faults;

/// What the robot's sensors show on the inputs of a drive, its effects applied: of a torque-driven robot on commanded
/// torques, of a speed-driven robot on wheel speeds, of a command-driven robot on commanded wheel speeds.
///
/// # Errors
/// Inputs that are missing, a simulation that does not stay finite, and an effect that cannot be simulated.
pub fn simulated(robot: &RobotSpec, inputs: &Recording) -> Result<Recording> {
    let effects = robot.active(inputs.name())?;
    let ideal = match robot.causality {
        Causality::TorqueDriven => torque_driven::simulate(&robot.robot, &effects, inputs, &Options::default())?,
        Causality::SpeedDriven => torque_driven::simulate_at_speed(&robot.robot, &effects, inputs)?,
        Causality::CommandDriven => {
            if let Some(effect) = robot.effects.iter().find(|effect| !sensor_faults::is_one(effect)) {
                bail!(
                    "robot '{}' is command-driven and simulated by its [response], without forces: the effect `{}` \
                     cannot be applied; take it out of the robot file",
                    robot.name,
                    effect.effect
                );
            }
            let response = robot.response.clone().unwrap_or_default();
            simulate_response(&robot.robot, &response, inputs)?
        }
    };
    Ok(sensor_faults::shown(&robot.effects, ideal)?)
}
