//! Pages and pictures of diagnoses and experiments.

pub mod chart;
pub mod diagnosis_page;
pub mod diagnosis_text;
mod drawing;
pub mod figure;
pub mod fleet;
pub mod manoeuvre;
pub mod page;
pub mod picture;
pub mod reliability;
pub mod reproduction;
pub mod sections;
mod shell;
pub mod slopes;
mod table;
pub mod text_table;
mod thin;
pub mod words;
