#![doc = include_str!("../README.md")]
//!
//! # Files
//!
//! * `plan`: what is to be rehearsed; `error`: why nothing could be.
//! * `rehearse`: the whole way, from a case to shares of replicas.
//! * `of_fit`: the same by the equations of a fit to whole drives, without simulating.
//! * `of_loads`: of robots whose wheel speeds are given, by loads drawn about those of their steady driving.
//! * `of_response`: of responses to commands, by driving the same commands again.
//! * `assemble`: hides each cause at each size in replicas and counts the diagnoses that find it.
//! * `hidden`: an effect of a given size, in the form in which a replica has it.
//! * `replica`: a robot drawn about the robot file, its references, the drives of its recordings.
//! * `sensors`: noise, rates and gaps of the recordings, and what such sensors show of a simulated drive.
//! * `score`: how an answer is counted; shares, and from where on an effect is found.
//! * `words`: limits in sentences; `random`: streams fixed by paths; `settings`: every tuned number.

mod assemble;
mod error;
mod hidden;
mod of_fit;
mod of_loads;
mod of_response;
mod plan;
mod random;
mod rehearse;
mod replica;
mod score;
mod sensors;
mod settings;
#[cfg(test)]
mod tests;
mod words;

pub use error::RehearsalError;
pub use of_fit::rehearse_fit;
pub use of_loads::RehearsingLoads;
pub use of_response::RehearsingResponse;
pub use plan::Plan;
pub use rehearse::{Rehearsing, rehearse};

/// Every tuned number of this crate, for the page of settings.
pub fn settings() -> impl Iterator<Item = &'static ::settings::Setting> {
    settings::Settings::ALL.iter()
}
