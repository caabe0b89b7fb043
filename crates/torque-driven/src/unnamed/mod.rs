//! A law for what has no name in the catalogue.
//!
//! * `acting`: a law, or given inputs, as a disturbance of the plant in free run.
//! * `signals`: what the recordings say that a law may depend on.
//! * `operator`: the response to an input at any place and instant, and columns by superposition.
//! * `rank`: every candidate of the grammar by its evidence.
//! * `refit`: finalists in free run, moves, prices.
//! * `gate`: what must hold before a law is told.
//! * `arbitrary`: how places are told apart by an arbitrary input.
//! * `series`: what an arbitrary input would have been, window by window.
//! * `events`: instants at which something acts, where no law fits.
//! * `place`: where something acts, where neither a law nor events are told.
//! * `residual`: the same at one place as plain data, beside what a law may depend on: for laws of other hands.
//! * `shared`: what such events have in common.
//! * `told`: the law as plain data of the verdict.

mod acting;
mod arbitrary;
mod events;
mod gate;
mod operator;
mod place;
mod rank;
mod refit;
mod residual;
mod series;
mod shared;
mod signals;
#[cfg(test)]
mod tests;
mod told;

pub(crate) use acting::{Acting, InRecording};
pub use residual::ResidualWindow;
pub(crate) use signals::Signals;
pub(crate) use told::{Asked, tell};
