#![doc = include_str!("../README.md")]

#[cfg(feature = "solver")]
pub mod advice;
#[cfg(feature = "solver")]
pub mod algebra;
mod corrected;
mod error;
pub mod evidence;
#[cfg(feature = "solver")]
pub mod expected_information;
pub mod hypothesis;
#[cfg(feature = "solver")]
pub mod least_squares;
mod options;
pub mod robust;
pub mod words;

pub use corrected::{Corrected, active, in_catalogue};
pub use error::DiagnosisError;
pub use options::Options;
