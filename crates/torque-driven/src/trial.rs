//! Hypotheses that were fitted in free run.

use crate::fit::{Fitted, Hypothesis};
use inference::hypothesis::Variant;

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

impl SearchResult {
    /// Takes a fit that was found elsewhere, unless the same hypothesis was fitted better here.
    pub(crate) fn include(&mut self, trial: Trial) {
        let list = if trial.hypothesis.parts.len() > 1 { &mut self.pairs } else { &mut self.singles };
        let labels = |t: &Trial| t.hypothesis.variants().map(Variant::label).collect::<Vec<_>>();
        match list.iter_mut().find(|t| labels(t) == labels(&trial)) {
            Some(known) if known.fitted.cost <= trial.fitted.cost => {}
            Some(known) => *known = trial,
            None => list.push(trial),
        }
    }
}
