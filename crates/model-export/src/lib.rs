//! A robot and the effects that its simulation lacks, as models of other simulators: MJCF (MuJoCo), URDF and SDF (Gazebo).
//!
//! What an engine has a law for becomes a value in the model. What it has no law for becomes a residual: a few lines that
//! say which force to add, or which reading to change, with the numbers in them and the reason. Every effect says in its
//! own file which is which (`robot_model::effect::Export`); this crate only reads it.
//!
//! From the bottom up: `number` and `xml`; `model` (what is exported); `at` (an effect at values), `origin` (where values
//! come from), `vehicle`, `contact`, `inertia` and `residual` (what writers read); `translate` (effects into a vehicle);
//! `added`, `gazebo`, `mjcf`, `urdf`, `sdf` (writers); `export` (one model for one engine). Beside them `any_wheels/*`:
//! robots of any wheels, and `ros2/*`: parameters of ROS 2 controllers from wheels and their lengths.

mod added;
mod any_wheels;
mod at;
mod contact;
mod export;
mod gazebo;
mod inertia;
mod mjcf;
mod model;
mod number;
mod origin;
mod residual;
pub mod ros2;
mod sdf;
mod translate;
mod urdf;
mod vehicle;
mod xml;

pub use any_wheels::{AnyWheelsModel, Input};
pub use model::{ExportError, Exported, Model};
pub use robot_model::effect::export::{Engine, Way};
pub use translate::way;

#[cfg(test)]
mod tests;

/// The README's snippet, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
