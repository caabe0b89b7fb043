//! Recordings of a fleet, each diagnosed by itself: resumable, dealt to machines, reported in one table.
//!
//! ```text
//! folder or manifest --> Unit --plan--> to do --run--> OUT/json/NAME.json, OUT/done/NAME.json --rows--> OUT/rows.parquet
//!                                                                         └── merge of several OUT ──> page
//! ```
//!
//! What a unit is named after is a hash of all that its answer depends on. A file in `done/` is written last, by
//! renaming: where it is there, the unit is finished, whatever happened to the program afterwards.

mod columns;
mod date;
mod find;
mod key;
mod manifest;
mod merge;
mod one;
mod overview;
mod page;
mod parquet_rows;
mod plan;
mod prepared;
mod queue;
mod row;
mod run;
mod shard;
mod store;
mod unit;

use case_files::long::Budget;
use inference::Options;
use recordings::ReadOptions;

pub use date::Date;
pub use find::{DEEPEST, FolderContents, cases_below, recordings_below};
pub use manifest::read as manifest;
pub use merge::{Merged, merge};
pub use overview::{Overview, RobotCount};
pub use page::{diagnosed, page};
pub use plan::{Plan, plan};
pub use row::{CAUSES, Outcome, Row, RowCause, RowSource};
pub use run::{Event, Ran, run};
pub use shard::{Shard, ShardError};
pub use store::{Entry, Store};
pub use unit::{Defaults, Setup, Unit};

/// Version of the rows' form.
pub const FORMAT: u32 = 1;

/// What holds for all units.
#[derive(Debug, Clone)]
pub struct Settings {
    /// Settings of each diagnosis.
    pub options: Options,
    /// What to do with bad rows and cells.
    pub reading: ReadOptions,
    /// The same as on the command line.
    pub reading_name: String,
    /// Recorded time that a diagnosis rests on at most.
    pub budget: Budget,
    /// Recordings that are worked on at once.
    pub threads: usize,
    /// Most recordings that are worked on in this run; the rest is left for the next.
    pub limit: Option<usize>,
}

/// The README's snippet, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
