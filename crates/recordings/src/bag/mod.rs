//! Bags: messages of topics, as MCAP or rosbag2's sqlite3 keep them.

mod framing;
mod hashing;
mod mcap_chunk;
mod mcap_file;
mod mcap_records;
mod mcap_summary;
mod sqlite;
mod unpack;
mod window;

use std::collections::BTreeMap;
use std::io::{Read, Seek};
use std::sync::Arc;

use crate::error::RecordingError;
use crate::loss::{Ledger, Loss};
use crate::place::Place;

use unpack::Whole;
pub(crate) use unpack::{cannot_read, head, hexadecimal, payload, read_whole, refuse_large};

/// The largest record, chunk (packed or not) or message that is held in memory, in bytes. What is larger is skipped and
/// counted: a length field is never believed.
pub const LARGEST_RECORD: usize = 64 << 20;

/// The largest file, in bytes, of a format that has to be held in memory whole: sqlite3, Parquet, CSV, and files that
/// are compressed as a whole.
pub const LARGEST_IN_MEMORY: u64 = 1 << 30;

/// Bytes that can be read from anywhere: an open file, a slice in a cursor, a fuzzer.
pub trait ReadSeek: Read + Seek {}

impl<T: Read + Seek> ReadSeek for T {}

/// What a bag says about a topic.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Topic {
    /// Its name: `/imu/data`.
    pub name: String,
    /// The type of its messages: `sensor_msgs/msg/Imu`.
    pub message_type: String,
    /// How messages are encoded: `cdr`, `json`.
    pub encoding: String,
    /// How the schema is written: `ros2msg`, `jsonschema`; empty without a schema.
    pub schema_encoding: String,
    /// The schema, as it stands in the file; empty where the file has none.
    pub schema: Arc<[u8]>,
    /// What an MCAP channel says of itself beside: `offered_qos_profiles`; the first one's where several carry the topic.
    pub metadata: BTreeMap<String, String>,
}

impl Topic {
    /// True for the same topic, whatever its channels say beside.
    fn is_same(&self, other: &Self) -> bool {
        let identity = |topic: &'_ Self| {
            [&topic.name, &topic.message_type, &topic.encoding, &topic.schema_encoding].map(String::clone)
        };
        identity(self) == identity(other) && self.schema == other.schema
    }
}

/// One message of a bag.
#[derive(Debug, Clone, Copy)]
pub struct Message<'a> {
    /// The topic's place in the order in which topics were first met.
    pub topic_index: usize,
    /// The topic.
    pub topic: &'a Topic,
    /// When the recorder got it, in ns.
    pub log_time_ns: i64,
    /// The encoded message.
    pub bytes: &'a [u8],
}

/// What becomes of each message.
pub(crate) type Sink<'s> = dyn FnMut(Message<'_>) -> Result<(), RecordingError> + 's;

/// How the bytes of a file tell what it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Format {
    Mcap,
    Sqlite,
    /// Compressed with zstd as a whole.
    Zstd,
    Parquet,
    /// None of these.
    Other,
}

impl Format {
    /// The format by the first bytes, and by the name where these are damaged.
    pub(crate) fn of(name: &str, head: &[u8]) -> Self {
        let ends = |ending: &str| name.to_ascii_lowercase().ends_with(ending);
        match head {
            _ if head.starts_with(mcap::MAGIC) => Self::Mcap,
            _ if head.starts_with(b"SQLite format 3\0") => Self::Sqlite,
            _ if head.starts_with(unpack::ZSTD_MAGIC) => Self::Zstd,
            _ if head.starts_with(b"PAR1") => Self::Parquet,
            _ if ends(".mcap") => Self::Mcap,
            _ if ends(".db3") => Self::Sqlite,
            _ if ends(".zstd") || ends(".zst") => Self::Zstd,
            _ if ends(".parquet") => Self::Parquet,
            _ => Self::Other,
        }
    }
}

/// What passing over a bag gives beside its messages.
#[derive(Debug, Clone, PartialEq)]
pub struct Passed {
    /// All topics, in the order in which they were first met.
    pub topics: Vec<Topic>,
    /// What could not be read.
    pub losses: Vec<Loss>,
    /// Messages that no checksum of the file covers: changed bytes in them would not show.
    pub unchecked: u64,
    /// Length of the file in bytes.
    pub bytes: u64,
    /// SHA-256 of the file, 64 hexadecimal digits.
    pub sha256: String,
}

/// Gives every message of a bag to `each`, in the order of the file: MCAP, rosbag2's sqlite3, and either of them
/// compressed with zstd as a whole.
///
/// A damaged MCAP file gives every message of whole chunks before and after the damage.
///
/// # Errors
/// When the source fails, when the file is no bag or too large for a format that is read whole, and whatever `each`
/// returns.
///
/// ```
/// use std::io::Cursor;
/// let mut source = Cursor::new(b"\x89MCAP0\r\n".to_vec());
/// let passed = recordings::messages("cut.mcap", &mut source, &mut |message| {
///     println!("{} at {} ns", message.topic.name, message.log_time_ns);
///     Ok(())
/// })?;
/// assert_eq!(passed.losses[0].to_string(), "cut.mcap: 1 file without its end: it was cut off, byte 8");
/// # Ok::<(), recordings::RecordingError>(())
/// ```
pub fn messages(
    name: &str,
    source: &mut dyn ReadSeek,
    each: &mut dyn FnMut(Message<'_>) -> Result<(), RecordingError>,
) -> Result<Passed, RecordingError> {
    let head = unpack::head(name, source)?;
    match Format::of(name, &head) {
        Format::Mcap => mcap_file::pass(name, source, each),
        format @ (Format::Sqlite | Format::Zstd) => {
            let Whole { bytes, file_bytes, sha256, broken_at } = read_whole(name, source)?;
            let inner = if format == Format::Zstd { inner_name(name) } else { name };
            let mut passed = match Format::of(inner, &bytes) {
                Format::Mcap => mcap_file::pass(name, &mut std::io::Cursor::new(&bytes), each)?,
                Format::Sqlite => sqlite::pass(name, bytes, each)?,
                _ => return Err(no_bag(name)),
            };
            if let Some(byte) = broken_at {
                let mut ledger = Ledger::new(name, Place::Byte);
                ledger.add(crate::LossKind::CutOff, None, || Some(byte));
                passed.losses.splice(0..0, ledger.into_losses());
            }
            (passed.bytes, passed.sha256) = (file_bytes, sha256);
            Ok(passed)
        }
        Format::Parquet | Format::Other => Err(no_bag(name)),
    }
}

/// A name without the ending of its compression.
fn inner_name(name: &str) -> &str {
    name.rsplit_once('.').map_or(name, |(inner, _)| inner)
}

fn no_bag(name: &str) -> RecordingError {
    let message = "it is neither MCAP nor sqlite3".to_owned();
    RecordingError::NotReadable { file: name.to_owned(), format: "bag", message }
}
