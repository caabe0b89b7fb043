//! One inference behind all kinds of robots.
//!
//! # Files
//!
//! * `hypothesis`: what may be missing: every scope that an effect of the catalogue may have.
//! * `corrected`: a correction as a robot and effects that a plant takes.
//! * `advice`, `entropy`: advice on the next drive, and expected information in bits.
//! * `options`: settings of a diagnosis; `error`: why a diagnosis could not be made.
//! * `linalg`: the little dense algebra, over faer; `words`: names and numbers for people.

pub mod advice;
mod corrected;
pub mod entropy;
mod error;
pub mod hypothesis;
pub mod linalg;
mod options;
pub mod words;

pub use corrected::{Corrected, active, in_catalogue};
pub use error::DiagnosisError;
pub use options::Options;

/// Half the width of a 90 % interval in sigmas.
pub const NINETY: f64 = 1.645;
