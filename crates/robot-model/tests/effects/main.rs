//! One battery over all effects of the catalogue, and the law of each.

mod battery;
mod cards;
#[path = "../common/mod.rs"]
mod common;
mod derivatives;
mod energy;
mod finite;
mod laws;
mod mirror;
mod neutral;
mod new_laws;
mod proportion;
