//! A piece of physics that an engine does not hold, as lines with their numbers in them.

/// What the lines do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Does {
    /// Python that adds to torque, force or moment.
    Force,
    /// Python that changes the grip of wheels.
    Ground,
    /// Python that changes readings.
    Reading,
    /// One sentence.
    Words,
}

/// A piece of physics that an engine does not hold.
#[derive(Debug, Clone)]
pub(crate) struct Residual {
    pub(crate) title: String,
    pub(crate) why: String,
    pub(crate) does: Does,
    pub(crate) lines: Vec<String>,
}

impl Residual {
    /// One sentence about what is missing and why.
    pub(crate) fn note(&self) -> String {
        format!("{}: {}", self.title, self.why)
    }
}
