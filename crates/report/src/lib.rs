//! Pages and pictures of diagnoses and experiments.
//!
//! Markup is written by hand, in `page`, `table` and `shell` and three small places: no template engine, because a page is
//! put together by calls of [`page::Page`] whose methods escape every text that they are given, so that templates would
//! hold little more than single elements. Tests give it markup, by hand and from files, and find none of it in the page.

pub mod chart;
pub mod diagnosis_page;
pub mod diagnosis_text;
mod drawing;
mod escape;
mod facts;
pub mod figure;
pub mod fleet;
pub mod manoeuvre;
pub mod page;
pub mod picture;
pub mod reliability;
pub mod reproduction;
mod role;
pub mod sections;
mod shell;
pub mod slopes;
mod table;
pub mod text_table;
mod thin;
pub mod words;
