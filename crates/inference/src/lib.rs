//! One inference behind all kinds of robots.

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
