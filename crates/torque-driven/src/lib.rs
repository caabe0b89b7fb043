//! Diagnosis of robots whose drives are given torques.

mod answer;
mod calibrate;
mod candidate;
mod case;
mod decide;
mod diagnose;
mod disc;
mod drives;
mod fit;
mod forward;
mod gate;
mod judged;
mod leave_out;
mod local;
mod locate;
mod motion;
mod next;
mod normal;
mod onset;
pub mod output_error;
mod predict;
mod redundancy;
mod rms;
mod run;
mod screen;
mod search;
mod simulate;
mod smooth;
#[cfg(test)]
mod testing;
mod trial;
mod visits;
mod windows;
mod words;

pub use case::{Case, HeldOut, Restart};
pub use diagnose::{Calibrated, diagnose};
pub use forward::{forecast, simulate, simulate_at_speed};
pub use run::Run;
