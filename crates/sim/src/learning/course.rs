//! A lap, and what is measured of it.

use controller::Loop;
use robot_model::paper::PaperRobot;

use crate::{Purpose, Recipe, SimError, Stream, Trajectory};

/// A lap that is driven once and followed often.
#[derive(Debug, Clone)]
pub struct Course {
    /// What it is called.
    pub name: &'static str,
    /// What happened.
    pub run: Trajectory,
    /// The robot before the disturbance.
    pub robot: PaperRobot<f64>,
    /// When the ground changes, s: what no model can foresee.
    pub changes_at: f64,
}

impl Course {
    /// Drives set B around a loop.
    ///
    /// # Errors
    /// [`SimError`] as for [`Trajectory::of`].
    pub fn new(name: &'static str, recipe: &Recipe, path: &Loop) -> Result<Self, SimError> {
        let parameters = &recipe.sets.b.robot;
        Ok(Self {
            name,
            run: Trajectory::of(recipe, parameters, path)?,
            robot: PaperRobot::with_variant(parameters, recipe.plant)?,
            changes_at: recipe.disturbance_at,
        })
    }

    /// Wheel speeds at the samples with white noise of standard deviation `noise`, rad/s; `lap` keys the noise.
    pub(super) fn measured(&self, noise: f64, seed: u64, lap: u64) -> Vec<[f64; 2]> {
        let mut stream = Stream::new(seed, Purpose::SensorNoise, lap);
        self.run.states.iter().map(|s| s.speed.map(|x| x + noise * stream.normal())).collect()
    }
}
