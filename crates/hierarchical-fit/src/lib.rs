#![doc = include_str!("../README.md")]
//!
//! # Files
//!
//! * `observed`: what a fit needs of a drive and of the model that it is compared with.
//! * `session`: normal equations of a drive or session, with and without its own deviation.
//! * `data`: drives with their model, scales of errors, and what is known before them.
//! * `descent`, `fit`: equations of every drive and steps down them; constants with a deviation of each drive, and how drives scatter.
//! * `cause`, `weigh`, `name`: what may be wrong, the evidence for it, and which causes are named.
//! * `answered`, `look_alikes`, `solve`: fits with what is named, the first causes against others that do much the same.
//! * `believable`: answers without a cause that asks for what no owner would believe.
//! * `references`: what references say before the recordings, and whether they lack the same.
//! * `stretches`, `onset`: equations in the course of time, and causes that begin or end while the drives go on: what may be (`hypotheses`),
//!   all of it by one set of equations (`scan`), the best by their own (`search`) about fits of the constants with and without them
//!   (`gated`).
//! * `corrected`: constants with what is named, at instants of drives that were fitted or left out.
//! * `found`, `said`, `telling`, `sentences`, `hedges`: what was found as plain data, and as what all verdicts of such comparisons share.
//! * `next_drive`, `menu`: which drive would tell the remaining answers apart, and among which to choose.
//! * `rehearsable`: what the drives of a fit could say, for whoever asks what they would show.
//! * `table`: columns of a drive by the names that a robot file gives them.
//! * `ahead`: forecasts of a pose: where they begin, and how far off they are. `error`: why a case cannot be compared.
//! * `beside`: drives beside their simulations, for pages and pictures.
//! * `settings`: every tuned number.

mod ahead;
mod answered;
mod believable;
mod beside;
mod cause;
mod corrected;
mod data;
mod descent;
mod error;
mod fit;
mod found;
mod hedges;
mod look_alikes;
pub mod menu;
mod name;
pub mod next_drive;
mod observed;
mod onset;
mod references;
mod rehearsable;
mod said;
#[cfg(test)]
mod scaled;
mod sentences;
mod session;
mod settings;
mod solve;
mod stretches;
mod table;
pub mod telling;
mod weigh;

pub use ahead::Ahead;
pub use beside::Beside;
pub use cause::{Cause, Possible};
pub use data::{Data, Noise, Prior};
pub use descent::equations;
pub use error::CaseError;
pub use fit::Fit;
pub use found::{Answer, Began, Estimate, NamedCause};
pub use name::{Named, Weighed, covariance, name, name_from, named_as, of_class, stand_ins};
pub use observed::{Kind, Observed, Row, Spread};
pub use onset::{Onset, interval_of_instants};
pub use references::{gained_with_references, sets_of_references};
pub use rehearsable::{Hideable, Rehearsable, Told};
pub use said::{Said, Unconfirmed, Unexplained, Valued, is_beyond_references};
pub use sentences::{Wording, lacking_in_all, of_recordings};
pub use session::{Marginal, Session, joint};
pub use solve::{Solved, begun, solve};
pub use table::{Column, Table, or_nan};
pub use telling::UnevenSensor;
pub use weigh::{Evidence, Posterior};

/// Log odds of a cause before the data are seen, nats.
pub const ODDS: f64 = settings::SETTINGS.naming.odds;
/// Log odds from which a cause is named, nats.
pub const NAMED: f64 = settings::SETTINGS.naming.named;
/// Evidence within which causes cannot be told apart, nats.
pub const ALIKE: f64 = settings::SETTINGS.naming.alike;
/// Sigmas beyond which an error counts less.
pub const OUTLIER: f64 = settings::SETTINGS.errors.outlier;

/// Whether drives differ by as much as was tried: what is named with all of them is then not to be trusted.
pub fn is_widest(factor: f64) -> bool {
    settings::SETTINGS.fitting.factors.iter().all(|tried| *tried <= factor)
}

/// Every tuned number of this crate, for the page of settings.
pub fn settings() -> impl Iterator<Item = &'static ::settings::Setting> {
    settings::Settings::ALL.iter()
}
