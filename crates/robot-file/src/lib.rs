//! Robot files: the constants of a robot with unit, spread and source, the effects that its simulation is given, and how
//! it answers commands. TOML or JSON, read and written.
//!
//! `keys`: what a file may say, from the table of constants of `robot-model`. `full`, `flat`: its two forms. `read`,
//! `write`: between a file and a [`RobotSpec`]. `of_size`: a robot of which only size and mass are known.
//! `text`: where a key stands, for messages. [`catalogue_json`]: the effects that may
//! stand in a file.

pub mod catalogue_json;
mod error;
mod flat;
mod full;
mod keys;
mod of_size;
mod read;
mod spec;
mod text;
mod write;

use inference::DiagnosisError;
use verdict::EffectAt;
use verdict::ResponseModel;

pub use error::RobotFileError;
pub use of_size::{Size, Stands};
pub use read::BUILT_IN;
pub use spec::{Causality, RobotSpec};

/// The README's snippet, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
