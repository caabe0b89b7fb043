#![doc = include_str!("../README.md")]
//!
//! # Files
//!
//! * `source`, `urdf`, `sdf`, `mjcf/*`: from text to links and joints.
//! * `model`, `solid`: links and joints of any format; masses and their sums.
//! * `wheels`, `layout`: which parts are wheels, and what robot they make.
//! * `torque`, `odometry`, `car`: robot files of the three sorts.
//! * `assumed`: every number that is not in a model.

mod assumed;
mod car;
mod error;
mod import;
mod layout;
mod mjcf;
mod model;
mod odometry;
mod sdf;
mod solid;
mod source;
mod torque;
mod urdf;
mod wheels;

pub use error::ImportError;
pub use import::{Asked, Imported, Kind, Number, Rollers, import};

#[cfg(test)]
mod tests;
