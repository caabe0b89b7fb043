//! Wheeled robots with wheel slip: four wheels on two sides, two driven wheels and casters, or any wheels.
//!
//! Three plants share the contact patch of [`contact`]:
//! * [`paper`]: the robot of Hendzel & Trojnacki 2014, Eq. 8 taken literally, closed by planar body dynamics;
//! * [`plant`]: the robot of a user's simulation, torque-driven or speed-driven, which any [`Effect`] may change;
//! * [`wheels`]: a robot of any wheels, fixed, steered, with rollers or dragged along, driven by torques.
//!
//! Axes: x forward, y left, z up. Wheels: 0 front left, 1 front right, 2 rear left, 3 rear right
//! (the paper's 1, 2, 3, 4); where casters hold a robot up, 0 and 1 are these. Sides: 0 left, 1 right. All quantities in SI units and radians.
//!
//! The crate needs neither the standard library nor an allocator, and is generic over the scalar:
//! `f32`, `f64`, dual numbers for derivatives, or [`Lanes`] for several robots at once.
//!
//! # Files
//!
//! * `constants`: the table of constants; bounds, tuning and the keys of robot files follow from
//!   its rows.
//! * `given`: robots from constants by their names;
//!   `robot`: the constants of a user's robot, checked; `tunable`: those that a fit may change.
//! * `plant`: the step, torque-driven and speed-driven; `on_casters`: the same with casters;
//!   `contact`: slip, tyre law, wheel loads.
//! * `chassis`: what a robot stands on, and how a caster swings.
//! * `state`: what moves; `settle`: steady motion of a speed-driven robot.
//! * `effect/*`: what an effect is: the trait, its specification, how engines get it.
//! * `effects/*`: the catalogue, one file for each effect; the build script finds them.
//! * `disturbance`: what acts beside the catalogue's effects.
//! * `active`: an effect at values; `presence`: from an instant, in a disc, on one side.
//! * `paper/*`: the robot of the paper, two variants, and its equation as a regressor.
//! * `wheels/*`: a robot of any wheels: its constants, its state, its step.
//! * `scalar`: functions of a number that only plants need; `error`: what can be wrong with a
//!   model.
#![cfg_attr(not(feature = "std"), no_std)]

mod active;
pub mod chassis;
pub mod constants;
pub mod contact;
mod disturbance;
pub mod effect;
mod error;
mod given;
mod on_casters;
pub mod paper;
pub mod plant;
pub mod presence;
pub mod robot;
mod scalar;
mod settle;
mod state;
pub mod tunable;
pub mod wheels;

/// The effects a simulation may lack, one file each; found by the build script in file-name order.
pub mod effects {
    include!(concat!(env!("OUT_DIR"), "/effects.rs"));
}

pub use ::scalar::Lanes;
pub use active::Active;
pub use chassis::Chassis;
pub use constants::Constant;
pub use disturbance::Disturbance;
pub use effect::{Coefficients, Effect, EffectSpec, Kind, OperatingPoint, Parameter, Readings, Role};
pub use error::{ModelError, Must};
pub use plant::Plant;
pub use presence::{Disc, Presence};
pub use robot::Robot;
pub use scalar::{Scalar, real};
pub use state::State;

/// The README's snippet, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;

/// The worked example of a new effect, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../../../docs/writing-an-effect.md")]
pub struct WritingAnEffect;
