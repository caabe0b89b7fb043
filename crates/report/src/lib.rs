//! Pages and pictures of diagnoses and experiments.
//!
//! Markup is written by hand, in `pages` and three small places: no template engine, because a page is
//! put together by calls of [`pages::page::Page`] whose methods escape every text that they are given, so that templates would
//! hold little more than single elements. Tests give it markup, by hand and from files, and find none of it in the page.
//!
//! # Files
//!
//! * `diagnosis_page/*`: a diagnosis as a page, one file for each section; `diagnosis_text/*`: as text.
//! * `fleet/*`: recordings of many robots as a page; `trend` and `since` are its statistics.
//! * `picture`, `manoeuvre`, `slopes`, `reliability`: a verdict, the next drive, claims beside a
//!   witness, and how often answers are right, each as SVG; `drawing`: what pictures share.
//! * `rehearsal_text`, `rehearsal_page`: which effects would be found, as text and as a page.
//! * `law`: a law for what has no name, line by line.
//! * `words`: how numbers, causes, places and times are written, on the terminal too; `facts`, `sections`:
//!   lists and headings.

use pages::{chart, figure, page, thin};

pub mod diagnosis_page;
pub mod diagnosis_text;
mod drawing;
mod facts;
pub mod fleet;
mod law;
pub mod manoeuvre;
pub mod picture;
pub mod rehearsal_page;
pub mod rehearsal_text;
pub mod reliability;
pub mod sections;
pub mod slopes;
pub mod words;

/// The README's snippet, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
