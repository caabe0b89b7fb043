//! What can be wrong with a model.

/// A model that no robot file can be made of: what is wrong, where, and what to do.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ImportError {
    /// At a place in the file.
    #[error("{file}: line {line}: {what}")]
    At {
        /// The file.
        file: String,
        /// Its line, from 1.
        line: u32,
        /// What is wrong there, and what to do.
        what: String,
    },
    /// The model as a whole.
    #[error("{file}: {what}")]
    Whole {
        /// The file.
        file: String,
        /// What is wrong, and what to do.
        what: String,
    },
}
