#![doc = include_str!("../README.md")]
//!
//! # Files
//!
//! * `car`, `constants`, `constant_table`, `laws`: a car as its owner states it, and the constants on which its motion depends.
//! * `clock`: clocks of car and pose that start or run apart.
//! * `drive`: commands, pose and reports of a drive on one grid; held channels, clocks, gaps.
//! * `model`: steering, drive, tyres and motion of the single-track car.
//! * `rows`: windows of the pose and reports of the car against the model; `sensors`: whether gyro and encoder show one share of it.
//! * `cause`, `solve`: the causes that drives may ask for, and drives as the shared fit takes them.
//! * `forecast`, `left_out`, `rivals`: motion from throttle and steering alone on drives left out, beside classical models.
//! * `file/*`: robot files of this kind, and drives from tables and from the messages of bags.
//! * `diagnose`, `answer`: a case in, findings out, and findings as a verdict in sentences.
//! * `simulate`: a car as stated on the inputs of a drive.
//! * `traces`: drives beside their simulations, for pages and pictures.
//! * `next_drive`: drives of the menu as the car would drive them, and what they would say.
//! * `settings`: every tuned number.

mod answer;
mod car;
mod case;
mod cause;
mod clock;
mod constant_table;
mod constants;
mod diagnose;
mod drive;
pub mod file;
mod forecast;
mod laws;
mod left_out;
mod model;
mod next_drive;
mod rivals;
mod rows;
mod sensors;
mod settings;
mod simulate;
mod solve;
mod traces;
mod units;

pub use answer::diagnosis;
pub use car::{Car, Stated};
pub use case::Case;
pub use constant_table::constants;
pub use constants::{Constant, Quantity};
pub use diagnose::{Findings, diagnose, examine, rehearsable};
pub use drive::{Columns, Drive};
pub use forecast::{ByLength, Errors, LENGTHS};
pub use hierarchical_fit::CaseError as CarError;
pub use hierarchical_fit::{Answer, Estimate, NamedCause};
pub use left_out::{CORRECTED, FOLLOWING, OWN_ROWS, Table};
pub use simulate::simulate;

/// Every tuned number of this crate, for the page of settings.
pub fn settings() -> impl Iterator<Item = &'static ::settings::Setting> {
    settings::Settings::ALL.iter()
}
