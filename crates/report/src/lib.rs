//! Pages and pictures of diagnoses and experiments.
//!
//! Markup is written by hand, in `pages` and three small places: no template engine, because a page is
//! put together by calls of [`pages::page::Page`] whose methods escape every text that they are given, so that templates would
//! hold little more than single elements. Tests give it markup, by hand and from files, and find none of it in the page.

use pages::{chart, figure, page, thin};

pub mod diagnosis_page;
pub mod diagnosis_text;
mod drawing;
mod facts;
pub mod fleet;
pub mod manoeuvre;
pub mod picture;
pub mod reliability;
pub mod sections;
pub mod slopes;
pub mod words;
