//! What a caller gives to be read, and how it shall be.

use bags::ReadSeek;

/// A file as the caller gives it: its name and its bytes.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// Name or path; its last part is matched against the mapping's patterns.
    pub name: &'a str,
    /// Contents.
    pub bytes: &'a [u8],
}

/// A file as the caller opened it.
pub struct Opened<'a> {
    /// Name or path; its last part is matched against the mapping's patterns.
    pub name: &'a str,
    /// Where its bytes come from.
    pub source: &'a mut dyn ReadSeek,
}

impl std::fmt::Debug for Opened<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Opened").field("name", &self.name).finish_non_exhaustive()
    }
}

/// What to do with input that is not as it should be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Policy {
    /// Everything that would be a loss inside a file is an error.
    Strict,
    /// Skip rows with a wrong field count, an empty time or a repeated stamp and count them; sort rows that are up to a
    /// second late and count them; refuse text in numbers, numbers that are not finite, a negative magnitude and time
    /// that runs backwards by more.
    #[default]
    Normal,
    /// Skip and count all of these; only what leaves nothing to read is an error.
    Tolerant,
}

/// How to read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ReadOptions {
    /// What to do with bad rows and cells.
    pub policy: Policy,
}
