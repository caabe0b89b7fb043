//! Pages and pictures of diagnoses and experiments.
//!
//! # Files
//!
//! * `diagnosis_page/*`: a diagnosis as a page, one file for each section.
//! * `fleet/*`: recordings of many robots as a page; `trend` and `since` are its statistics.
//! * `picture`, `manoeuvre`, `slopes`, `reliability`: a verdict, the next drive, claims beside a
//!   witness, and how often answers are right, each as SVG; `drawing`: what pictures share.
//! * `words`: how numbers, causes, places and times are written, on the terminal too.
//! * `page`, `shell`, `web/*`: a page in the making, what surrounds it, its style and scripts.
//! * `figure`, `chart`, `table`, `thin`: what charts and tables say; fewer points with every peak
//!   kept.
//! * `reproduction`: the figures of the paper.

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

/// The README's snippet, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
