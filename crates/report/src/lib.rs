//! Pages and text for diagnoses and experiments.

pub mod chart;
pub mod page;
pub mod picture;
pub mod reproduction;
