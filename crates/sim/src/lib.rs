//! Forward simulation of a skid-steer robot, and the experiment of Hendzel & Trojnacki 2014.
//!
//! Simulation of any robot:
//! * [`rollout`]: the one loop over a plant, from a start state under held torques or wheel speeds;
//! * `rollout/grid`: rows divided into steps; `rollout/hold`: delayed commands held over rows; `rollout/input`: what moves
//!   the robot; `rollout/visitor`: who watches; `rollout/start`: known states and restarts; `rollout/lanes`: several
//!   robots side by side.
//!
//! The paper's experiment, where the feature `paper` asks for it (it does unless default features are switched off; who
//! simulates robots of recordings only need not build it):
//! * [`rk4`]: the integrator;
//! * [`Recipe`], `network_recipe`: everything that the experiment assumes, as data;
//! * [`Trajectory`]: the plant under its controller, simulated once;
//! * [`Experiment`]: identifiers with many random first layers over that trajectory (`layers`), since the motion does not depend
//!   on what an identifier makes of it; `identification`: one draw; `group`: eight draws side by side; `tally`: their
//!   indices;
//! * [`learning`]: which adaptive laws keep what they learn;
//! * [`table1`], [`statistics`]: the paper's indices and what counts as reproduced.
//!
//! For both: [`Stream`], random numbers keyed by seed, purpose and draw, so that results do not depend on threads;
//! [`SimError`].
//!
//! Everything is deterministic: the same recipe and seed give the same bits on any machine with any thread count.
//! A simulation stops at the first value that is not finite and names it with its time.
//!
//! ```
//! use sim::{Experiment, Recipe, RobotSet};
//!
//! let recipe = Recipe { samples: 500, ..Recipe::default() };
//! let experiment = Experiment::new(&recipe, RobotSet::B)?;
//! let draw = experiment.identify(7, 0)?;
//! assert!(draw.output[0].max > draw.output[0].rmse);
//! # Ok::<(), sim::SimError>(())
//! ```

mod error;
#[cfg(feature = "paper")]
mod experiment;
#[cfg(feature = "paper")]
mod group;
#[cfg(feature = "paper")]
mod identification;
#[cfg(feature = "paper")]
mod layers;
#[cfg(feature = "paper")]
pub mod learning;
mod network_recipe;
mod random;
mod recipe;
mod rk4;
pub mod rollout;
pub mod statistics;
#[cfg(feature = "paper")]
pub mod table1;
#[cfg(feature = "paper")]
mod tally;
#[cfg(feature = "paper")]
mod trajectory;

pub use error::SimError;
#[cfg(feature = "paper")]
pub use experiment::{Draw, Experiment, Trace};
pub use network_recipe::{Input, NetworkRecipe, SIGNALS, Scaling, Signals};
pub use random::{Purpose, Stream, comparison};
pub use recipe::{
    ControllerRecipe, IdentifierRecipe, Integrator, PathRecipe, Recipe, RobotSet, Scenario, Scenarios, Scheme,
    SpeedProfile, UNITS,
};
pub use rk4::rk4;
#[cfg(feature = "paper")]
pub use tally::OutputIndices;
#[cfg(feature = "paper")]
pub use trajectory::{EVENTS, Trajectory, Windows};

/// The README's snippets, run as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
