//! The door: says which physics a simulation left out, whatever the kind of robot.
//!
//! A robot is torque-driven, speed-driven or command-driven; each kind has an engine of its own that compares recordings
//! with the simulation, and one inference stands behind all. Recordings that are too long to be compared whole are
//! screened by [`long`].
//!
//! Pure functions: no files, no clock, no output.
//!
//! # Files
//!
//! * `case`: a case of any kind of robot, the engine that diagnoses it, and references made ready once.
//! * `long/*`: long recordings: screened once by weak form (`law`, `rows`, `thin`), of which the
//!   minutes that differ most from the references are kept (`pool`) for a diagnosis.
//! * `possible`: values that no robot of the file can show, and the unit that would explain them.
//! * `columns`: columns that are exchanged, of the other sign or in another unit, by what the other channels say that they
//!   must show (`columns/motion`), and both sides against that (`columns/sides`).
//! * `grid`: samples of a channel on rows of equal distance.
//! * `visits`: which drives are of one day, place and load, by when they were started.
//! * `settings`: every tuned number, with unit and source.

mod case;
mod columns;
mod grid;
pub mod long;
mod possible;
mod settings;
pub mod visits;

pub use case::{Case, Prepared, diagnose};
pub use inference::{DiagnosisError, Options};
pub use possible::possible;

/// Every tuned number of this crate, for the page of settings.
pub fn settings() -> impl Iterator<Item = &'static ::settings::Setting> {
    settings::Settings::ALL.iter()
}

/// The README's snippet, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
