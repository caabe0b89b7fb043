//! What can be measured of one channel without knowing what it means.
//!
//! Medians and counts throughout, so that the defects that are looked for do not spoil the measure of the rest. Every
//! threshold is named and reasoned in `thresholds.rs`.

mod continuity;
mod finding;
mod grid;
mod join;
mod measure;
mod meter;
mod noise;
mod robust;
mod runs;
mod tally;
mod thresholds;
mod timing;
mod values;
mod words;
mod wraps;

pub use finding::{Finding, FindingKind, Severity};
pub use grid::Grid;
pub use measure::Quality;
pub use meter::QualityMeter;
pub use tally::{At, Tally};
pub use timing::{Gaps, Timing};
pub use values::{Extreme, Stretch, Values};
pub use wraps::Wrap;
