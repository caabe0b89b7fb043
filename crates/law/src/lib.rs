//! A law for what has no name: a place, a formula whose units close, and where it was seen.
//!
//! `u = C f₁ f₂ f₃` at a place of the robot; a law has one such term or two. Types and evaluation,
//! no engine: whoever simulates adds [`Law::act`] to its plant, or takes a law with a name as an
//! effect of it, [`OwnEffect`].
//!
//! # Files
//!
//! * `unit`: exponents of m, kg, s and rad; the unit that closes a term.
//! * `place`, `variable`, `factor`: where a term acts, what it depends on, and how.
//! * `motion`: the values of an instant, and what a law does to the robot there.
//! * `term`, `text`: terms and laws, as formulas that read back.
//! * `memory`: hidden states, row by row.
//! * `grammar`: every candidate that symmetry allows.
//! * `plant`: what a law sees of an instant of the plant, and what it changes there.
//! * `effect`: a law under a name as an effect; `python`: its lines beside an exported model.
//! * `settings`: starting shapes; `error`: what can be wrong with a law.

mod effect;
mod error;
mod factor;
mod grammar;
mod memory;
mod motion;
mod place;
mod plant;
mod python;
mod settings;
mod term;
mod text;
mod unit;
mod variable;

pub use effect::OwnEffect;
pub use error::{LawError, OwnEffectError};
pub use factor::{Factor, Shape};
pub use grammar::{Scales, candidates, dry_sign};
pub use memory::Memory;
pub use motion::{Action, Input, Motion};
pub use place::Place;
pub use term::{Law, MOST_FACTORS, MOST_TERMS, Term};
pub use unit::Unit;
pub use variable::Variable;

/// Every tuned number of this crate, for the page of settings.
pub fn settings() -> impl Iterator<Item = &'static ::settings::Setting> {
    crate::settings::Settings::ALL.iter()
}

/// The README's snippet, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
