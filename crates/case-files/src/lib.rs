//! From files to a case, and from a verdict to files.
//!
//! ```text
//! paths --inputs::load--> Loaded --CaseFolder--> diagnosis::Case --diagnosis::diagnose--> Diagnosis --Envelope--> JSON
//! ```

pub mod answers;
mod bag_signals;
pub mod car;
pub mod case_folder;
pub mod check;
pub mod columns;
pub mod columns_case;
pub mod corrected;
mod drive_files;
mod edit;
pub mod envelope;
pub mod inputs;
pub mod kind;
pub mod long;
pub mod odometry;
pub mod own_effects;
pub mod parts;
pub mod predictions;
pub mod propose;
#[cfg(feature = "page")]
pub mod report_page;
mod sensor_faults;
pub mod simulated;
pub mod skeleton;
mod text_error;
mod twins;
pub mod visits;
mod watched;
pub mod wheeled;
pub mod which_mapping;

pub use text_error::TextError;
pub use watched::Watch;

/// The README's snippet, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
