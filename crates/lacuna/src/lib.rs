//! The parts of the command line that other programs use too: robot files and case folders.

pub mod answers;
pub mod case_folder;
mod flat_robot;
pub mod robot_file;

pub use robot_file::{Causality, RobotFileError, RobotSpec};
