//! Pages and text for diagnoses and experiments.

pub mod chart;
mod drawing;
pub mod manoeuvre;
pub mod page;
pub mod picture;
pub mod reliability;
pub mod reproduction;
pub mod slopes;
