#![doc = include_str!("../README.md")]
//!
//! # Files
//!
//! * `least_squares/*`: the one solver: bounds, priors, robust losses, eliminated blocks.
//! * `evidence`: from scores to probabilities, classes and credible sets.
//! * `interpolate`: signals between their instants.
//! * `robust`: medians, quantiles, intervals; `rate`: shares with Wilson's interval; `algebra`: the little dense algebra, over faer.
//! * `expected_information`, `advice`: which drive to record next, in bits.
//! * `experiment`: what a kind of robot says so that data left out of its fit are forecast like all others'.
//! * `hypothesis`: what may be missing: every scope that an effect of the catalogue may have.
//! * `gyro_beside_pose`: what share of a robot's turning its gyro shows, where a pose shows all of it.
//! * `known`: the effects that may be named: the catalogue's, and those of one's own.
//! * `corrected`: a correction as a robot and effects that a plant takes.
//! * `options`: settings of a diagnosis; `error`: why a diagnosis could not be made.
//! * `settings`: every tuned number, with unit and source.
//! * `words`: names and numbers for people.

#[cfg(feature = "solver")]
pub mod advice;
#[cfg(feature = "solver")]
pub mod algebra;
mod corrected;
mod error;
pub mod evidence;
#[cfg(feature = "solver")]
pub mod expected_information;
#[cfg(feature = "solver")]
pub mod experiment;
#[cfg(feature = "solver")]
pub mod gyro_beside_pose;
pub mod hypothesis;
mod interpolate;
mod known;
#[cfg(feature = "solver")]
pub mod least_squares;
mod options;
pub mod rate;
pub mod robust;
mod settings;
pub mod words;

pub use corrected::Corrected;
pub use error::DiagnosisError;
pub use interpolate::interpolate;
pub use known::{GivenEffects, KnownEffects};
pub use options::{Options, SearchForLaw};

/// Every tuned number of this crate, for the page of settings; without those of the solver.
pub fn settings() -> impl Iterator<Item = &'static ::settings::Setting> {
    settings::Settings::ALL.iter()
}
