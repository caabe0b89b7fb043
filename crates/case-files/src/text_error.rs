//! A text that is not what it should be.

use recordings::Spot;

/// What is wrong with a file that somebody or something has written, with its place.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{spot}: {message}")]
pub struct TextError {
    /// Where.
    pub spot: Spot,
    /// What is wrong, and what to do.
    pub message: String,
}
