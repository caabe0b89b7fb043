//! Says which physics a simulation left out.
//!
//! The way of a torque-driven case: cut recordings into windows and segments ([`run`], `windows`), find sensor faults
//! by `redundancy`, `calibrate` the model on the references, run every effect as a column of one linearised free run
//! (`screen`), refit the finalists and pairs in free run (`search`), and `decide`.
//! A speed-driven case compares [`steady`] loads instead; a command-driven case fits the [`response`] from command over
//! wheels to the body.
//!
//! Pure functions: no files, no clock, no output. Effects are known by their cards only.

mod answer;
mod calibrate;
pub mod case;
mod correction;
mod decide;
mod diagnose;
mod disc;
mod drives;
mod error;
mod fit;
mod forward;
mod gate;
mod hypothesis;
mod leave_out;
mod linalg;
mod local;
mod locate;
pub mod long;
mod motion;
pub mod next;
mod normal;
mod onset;
mod options;
pub mod output_error;
mod predict;
mod redundancy;
pub mod response;
pub mod run;
mod screen;
mod search;
mod simulate;
mod smooth;
pub mod steady;
#[cfg(test)]
mod testing;
mod trace;
mod verdict;
mod visits;
mod windows;
mod words;

pub use case::{Case, HeldOut, Restart};
pub use correction::{Correction, EffectAt, Side};
pub use diagnose::{Calibrated, diagnose};
pub use error::DiagnosisError;
pub use forward::{forecast, simulate, simulate_at_speed};
pub use locate::{Located, Regime, Remainder, ResidualModel, ResidualTorque, Span, TorqueCertificate};
pub use long::Coverage;
pub use next::Advice;
pub use options::Options;
pub use predict::Prediction;
pub use response::{ResponseCase, diagnose_response};
pub use run::Run;
pub use steady::{SteadyCase, diagnose_steady};
pub use trace::{Compared, Trace};
pub use verdict::{Cause, Cell, Diagnosis, Estimate, Finding, FreeRun, Trial, Verdict, Word};
