//! The parts of the command line that other programs use too: robot files, case folders, answers, tables of text.
//!
//! ```text
//! paths --inputs::load--> Loaded --CaseFolder--> diagnosis::Case --diagnosis::diagnose--> Diagnosis
//! ```

pub mod answers;
pub mod case_folder;
pub mod envelope;
mod flat_robot;
pub mod inputs;
pub mod predictions;
pub mod propose;
mod robot_error;
pub mod robot_file;
mod robot_parameters;
mod robot_text;
mod robot_write;
pub mod skeleton;
pub mod suggest;
pub mod text_table;
pub mod which_mapping;

pub use robot_error::RobotFileError;
pub use robot_file::{Causality, RobotSpec};
