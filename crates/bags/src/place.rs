//! What places in a file are counted in.

/// What a number that names a place counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Place {
    /// Lines of a text file, from 1.
    Line,
    /// Messages of a topic, from 1.
    Message,
    /// Rows of a table, from 1.
    Row,
    /// Bytes of a file, from 0.
    Byte,
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Line => "line",
            Self::Message => "message",
            Self::Row => "row",
            Self::Byte => "byte",
        })
    }
}
