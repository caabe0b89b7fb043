//! Hypotheses that were fitted in free run.

use crate::fit::{Fitted, Hypothesis};

/// A hypothesis that was fitted in free run.
#[derive(Clone)]
pub(crate) struct Trial {
    pub(crate) hypothesis: Hypothesis,
    pub(crate) fitted: Fitted,
}

/// All that the search found.
pub(crate) struct SearchResult {
    pub(crate) retuned: Fitted,
    pub(crate) singles: Vec<Trial>,
    pub(crate) pairs: Vec<Trial>,
    /// Best evidence of the screens per effect id, for the report.
    pub(crate) screened: Vec<(String, f64)>,
}
