//! Path reference, kinematic loop and neural tracking controller of a skid-steer robot.
//!
//! Three parts, from the path to the torques:
//! * [`LoopPath`] and [`PathReference`]: a speed [`Profile`] along a straight, one full circle, and a straight;
//! * [`Kinematic`]: Kanayama's loop, which turns the error of the pose into a speed and a yaw rate;
//! * [`Tracking`]: a sliding variable per side with a network that learns the wheel's load online.
//!
//! The reproduced paper (Hendzel & Trojnacki 2014) takes its controller from its reference 4 without giving gains;
//! this one is in that style. No standard library, no allocation; steps never panic.
//!
//! ```
//! use controller::{Gains, Loop, LoopPath, PathReference, Tracking, WheelState};
//! use nn_basis::Constant;
//! use robot_model::paper::Parameters;
//!
//! let path = LoopPath::new(&Loop::default())?;
//! let basis = Constant::new([0.5; 8]).expect("finite");
//! let gains = Gains::for_robot(&Parameters::SET_B, 100.0);
//! let mut controller = Tracking::<f64, _, 8>::new(&gains, basis, PathReference::new(path))?;
//! let at_rest = WheelState { x: 0.0, y: 0.0, yaw: 0.0, angle: [0.0; 2], speed: [0.0; 2] };
//! let first = controller.step(&at_rest, 1e-3);
//! assert_eq!(first.torque, [0.0; 2]); // at t = 0 the reference still stands
//! assert!(controller.step(&at_rest, 1e-3).torque[0] > 0.0);
//! # Ok::<(), controller::ControllerError>(())
//! ```
//!
//! # Files
//!
//! * `path`: the desired motion: straight, one full circle, straight.
//! * `kinematic`: the outer loop, from the error of the pose to a speed and a yaw rate.
//! * `tracking`: the inner loop, a sliding variable per side and a network that learns the load.
//! * `error`: what can be wrong with a path or with gains.
#![no_std]

mod error;
mod kinematic;
mod path;
#[cfg(test)]
mod tests;
mod tracking;

pub use error::ControllerError;
pub use kinematic::{Command, Kinematic, Pose};
pub use path::{Events, Loop, LoopPath, PathReference, Profile, Reference, Turn};
pub use tracking::{Action, Gains, Tracking, WheelState};

/// The README's snippet, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
