#![doc = include_str!("../README.md")]
//!
//! # The entrances
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
//!   memory that does not grow. [`pieces_from`] gives a run of any length piece by piece.
//! * [`contents`] tells what a bag holds and [`table_contents`] what a table does.
//! * [`Quality`] is what can be measured of a channel without knowing what it means: rate, gaps, jumps, saturation ...
//!   [`Fingerprint`] tells the same data in another file.
//! * [`write_csv`], [`write_mcap`] and [`write_parquet`] are the way back; the built-in mapping `lacuna` reads all three.
//!
//! # Where what lies
//!
//! * `input`: what a caller gives. `read`: the entrance. `group`: which files make a run. `mapping*`: column to signal, unit
//!   and sign; `mapping_toml` reads them, `mapping_built_in` holds those that come along. `units`: conversion at the border.
//! * Readers. `table/*`: CSV, blocks of lines parsed beside each other and taken in order, by `header` and `cell`. `parquet`.
//!   `topics`: messages of the crate `bags` against a mapping.
//! * `row` is one line, message or row of any of them; `samples` makes rows samples, which `column_samples` keeps and
//!   `column_meter` measures: `column` says what both can. `survey` and `pieces` are the entrances for these.
//! * `named_columns`: columns by the names in the header, for robots whose files name them; they need no mapping.
//! * `table_contents`, with `table_guess` and `column_survey`: what a table holds that no mapping fits.
//! * `signal`, `channel`, `recording`: what comes out. `quality/*`: what can be measured of a channel. `fingerprint`.
//! * `write`, `write_mcap`, `write_parquet`: files that read back; `described`: what they say of themselves.
//! * `error`; `spot`: a place in a text that somebody wrote.
//!
//! # What is written by hand, and why
//!
//! * Plain decimals (`cell`): nearly every cell of a table is one, and a single exact division reads it faster
//!   than a general parser does, to the same bits (a test); all others go to `fast-float2`. Stamps are read as whole
//!   nanoseconds, which no parser of floating-point numbers keeps.
//! * Lines of CSV (`table/*`): `csv` reads one after the other, and an open quote would swallow the rest of the file; here
//!   blocks are parsed on all cores, and a quote costs its row. Header lines and guesses go through `csv`.
//! * Sorting by digits (`quality/robust`): the time of a survey is that of its sorting.
//!
//! # Adding a format of tables
//!
//! A file that makes its rows [`samples`](read), as `parquet.rs` does, and one row in the list of formats of `bags`
//! (`format.rs`: ending, first bytes). The compiler then names the `match`es that call a reader: `read.rs`, and
//! `table_contents.rs` for what is inside where no mapping fits. A format of bags: see that crate; nothing changes here.

mod cell;
mod channel;
mod column;
mod column_meter;
mod column_samples;
mod column_survey;
mod described;
mod error;
mod fingerprint;
mod group;
mod header;
mod input;
mod mapping;
mod mapping_built_in;
mod mapping_raw;
mod mapping_text;
mod mapping_toml;
mod named_columns;
mod parquet;
mod pieces;
mod quality;
mod read;
mod recording;
mod row;
mod samples;
mod signal;
mod spot;
mod survey;
mod table;
mod table_contents;
mod table_guess;
mod topics;
mod units;
mod write;
mod write_mcap;
mod write_parquet;

pub use bags::{
    Cell, Contents, Delay, Drift, Field, FieldError, FieldReader, FileError, Format, HEADER_STAMP, HeaderStamps,
    LOG_TIME, Loss, LossKind, Message, Place, ReadSeek, Topic, TopicContents, contents, contents_of_beginning,
    messages, suggest,
};
pub use channel::{Attributes, Channel};
pub use column_survey::{ColumnContents, TimeLike, UnitBy};
pub use error::RecordingError;
pub use fingerprint::{Fingerprint, FingerprintBuilder, group_by_content};
pub use group::{Group, GroupFile, Grouping, group_bags};
pub use input::{Input, Opened, Policy, ReadOptions};
pub use mapping::{ColumnMapping, FileMapping, Mapping, TimeMapping, is_bag};
pub use mapping_built_in::BUILT_IN_MAPPINGS;
pub use named_columns::{NamedColumn, NamedColumns, named_columns};
pub use pieces::{Passage, pieces_from};
pub use quality::{
    At, Extreme, Finding, FindingKind, Gaps, Grid, Quality, QualityMeter, Severity, Stretch, Tally, Timing, Values,
    Wrap,
};
pub use read::{Read, Source, UnusedColumn, read, read_from};
pub use recording::{Clock, Recording};
pub use signal::Signal;
pub use spot::Spot;
pub use survey::{Survey, SurveyedChannel, survey_from};
pub use table_contents::{TableContents, TableFormat, table_contents};
pub use units::{Scale, Unit, parse_unit};
pub use write::{lost_in_csv, write_csv};
pub use write_mcap::write_mcap;
pub use write_parquet::write_parquet;
