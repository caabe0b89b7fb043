//! Where bytes come from: what can be read and searched, files that are held in memory whole, and what is compressed
//! with zstd.

use std::borrow::Cow;
use std::io::{Read, Seek, SeekFrom};

use sha2::{Digest, Sha256};

use crate::error::FileError;

/// The largest record, chunk (packed or not) or message that is held in memory, in bytes. What is larger is skipped and
/// counted: a length field is never believed.
pub const LARGEST_RECORD: usize = 64 << 20;

/// The largest file, in bytes, of a format that has to be held in memory whole: sqlite3, Parquet, CSV, and files that
/// are compressed as a whole.
pub const LARGEST_IN_MEMORY: u64 = 1 << 30;

/// Bytes that can be read from anywhere: an open file, a slice in a cursor, a fuzzer.
pub trait ReadSeek: Read + Seek {}

impl<T: Read + Seek> ReadSeek for T {}

/// First bytes of a zstd frame.
pub(crate) const ZSTD_MAGIC: &[u8] = &[0x28, 0xb5, 0x2f, 0xfd];

/// A file in memory, unpacked.
#[derive(Debug)]
pub struct Whole {
    /// Its contents.
    pub bytes: Vec<u8>,
    /// Its length as it is stored.
    pub file_bytes: u64,
    /// SHA-256 of what is stored.
    pub sha256: String,
    /// Number of unpacked bytes after which the compressed file was broken.
    pub broken_at: Option<u64>,
}

impl Whole {
    /// The same, when it unpacked to its end.
    ///
    /// # Errors
    /// When the compressed file was broken.
    pub fn unbroken(self, name: &str) -> Result<Self, FileError> {
        if self.broken_at.is_none() {
            return Ok(self);
        }
        let (file, message) = (name.to_owned(), "the compressed file is damaged or cut off".to_owned());
        Err(FileError::NotReadable { file, format: "zstd", message })
    }
}

/// The first bytes; the source is at its start again afterwards.
///
/// # Errors
/// When the source fails.
pub fn head(name: &str, source: &mut dyn ReadSeek) -> Result<Vec<u8>, FileError> {
    let failed = |error| cannot_read(name, 0, &error);
    source.seek(SeekFrom::Start(0)).map_err(failed)?;
    let mut head = Vec::new();
    (&mut *source).take(16).read_to_end(&mut head).map_err(failed)?;
    source.seek(SeekFrom::Start(0)).map_err(failed)?;
    Ok(head)
}

/// Refuses a file that is too large for memory; the source is at its start afterwards.
///
/// # Errors
/// When the source fails, and when it is longer than [`LARGEST_IN_MEMORY`].
pub fn refuse_large(name: &str, source: &mut dyn ReadSeek) -> Result<(), FileError> {
    let failed = |error| cannot_read(name, 0, &error);
    let bytes = source.seek(SeekFrom::End(0)).map_err(failed)?;
    source.seek(SeekFrom::Start(0)).map_err(failed)?;
    if bytes > LARGEST_IN_MEMORY {
        return Err(FileError::TooLarge { file: name.to_owned(), bytes, limit: LARGEST_IN_MEMORY });
    }
    Ok(())
}

/// Reads a file whole, unpacks it if it is zstd, and refuses what is too large for memory.
///
/// # Errors
/// When the source fails, and when it is longer than [`LARGEST_IN_MEMORY`], packed or not.
pub fn read_whole(name: &str, source: &mut dyn ReadSeek) -> Result<Whole, FileError> {
    let too_large = |bytes| {
        let file = name.to_owned();
        Err(FileError::TooLarge { file, bytes, limit: LARGEST_IN_MEMORY })
    };
    let mut bytes = Vec::new();
    let mut limited = source.take(LARGEST_IN_MEMORY + 1);
    limited.read_to_end(&mut bytes).map_err(|error| cannot_read(name, 0, &error))?;
    let file_bytes = bytes.len() as u64;
    if file_bytes > LARGEST_IN_MEMORY {
        return too_large(file_bytes);
    }
    let sha256 = hex::encode(Sha256::digest(&bytes));
    if !bytes.starts_with(ZSTD_MAGIC) {
        return Ok(Whole { bytes, file_bytes, sha256, broken_at: None });
    }
    let mut unpacked = Vec::new();
    let broken_at = unzstd(&bytes, LARGEST_IN_MEMORY + 1, &mut unpacked).is_err().then_some(unpacked.len() as u64);
    if unpacked.len() as u64 > LARGEST_IN_MEMORY {
        return too_large(unpacked.len() as u64);
    }
    Ok(Whole { bytes: unpacked, file_bytes, sha256, broken_at })
}

/// A message as it was sent: unpacked where the recorder compressed each message by itself. `None` when that fails.
pub(crate) fn payload(bytes: &[u8]) -> Option<Cow<'_, [u8]>> {
    // No CDR or JSON message starts like this.
    if !bytes.starts_with(ZSTD_MAGIC) {
        return Some(Cow::Borrowed(bytes));
    }
    let mut unpacked = Vec::new();
    unzstd(bytes, LARGEST_RECORD as u64 + 1, &mut unpacked).ok()?;
    (unpacked.len() <= LARGEST_RECORD).then_some(Cow::Owned(unpacked))
}

/// Unpacks up to `limit` bytes; what was unpacked before an error stays.
fn unzstd(bytes: &[u8], limit: u64, into: &mut Vec<u8>) -> std::io::Result<()> {
    zstd::stream::read::Decoder::with_buffer(bytes)?.take(limit).read_to_end(into).map(|_| ())
}

/// The failure of a source as an error that names file and byte.
pub fn cannot_read(name: &str, byte: u64, error: &std::io::Error) -> FileError {
    FileError::CannotRead { file: name.to_owned(), byte, message: error.to_string() }
}
