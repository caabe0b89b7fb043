//! The parts of the command line that other programs use too: robot files, case folders, answers, tables of text.
//!
//! ```text
//! paths --inputs::load--> Loaded --CaseFolder--> torque_driven::Case --diagnosis::diagnose--> Diagnosis
//! ```

pub mod answers;
pub mod batch;
pub mod cards;
pub mod case_folder;
pub mod check;
pub mod diagnosis_text;
pub mod envelope;
mod flat_robot;
pub mod inputs;
pub mod long;
pub mod mcap_out;
pub mod predictions;
pub mod propose;
pub mod report_page;
mod robot_error;
pub mod robot_file;
mod robot_parameters;
mod robot_text;
mod robot_write;
pub mod sections;
pub mod simulated;
pub mod skeleton;
mod text_error;
pub mod text_table;
mod watched;
pub mod which_mapping;

pub use recordings::suggest;
pub use robot_error::RobotFileError;
pub use robot_file::{Causality, RobotSpec};
pub use text_error::TextError;
pub use watched::Watch;
