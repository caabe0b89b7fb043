//! A robot and the effects that its simulation lacks, as models of other simulators: MJCF (MuJoCo), URDF and SDF (Gazebo).
//!
//! What an engine has a law for becomes a value in the model. What it has no law for becomes a residual: a few lines that
//! say which force to add, or which reading to change, with the numbers in them and the reason. [`way`] says which is
//! which, for every effect of the catalogue and every engine.
//!
//! # Files
//!
//! * `model`: what goes in and what comes out; `export`: one model for one engine; `engine`: which
//!   there are.
//! * `translate`, `vehicle`, `at`: effects sorted into values of the model and lines to be added.
//! * `inertia`, `contact`: parts and ground contact in the numbers that engines take.
//! * `mjcf/*`, `urdf`, `sdf`, `gazebo`: the writers.
//! * `residual`, `added`: what an engine does not hold, as lines with their numbers.
//! * `origin`: where values come from, as comments; `xml`, `number`: text.

mod at;
mod contact;
mod engine;
mod gazebo;
mod inertia;
mod mjcf;
mod model;
mod number;
mod origin;
mod residual;
mod sdf;
mod table;
mod urdf;
mod vehicle;
mod xml;

pub use engine::{Engine, Way};
pub use model::{ExportError, Exported, Model};
pub use table::way;

#[cfg(test)]
mod tests;

/// The README's snippet, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
