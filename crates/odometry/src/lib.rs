#![doc = include_str!("../README.md")]
//!
//! # Files
//!
//! * `wheel`, `kinematics`: a robot as a list of wheels, and from turning wheels to the motion of its body.
//! * `drive`, `counter`, `lost_pose`, `units`, `yaw`: turns of the wheels, steering and pose on one grid of rows; counters, units, whole turns.
//! * `heading`: a gyro in the place of a pose.
//! * `constants`, `motion`: what the implied pose depends on, with the laws of slip and of the pose's frame.
//! * `windows`, `fit`: errors over windows, and their fit with a deviation of each session.
//! * `cause`: what may be wrong.
//! * `rates`, `held`: velocities from poses, and signals as integrals, on a grid of steps.
//! * `alignment`: offset and rate of two devices' clocks by the speeds that both measure.
//! * `clock`, `dropout`, `standing`: clocks that start or run apart, counts that were lost, columns that stand still.
//! * `forecast`, `rivals/*`: pose from counts alone on drives left out, beside the classical calibrations.
//! * `file/*`: robot files of this kind, and drives from tables and from the messages of bags.
//! * `findings`, `said`: what the drives of a case say, as plain data, and how it follows from a fit.
//! * `onset`: a cause that begins or ends while the drives go on.
//! * `references`: what references say before the recordings, and whether they lack the same.
//! * `doubt`: causes that evidence names and that explain little.
//! * `diagnose`, `left_out`, `answer`: a case in, findings out, and findings as a verdict in sentences.
//! * `next_drive`: drives of the menu as the robot would drive them, and what they would say.
//! * `simulate`: a robot as stated on the counts of a drive.
//! * `traces`: drives beside their simulations, for pages and pictures.
//! * `settings`: every tuned number.

pub mod alignment;
mod answer;
mod case;
mod cause;
mod clock;
mod constants;
mod counter;
mod diagnose;
mod doubt;
mod drive;
mod dropout;
mod error;
pub mod file;
mod findings;
mod fit;
mod forecast;
mod heading;
pub mod held;
mod kinematics;
mod left_out;
mod lost_pose;
mod motion;
mod next_drive;
mod onset;
pub mod pose_jumps;
pub mod rates;
mod references;
mod rehearsable;
mod rivals;
mod said;
mod settings;
mod simulate;
mod standing;
mod traces;
mod units;
mod wheel;
mod windows;
mod yaw;

pub use answer::diagnosis;
pub use case::Case;
pub use constants::{ClockZero, Constant, Measured, Quantity, constants};
pub use diagnose::{diagnose, examine, rehearsable};
pub use drive::{Drive, WheelData};
pub use error::OdometryError;
pub use findings::Findings;
pub use forecast::{Errors, LENGTHS};
pub use hierarchical_fit::{Answer, Estimate, NamedCause};
pub use left_out::{Table, left_out};
pub use simulate::simulate;
pub use wheel::{Sigmas, Wheel, WheeledRobot};

/// Every tuned number of this crate, for the page of settings.
pub fn settings() -> impl Iterator<Item = &'static ::settings::Setting> {
    settings::Settings::ALL.iter()
}
