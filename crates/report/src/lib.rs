//! Pages and pictures of diagnoses and experiments.

pub mod chart;
pub mod diagnosis_page;
mod drawing;
pub mod figure;
pub mod fleet;
pub mod manoeuvre;
pub mod page;
pub mod picture;
pub mod reliability;
pub mod reproduction;
mod shell;
pub mod slopes;
mod table;
mod thin;
pub mod words;
