//! A robot of any wheels under torque as a model of a simulator.
//!
//! From the bottom up: `ackermann` (angles of steered wheels), `vehicle` (parts, loads and friction: what writers read),
//! `mjcf`, `urdf`, `sdf` (writers).

mod ackermann;
mod mjcf;
mod sdf;
#[cfg(test)]
mod tests;
mod urdf;
mod vehicle;

use robot_model::effect::export::Engine;
use robot_model::wheels::Robot;

use crate::model::{ExportError, Exported};
use vehicle::Vehicle;

/// What drives or steers wheels, with what its command is recorded as.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Input<'a> {
    /// Its name.
    pub name: &'a str,
    /// N m of a motor, rad of a steering joint, per unit of the command.
    pub per_unit: f64,
}

impl<'a> Input<'a> {
    /// Inputs of these names whose commands are in N m or rad.
    pub fn in_si(names: &'a [String]) -> Vec<Self> {
        names.iter().map(|name| Self { name, per_unit: 1.0 }).collect()
    }
}

/// A robot of any wheels that is exported.
#[derive(Debug, Clone, Copy)]
pub struct AnyWheelsModel<'a> {
    /// Name.
    pub name: &'a str,
    /// Its constants, corrected if they are to be.
    pub robot: &'a Robot<f64>,
    /// Names of its wheels, in the order of the robot.
    pub wheels: &'a [String],
    /// Its motors.
    pub motors: &'a [Input<'a>],
    /// Its steering joints.
    pub joints: &'a [Input<'a>],
    /// The point whose pose is measured: x, y, m, and direction of its axes, rad.
    pub point: [f64; 3],
    /// What a reader of the model is to know: where its numbers come from.
    pub told: &'a [String],
}

impl AnyWheelsModel<'_> {
    /// The model for an engine.
    ///
    /// # Errors
    /// A robot that cannot be, parts without names, and rollers that the engine does not have.
    pub fn export(&self, engine: Engine) -> Result<Exported, ExportError> {
        let vehicle = Vehicle::new(self, engine)?;
        let heading = self.heading(engine);
        let text = match engine {
            Engine::Mjcf => mjcf::document(&vehicle, heading)?,
            Engine::Urdf => urdf::document(&vehicle, heading)?,
            Engine::Sdf => sdf::document(&vehicle, heading)?,
        };
        Ok(Exported { text, residual: None, notes: vehicle.notes })
    }

    fn heading(&self, engine: Engine) -> Vec<String> {
        let takes = match engine {
            Engine::Mjcf => {
                "Actuators have the names of motors, and of steering joints behind steer_, and take what is recorded of them"
            }
            Engine::Urdf | Engine::Sdf => "Joints of wheels take torques, joints named steer_ take angles",
        };
        let first = format!(
            "{}: written by lacuna export. Units SI; x forward, y left, z up; the chassis has its origin on the ground below the \
             origin of the robot file. {takes}.",
            self.name
        );
        std::iter::once(first).chain(self.told.iter().cloned()).collect()
    }
}
