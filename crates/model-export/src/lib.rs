//! A robot and the effects that its simulation lacks, as models of other simulators: MJCF (MuJoCo), URDF and SDF (Gazebo).
//!
//! What an engine has a law for becomes a value in the model. What it has no law for becomes a residual: a few lines that
//! say which force to add, or which reading to change, with the numbers in them and the reason. [`way`] says which is
//! which, for every effect of the catalogue and every engine.

mod at;
mod contact;
mod engine;
mod gazebo;
mod inertia;
mod mjcf;
mod model;
mod number;
mod origin;
mod residual;
mod sdf;
mod table;
mod urdf;
mod vehicle;
mod xml;

pub use engine::{Engine, Way};
pub use model::{ExportError, Exported, Model};
pub use table::way;

#[cfg(test)]
mod tests;
