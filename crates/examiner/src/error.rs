//! What can go wrong.

/// Why a case could not be drawn or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Settings that make no case.
    #[error("{0}")]
    Settings(&'static str),
    /// A number that JSON cannot hold.
    #[error("a number of the case is not finite")]
    Json(#[from] serde_json::Error),
    /// A file that could not be written.
    #[error("cannot write {}", path.display())]
    Write {
        /// The file or folder.
        path: std::path::PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
}
