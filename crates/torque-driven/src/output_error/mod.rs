//! Output-error fit: constants of a torque-driven robot from recordings in free run.
//!
//! From a known start the plant runs free under the recorded torques; the constants make the squared distance between its
//! outputs and the recorded ones least, `Σ ((y − ŷ(δ))/σ)²`, by Gauss–Newton steps with Levenberg–Marquardt damping. A
//! Jacobian is one run: the robot as it is and every shifted one go side by side, of several recordings at once.
//!
//! The cost of a long free run has many minima. Start within 10 % or so, or with short recordings first.
//!
//! ```
//! use torque_driven::output_error::{Constant, OutputError, Recorded};
//! use robot_model::{Robot, State, paper};
//!
//! let robot = Robot::<f64>::from(&paper::Parameters::SET_B);
//! # let mut observed = Vec::new();
//! let torque: Vec<[f64; 2]> = (0..400).map(|k| [3.0, 3.0 + (0.02 * f64::from(k)).sin()]).collect();
//! # let plant = robot_model::Plant::new(&robot, &[], 1e-3);
//! # let mut s = State::default();
//! # for torque in &torque {
//! #     for _ in 0..10 {
//! #         plant.step(&mut s, *torque);
//! #     }
//! #     let yaw = s.heading[1].atan2(s.heading[0]);
//! #     observed.push([s.position[0], s.position[1], yaw, s.yaw_rate, s.wheel_speed[0], s.wheel_speed[1]]);
//! # }
//! let drive = Recorded { name: "run_1".into(), start: State::default(), period: 0.01, torque, observed };
//! // m, m, rad, rad/s, rad/s, rad/s
//! let sigma = [0.005, 0.005, 0.005, 0.01, 0.05, 0.05];
//! let constants = vec![Constant::tunable("mass")?, Constant::tunable("adhesion")?];
//! let problem = OutputError::new(&robot, constants, std::slice::from_ref(&drive), sigma, 1e-3)?;
//! let fitted = problem.fit(&[0.05, -0.05])?;
//! assert!(fitted.delta.iter().all(|d| d.abs() < 1e-4));
//! # Ok::<(), torque_driven::output_error::OutputErrorError>(())
//! ```

mod constant;
mod equations;
mod error;
mod free;
mod iterate;
#[cfg(test)]
mod tests;

use robot_model::{Robot, State};

pub use constant::Constant;
pub use error::OutputErrorError;
pub use iterate::Fitted;

/// Outputs that are compared: position x and y (m), yaw (rad, any number of turns), yaw rate (rad/s), speed of the left and of
/// the right wheels (rad/s).
pub const CHANNELS: usize = 6;

/// A recording that is run freely.
#[derive(Debug, Clone)]
pub struct Recorded {
    /// Its name, for messages.
    pub name: String,
    /// How the robot moves at the beginning, its drives included.
    pub start: State<f64>,
    /// Time from row to row, s.
    pub period: f64,
    /// Commanded torque of each side, N m, held over the period of its row.
    pub torque: Vec<[f64; 2]>,
    /// Outputs at the end of the period of each row, one row for each of `torque`; NaN where nothing was recorded.
    pub observed: Vec<[f64; CHANNELS]>,
}

/// The problem: a robot, the constants that are free, recordings.
#[derive(Debug, Clone)]
pub struct OutputError<'a> {
    robot: Robot<f64>,
    constants: Vec<Constant>,
    recordings: &'a [Recorded],
    sigma: [f64; CHANNELS],
    step: f64,
}

impl<'a> OutputError<'a> {
    /// A problem. `sigma` is one standard deviation of the noise of each output, in its unit; `step` the integration step, s,
    /// which is shortened so that a period has a whole number of steps.
    ///
    /// # Errors
    /// A robot that cannot be, no constants, no recordings, recordings without rows or with other rows of torque than of
    /// outputs, and numbers that must be positive or finite but are not.
    pub fn new(
        robot: &Robot<f64>,
        constants: Vec<Constant>,
        recordings: &'a [Recorded],
        sigma: [f64; CHANNELS],
        step: f64,
    ) -> Result<Self, OutputErrorError> {
        let robot = robot.checked()?;
        for (what, empty) in [("constant", constants.is_empty()), ("recording", recordings.is_empty())] {
            if empty {
                return Err(OutputErrorError::Empty { what });
            }
        }
        let positive = |what: String, value: f64| {
            let good = value.is_finite() && value > 0.0;
            if good { Ok(()) } else { Err(OutputErrorError::NotPositive { what, value }) }
        };
        positive("the step".into(), step)?;
        for (channel, sigma) in sigma.into_iter().enumerate() {
            positive(format!("the standard deviation of output {channel}"), sigma)?;
        }
        for r in recordings {
            positive(format!("the period of recording '{}'", r.name), r.period)?;
            if r.torque.is_empty() || r.torque.len() != r.observed.len() {
                let (torques, outputs) = (r.torque.len(), r.observed.len());
                return Err(OutputErrorError::Rows { recording: r.name.clone(), torques, outputs });
            }
            if let Some(row) = r.torque.iter().position(|t| !t.iter().all(|t| t.is_finite())) {
                return Err(OutputErrorError::Torque { recording: r.name.clone(), row });
            }
        }
        Ok(Self { robot, constants, recordings, sigma, step })
    }

    /// The robot with its constants changed by `delta`; `None` if no robot can be so.
    fn changed(&self, delta: &[f64]) -> Option<Robot<f64>> {
        let mut robot = self.robot;
        for (constant, delta) in self.constants.iter().zip(delta) {
            constant.apply(&mut robot, *delta);
        }
        robot.checked().ok()
    }

    fn check(&self, delta: &[f64]) -> Result<(), OutputErrorError> {
        let (given, constants) = (delta.len(), self.constants.len());
        if given == constants && delta.iter().all(|d| d.is_finite()) {
            Ok(())
        } else {
            Err(OutputErrorError::Start { given, constants })
        }
    }
}
