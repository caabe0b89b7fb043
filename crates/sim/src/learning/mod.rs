//! Which laws keep what they learn.
//!
//! Table 1 of the paper cannot tell learning from integral action. This study can: every [`Contender`] drives the paper's
//! loop five times, with noise on the measured speeds, and is then tried on laps of other shapes: with its weights frozen,
//! following online, and predicting ahead from the torques alone. Scores are against the true speeds.
//!
//! ```no_run
//! use sim::learning::{Contender, Study, StudyRecipe};
//!
//! let study = Study::new(&StudyRecipe::default())?;
//! let score = study.run(Contender::Memory, 7, 0)?;
//! println!("lap 5 over lap 1: {:.2}", score.lap[4] / score.lap[0]);
//! # Ok::<(), sim::SimError>(())
//! ```

mod contender;
mod course;
mod follower;
mod free_run;
mod regressor;
mod score;
mod structured;
mod study;

pub use contender::{Contender, Tried};
pub use course::Course;
pub use free_run::HORIZONS;
pub use score::Score;
pub use study::{Study, StudyRecipe};
