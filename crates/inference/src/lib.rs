#![doc = include_str!("../README.md")]

#[cfg(feature = "solver")]
pub mod algebra;
pub mod evidence;
#[cfg(feature = "solver")]
pub mod expected_information;
#[cfg(feature = "solver")]
pub mod least_squares;
pub mod robust;
