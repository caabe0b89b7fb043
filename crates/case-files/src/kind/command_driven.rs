//! Robots of which only commands and motion are known.

use anyhow::{Result, ensure};
use command_driven::{ResponseRun, response_errors, simulate_response};
use diagnosis::long::BUDGET;
use recordings::Recording;
use robot_file::RobotSpec;
use robot_model::Active;

use super::{Forecast, Kind};
use crate::sensor_faults;

/// Commanded wheel speeds in, wheel speeds and the motion of the body out, without forces.
pub(super) struct CommandDriven;

/// How much more recorded time than of a torque-driven robot: a response is simulated without forces.
const LONGER: f64 = 6.0;

impl Kind for CommandDriven {
    fn budget(&self) -> f64 {
        LONGER * BUDGET
    }

    fn simulate(&self, robot: &RobotSpec, _: &[Active<f64>], inputs: &Recording) -> Result<Recording> {
        let with_force = robot.effects.iter().find(|effect| !sensor_faults::is_one(effect));
        ensure!(
            with_force.is_none(),
            "robot '{}' is command-driven and simulated by its [response], without forces: the effect `{}` cannot be \
             applied; take it out of the robot file",
            robot.name,
            with_force.map_or("", |effect| &effect.effect)
        );
        Ok(simulate_response(&robot.robot, &robot.response.clone().unwrap_or_default(), inputs)?)
    }

    fn forecast(&self, robot: &RobotSpec, drive: &Recording, _: f64) -> Result<Forecast> {
        let run = ResponseRun::new(drive)?;
        let errors = response_errors(&robot.robot, &robot.response.clone().unwrap_or_default(), &run)?;
        Ok(Forecast { errors: errors.into_iter().map(|(q, e)| (q, Some(e))).collect(), prediction: None })
    }

    fn no_prediction(&self) -> Option<&'static str> {
        Some("command-driven robots have no predictions; errors on held-out drives are in the text and the JSON")
    }

    fn no_forces(&self) -> Option<&'static str> {
        Some("nothing is known of its masses and forces that a model could hold")
    }
}
