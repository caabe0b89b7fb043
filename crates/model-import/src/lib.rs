#![doc = include_str!("../README.md")]
//!
//! # Files
//!
//! * `source`, `urdf`, `sdf`, `mjcf/*`: from text to links and joints.
//! * `model`, `solid`: links and joints of any format; masses and their sums.
//! * `wheels`, `layout`: which parts are wheels, and what robot they make.
//! * `torque`, `odometry`, `car`, `any_wheels`: robot files of the four sorts.
//! * `rounded`: numbers as a file writes them.
//! * `settings`: every tuned number.

mod any_wheels;
mod car;
mod error;
mod import;
mod layout;
mod mjcf;
mod model;
mod odometry;
mod rounded;
mod sdf;
mod settings;
mod solid;
mod source;
mod torque;
mod urdf;
mod wheels;

pub use error::ImportError;
pub use import::{Asked, Imported, Kind, Number, Rollers, import};

/// Every tuned number of this crate, for the page of settings.
pub fn settings() -> impl Iterator<Item = &'static ::settings::Setting> {
    settings::Settings::ALL.iter()
}

#[cfg(test)]
mod tests;
