//! The messages of a bag, whatever keeps them.

use std::io::Cursor;

use crate::error::FileError;
use crate::format::{Format, Stored};
use crate::loss::{Ledger, LossKind};
use crate::place::Place;
use crate::source::{ReadSeek, Whole, head, read_whole};
use crate::topic::{Passed, Sink};
use crate::{Message, mcap_file, sqlite};

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
/// let passed = bags::messages("cut.mcap", &mut source, &mut |message| {
///     println!("{} at {} ns", message.topic.name, message.log_time_ns);
///     Ok::<(), bags::FileError>(())
/// })?;
/// assert_eq!(passed.losses[0].to_string(), "cut.mcap: 1 file without its end: it was cut off, byte 8");
/// # Ok::<(), bags::FileError>(())
/// ```
pub fn messages<E: From<FileError>>(
    name: &str,
    source: &mut dyn ReadSeek,
    each: &mut dyn FnMut(Message<'_>) -> Result<(), E>,
) -> Result<Passed, E> {
    match Stored::of(name, &head(name, source)?) {
        // The one format that is read as it passes.
        Stored::As(Format::Mcap) => mcap_file::pass(name, source, each),
        Stored::As(Format::Sqlite) | Stored::Compressed => unpacked(name, read_whole(name, source)?, each),
        Stored::As(Format::Parquet | Format::Csv) => Err(no_bag(name).into()),
    }
}

/// The messages of a bag that is in memory, unpacked.
fn unpacked<E: From<FileError>>(name: &str, whole: Whole, each: &mut Sink<'_, E>) -> Result<Passed, E> {
    let Whole { bytes, file_bytes, sha256, broken_at } = whole;
    let inner = name.strip_suffix(".zstd").or_else(|| name.strip_suffix(".zst")).unwrap_or(name);
    let mut passed = match Stored::of(inner, &bytes) {
        Stored::As(Format::Mcap) => mcap_file::pass(name, &mut Cursor::new(&bytes), each)?,
        Stored::As(Format::Sqlite) => sqlite::pass(name, bytes, each)?,
        Stored::As(Format::Parquet | Format::Csv) | Stored::Compressed => return Err(no_bag(name).into()),
    };
    if let Some(byte) = broken_at {
        let mut ledger = Ledger::new(name, Place::Byte);
        ledger.add(LossKind::CutOff, None, || Some(byte));
        passed.losses.splice(0..0, ledger.into_losses());
    }
    (passed.bytes, passed.sha256) = (file_bytes, sha256);
    Ok(passed)
}

fn no_bag(name: &str) -> FileError {
    let message = "it is neither MCAP nor sqlite3".to_owned();
    FileError::NotReadable { file: name.to_owned(), format: "bag", message }
}
