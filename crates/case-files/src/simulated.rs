//! A robot file on the inputs of a recording.

use anyhow::Result;
use recordings::Recording;
use robot_file::RobotSpec;

use crate::{kind, sensor_faults};

/// What the robot's sensors show on the inputs of a drive, its effects applied: of a torque-driven robot on commanded
/// torques, of a speed-driven robot on wheel speeds, of a command-driven robot on commanded wheel speeds.
///
/// # Errors
/// Inputs that are missing, a simulation that does not stay finite, and an effect that cannot be simulated.
pub fn simulated(robot: &RobotSpec, inputs: &Recording) -> Result<Recording> {
    let effects = robot.active(inputs.name())?;
    let ideal = kind::of(robot.causality).simulate(robot, &effects, inputs)?;
    Ok(sensor_faults::shown(&robot.effects, ideal)?)
}
