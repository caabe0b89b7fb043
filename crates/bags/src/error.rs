//! The crate's one error type.

/// Why a file could not be read at all. Each sentence says what, where and what to do.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)] // the sentences are the documentation of the fields
pub enum FileError {
    /// The source failed while it was read.
    #[error("{file}: reading failed at byte {byte}: {message}; try again, or copy the file first")]
    CannotRead { file: String, byte: u64, message: String },

    /// A file whose format has to be held in memory as a whole, and that is too large for it.
    #[error("{file}: {bytes} bytes, but this format is read whole and {limit} is the limit; convert it to MCAP")]
    TooLarge { file: String, bytes: u64, limit: u64 },

    /// A file that cannot be read at all.
    #[error("{file}: not a readable {format} file: {message}")]
    NotReadable { file: String, format: &'static str, message: String },
}
