//! Files that are held in memory whole, and bytes that are compressed with zstd.

use std::borrow::Cow;
use std::io::{Read, SeekFrom};

use sha2::{Digest, Sha256};

use super::{LARGEST_IN_MEMORY, LARGEST_RECORD, ReadSeek};
use crate::error::RecordingError;

/// First bytes of a zstd frame.
pub(super) const ZSTD_MAGIC: &[u8] = &[0x28, 0xb5, 0x2f, 0xfd];

/// A file in memory, unpacked.
pub(crate) struct Whole {
    /// Its contents.
    pub(crate) bytes: Vec<u8>,
    /// Its length as it is stored.
    pub(crate) file_bytes: u64,
    /// SHA-256 of what is stored.
    pub(crate) sha256: String,
    /// Number of unpacked bytes after which the compressed file was broken.
    pub(crate) broken_at: Option<u64>,
}

/// The first bytes; the source is at its start again afterwards.
pub(crate) fn head(name: &str, source: &mut dyn ReadSeek) -> Result<Vec<u8>, RecordingError> {
    let failed = |error| cannot_read(name, 0, &error);
    source.seek(SeekFrom::Start(0)).map_err(failed)?;
    let mut head = Vec::new();
    (&mut *source).take(16).read_to_end(&mut head).map_err(failed)?;
    source.seek(SeekFrom::Start(0)).map_err(failed)?;
    Ok(head)
}

/// Refuses a file that is too large for memory; the source is at its start afterwards.
pub(crate) fn refuse_large(name: &str, source: &mut dyn ReadSeek) -> Result<(), RecordingError> {
    let failed = |error| cannot_read(name, 0, &error);
    let bytes = source.seek(SeekFrom::End(0)).map_err(failed)?;
    source.seek(SeekFrom::Start(0)).map_err(failed)?;
    if bytes > LARGEST_IN_MEMORY {
        return Err(RecordingError::TooLarge { file: name.to_owned(), bytes, limit: LARGEST_IN_MEMORY });
    }
    Ok(())
}

/// Reads a file whole, unpacks it if it is zstd, and refuses what is too large for memory.
pub(crate) fn read_whole(name: &str, source: &mut dyn ReadSeek) -> Result<Whole, RecordingError> {
    let too_large = |bytes| {
        let file = name.to_owned();
        Err(RecordingError::TooLarge { file, bytes, limit: LARGEST_IN_MEMORY })
    };
    let mut bytes = Vec::new();
    let mut limited = source.take(LARGEST_IN_MEMORY + 1);
    limited.read_to_end(&mut bytes).map_err(|error| cannot_read(name, 0, &error))?;
    let file_bytes = bytes.len() as u64;
    if file_bytes > LARGEST_IN_MEMORY {
        return too_large(file_bytes);
    }
    let sha256 = hexadecimal(&Sha256::digest(&bytes));
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

/// The source's failure as this crate tells it.
pub(crate) fn cannot_read(name: &str, byte: u64, error: &std::io::Error) -> RecordingError {
    RecordingError::CannotRead { file: name.to_owned(), byte, message: error.to_string() }
}

/// Bytes as hexadecimal digits.
pub(crate) fn hexadecimal(bytes: &[u8]) -> String {
    use std::fmt::Write as _;
    bytes.iter().fold(String::new(), |mut text, byte| {
        // Writing to a string cannot fail.
        let _ = write!(text, "{byte:02x}");
        text
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sha256_is_that_of_fips_180() {
        let expected = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(hexadecimal(&Sha256::digest(b"abc")), expected);
    }
}
