//! Diagnosis of robots whose drives are given torques.
//!
//! # Files
//!
//! * `diagnose`: the way of a case as one list of stages; `case`, `run`: what goes in; `noise_free`: a simulator's log.
//! * `motion`, `smooth`, `windows`, `channel`: what sensors say before any force law, and the segments of
//!   free runs.
//! * `redundancy/*`: sensor faults that two sensors show without any force law.
//! * `simulate`, `drives`, `hold`: free runs, eight segments side by side.
//! * `visit`, `between_visits`, `moved_constants`: drives of one day, place and load, and how far constants move from one to
//!   the next.
//! * `calibrate`, `regimes`, `null_scores`: constants and noise from the references, and the null score of each
//!   reference.
//! * `screen`, `candidate`, `local`: which effects could explain the mismatch, by linearised free
//!   runs.
//! * `hypothesis`: effects that are missing together.
//! * `in_some_drives`: what is there in some recordings only. `headings`: where recordings without a pose head, by the slope that each shows.
//! * `search`, `several`, `other_side`, `later_side`, `refits`, `fit`, `run_numbers`, `normal`, `trial`: refits of the finalists in free run, alone, in
//!   pairs and threes; `nothing`: re-tuned constants alone; `disc`, `onset`: place and time; `handed_over`: effects that hide
//!   in a constant.
//! * `decide`, `prices`, `decision`, `judged`, `visits`, `stand_in`, `structure`, `level`: from fits to probabilities; `confirmed`, `which_side`,
//!   `contradicted`: what left-out recordings say of them.
//! * `retuned`: constants that moved farther than they are known; `simulator`: those that a simulator's logs show;
//!   `fitted_robot`: a robot from such logs alone.
//! * `four_motors`: whether the wheels of a side have a motor each, where the robot file does not say it.
//! * `answer`, `present`, `limits`, `words`: causes with sizes and intervals, and when they are there; what limits them; sentences.
//! * `locate/*`: where and when the calibrated model fails, and what is left after the verdict.
//! * `leave_out`, `rms`: free runs on recordings left out, with re-tuned and placebo models.
//! * `forward`, `predict`: any drive simulated, and held-out drives forecast.
//! * `next/*`: which drive would tell the rivals apart.
//! * `output_error/*`: constants of a robot from recordings in free run.
//! * `unnamed/*`: a law for what has no name in the catalogue.
//! * `own_effects`: effects of one's own: those that no free run can hold, drives beyond their range.
//! * `settings/*`: every tuned number, stage by stage.

mod answer;
mod between_visits;
mod calibrate;
mod candidate;
mod case;
mod channel;
mod confirmed;
mod contradicted;
mod decide;
mod decision;
mod diagnose;
mod disc;
mod drives;
mod few_constants;
mod fit;
mod fitted_robot;
mod forward;
mod four_motors;
mod handed_over;
mod headings;
mod hypothesis;
mod in_some_drives;
mod judged;
mod later_side;
mod leave_out;
mod level;
mod limits;
mod local;
mod locate;
mod motion;
mod moved_constants;
mod next;
mod noise_free;
mod normal;
mod nothing;
mod null_scores;
mod onset;
mod other_side;
pub mod output_error;
mod own_effects;
mod predict;
mod present;
mod prices;
mod redundancy;
mod refits;
mod regimes;
mod retuned;
mod rms;
mod run;
mod run_numbers;
mod screen;
mod search;
mod settings;
mod several;
mod simulate;
mod simulator;
mod smooth;
mod stand_in;
mod structure;
#[cfg(test)]
mod testing;
mod trial;
mod unnamed;
mod visit;
mod visits;
mod which_side;
mod windows;
mod words;

pub use case::{Case, HeldOut, Restart};
pub use diagnose::{Calibrated, diagnose};
pub use fitted_robot::{FittedConstant, FittedRobot, fit_logs};
pub use forward::{forecast, simulate, simulate_at_speed};
pub use run::Run;
pub use unnamed::ResidualWindow;
pub use visit::{KnownBy, Visit};

/// Every tuned number of this crate, for the page of settings.
pub fn settings() -> impl Iterator<Item = &'static ::settings::Setting> {
    crate::settings::all()
}

/// The README's snippet, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
