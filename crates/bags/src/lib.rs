#![doc = include_str!("../README.md")]
//!
//! # Where what lies
//!
//! ```text
//! format ──> messages ──> mcap_file, sqlite ──> topic, loss, source
//!                └─> contents ──> fields, header_stamps
//! ```
//!
//! * `format`: the one list of formats, tables included: endings, first bytes, bag or table.
//! * `source`: what can be read and searched, files held in memory whole, zstd. `topic`: topics and messages. `loss`,
//!   `place`: what could not be read, and where. `error`: why a file could not be read at all.
//! * `messages`: the entrance; asks `format` and passes over the file.
//! * `mcap_file/*`: MCAP record by record (`framing`, `window`), chunks (`chunk`), topics and messages (`records`), the end
//!   of the file (`summary`), its SHA-256 on the way (`hashing`); `file` goes on behind damage. `sqlite`: rosbag2's.
//! * `fields/*`: paths (`path`), layouts of messages (`schema`, `definitions`), the wanted fields of a message (`reader` by
//!   `plan` or `json`), which fields there are (`survey` by `steps`); `cdr`, `run`, `names` walk the bytes.
//! * `contents`: what a bag holds; `header_stamps`: delays and drift of the stamps of drivers. `suggest`: nearest names.
//!
//! # What is written by hand, and why
//!
//! * Framing of MCAP records (`mcap_file/framing`, `file`): the readers of `mcap` stop at the first damage; a recording of an
//!   hour must not end at a flipped bit. What records and chunks hold is that crate's to say.
//! * Decoding by plan (`fields/plan`, `steps`): `re_ros_msg` makes every message a tree of values with their names. Here the
//!   way to three numbers of a message of fifty is worked out once for a topic and the rest passed over. Definitions are
//!   parsed by `re_ros_msg`, bytes read by `re_cdr`, and tests hold three decoders against each other.
//!
//! # Adding a format of bags
//!
//! A file that gives `messages` of the new storage, as `sqlite.rs` does, and one row in `format.rs`: the compiler names the
//! two `match`es in `messages.rs` that call it. A format of tables: see `recordings`.

mod contents;
mod error;
mod fields;
mod format;
mod header_stamps;
mod loss;
mod mcap_file;
mod messages;
mod place;
mod source;
mod sqlite;
pub mod suggest;
mod topic;

pub use contents::{Contents, Inside, TopicContents, contents, contents_of_beginning};
pub use error::FileError;
pub use fields::{Cell, Field, FieldError, FieldReader, HEADER_STAMP, LOG_TIME};
pub use format::{Format, Stored};
pub use header_stamps::{Delay, Drift, HeaderStamps};
pub use loss::{Ledger, Loss, LossKind, in_words};
pub use messages::messages;
pub use place::Place;
pub use source::{LARGEST_IN_MEMORY, LARGEST_RECORD, ReadSeek, Whole, cannot_read, head, read_whole, refuse_large};
pub use topic::{Message, Passed, Topic};
