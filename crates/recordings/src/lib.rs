//! Recordings in SI units: readers, mappings and what could not be read.
//!
//! The crate knows nothing of robots or simulation and opens no file: it is given names and bytes.
//!
//! ```text
//! file names --Mapping::group--> runs --bytes--> read --> Read { recording, losses, .. }
//! ```
//!
//! * [`Signal`] is the closed vocabulary; [`Unit`] is what a signal is in, always SI.
//! * [`Mapping`] says which column of which file is which signal, in which unit and with which sign.
//! * [`read`] turns the files of one run into a [`Recording`] and the list of what it lost on the way; [`read_from`] does
//!   so from anything that can be read and searched, so that bags need not fit into memory.
//! * [`survey_from`] measures instead: quality and content of each channel, and what is inside bags, in one pass and in
//!   memory that does not grow.
//! * [`pieces_from`] gives a run of any length piece by piece.
//! * [`contents`] tells what a bag holds and [`table_contents`] what a table does, [`messages`] gives each message, [`FieldReader`] the fields of each.
//! * [`Quality`] is what can be measured of a channel without knowing what it means: rate, gaps, jumps, saturation ...
//! * [`Fingerprint`] tells the same data in another file.
//! * [`write_csv`], [`write_mcap`] and [`write_parquet`] are the way back; the built-in mapping `lacuna` reads all three.
//!
//! ```
//! use recordings::{Input, Mapping, ReadOptions, Signal, read};
//!
//! let mapping = Mapping::built_in("skid-steer-columns")?;
//! let bytes = b"time_s,gyro_z_rad_s\n0.00,\n0.01,0.25\n";
//! let run = read(&mapping, "run_1", &[Input { name: "run_1.csv", bytes }], &ReadOptions::default())?;
//! let gyro = run.recording.require(Signal::GyroZ)?;
//! assert_eq!(gyro.t_ns(), [10_000_000]);
//! assert_eq!(gyro.values(), [0.25]);
//! assert!(run.losses.is_empty());
//! # Ok::<(), recordings::RecordingError>(())
//! ```

mod bag;
mod cell;
mod channel;
mod column;
mod column_meter;
mod column_samples;
mod column_survey;
mod contents;
mod described;
mod error;
mod fields;
mod fingerprint;
mod group;
mod header;
mod header_stamps;
mod loss;
mod mapping;
mod mapping_raw;
mod mapping_text;
mod mapping_toml;
mod parquet;
mod pieces;
mod place;
mod quality;
mod read;
mod recording;
mod samples;
mod signal;
mod spot;
pub mod suggest;
mod survey;
mod table;
mod table_contents;
mod table_guess;
mod topics;
mod units;
mod write;
mod write_mcap;
mod write_parquet;

pub use bag::{LARGEST_IN_MEMORY, LARGEST_RECORD, Message, Passed, ReadSeek, Topic, messages};
pub use channel::{Attributes, Channel};
pub use column_survey::{ColumnContents, TimeLike, UnitBy};
pub use contents::{Contents, TopicContents, contents, contents_of_beginning};
pub use error::RecordingError;
pub use fields::{Field, FieldReader};
pub use fingerprint::{Fingerprint, FingerprintBuilder, group_by_content};
pub use group::{Group, GroupFile, Grouping};
pub use header_stamps::{Delay, Drift, HeaderStamps};
pub use loss::{Loss, LossKind};
pub use mapping::{BUILT_IN_MAPPINGS, ColumnMapping, FileMapping, Mapping, TimeMapping, is_bag};
pub use pieces::{Passage, pieces_from};
pub use place::Place;
pub use quality::{
    At, Extreme, Finding, FindingKind, Gaps, Grid, Quality, QualityMeter, Severity, Stretch, Tally, Timing, Values,
    Wrap,
};
pub use read::{Input, Opened, Policy, Read, ReadOptions, Source, UnusedColumn, read, read_from};
pub use recording::{Clock, Recording};
pub use signal::Signal;
pub use spot::Spot;
pub use survey::{Survey, SurveyedChannel, survey_from};
pub use table_contents::{TableContents, TableFormat, table_contents};
pub use units::{Scale, Unit, parse_unit};
pub use write::{lost_in_csv, write_csv};
pub use write_mcap::write_mcap;
pub use write_parquet::write_parquet;
