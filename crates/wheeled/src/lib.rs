#![doc = include_str!("../README.md")]
//!
//! # Files
//!
//! * `robot`, `constants`: a robot as its owner states it, and the constants on which its motion and its reports depend.
//! * `drive`: torques, steering, wheels, gyro and pose of a drive on one grid.
//! * `units`: columns in another unit than the robot file says.
//! * `noise`: how noisy a pose is, and by how much wheels and gyro count at the start of a window.
//! * `casters`: where casters point at the start of a window.
//! * `model`: the plant at values of the constants, and runs of it.
//! * `rows`: windows of the motion against the model, several values of the constants side by side.
//! * `diagnose`, `left_out`, `answer`: a case in, findings out, forecasts of what is left out, and findings as a verdict in
//!   sentences.
//! * `next_drive`: drives of the menu as the robot would drive them, and what they would say.
//! * `simulate`: a robot as stated on the inputs of a drive.
//! * `file/*`: robot files of this kind, and drives from tables and from the messages of bags.
//! * `settings`: every tuned number.

mod answer;
mod casters;
mod constants;
mod diagnose;
mod drive;
pub mod file;
mod left_out;
mod model;
mod next_drive;
mod noise;
mod robot;
mod rows;
mod settings;
mod simulate;
mod units;

pub use answer::diagnosis;
pub use constants::{Constant, Quantity, constants};
pub use diagnose::{Case, Findings, diagnose, examine, rehearsable};
pub use drive::{Drive, Measured};
pub use hierarchical_fit::CaseError as WheeledError;
pub use hierarchical_fit::{Answer, Estimate, NamedCause};
pub use left_out::{LENGTHS, Medians, Table};
pub use robot::{AnyWheels, Sigmas};
pub use simulate::simulate;

/// Every tuned number of this crate, for the page of settings.
pub fn settings() -> impl Iterator<Item = &'static ::settings::Setting> {
    settings::Settings::ALL.iter()
}
