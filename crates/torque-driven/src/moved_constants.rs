//! Whether constants that moved since the references explain recordings better than an effect does.

use crate::decision::Decision;
use crate::fit::{Hypothesis, Point, Problem};
use crate::nothing::retune;
use crate::prices::evidence;
use crate::settings::decision::{Prices, SETTINGS};
use crate::stand_in;
use crate::trial::{SearchResult, Trial};

const PRICES: Prices = SETTINGS.prices;

/// Fits of the best hypothesis' effects, each alone, where constants that moved between visits, with one of these or
/// without any effect, explain the recordings better than the best hypothesis does with constants as the references have
/// them: by the evidence of both (Laplace), to which many constants that need not move cost much.
pub(crate) fn constants_moved(
    before: &Problem<'_>,
    after: &Problem<'_>,
    found: &SearchResult,
    decision: &Decision,
) -> Option<Vec<Trial>> {
    let none = Trial { hypothesis: Hypothesis::default(), fitted: found.retuned.clone() };
    let best = decision.scored.first().map_or(&none, |s| &s.trial);
    let least = evidence(before, &best.hypothesis, &best.fitted)? + PRICES.moved;
    // From where the constants are without such moves: from the origin a fit may end far from either.
    let with_moved = |hypothesis: Hypothesis, effects: Vec<f64>| {
        let start = if effects.is_empty() { after.origin() } else { best.fitted.point.clone() };
        let point = Point { effects, ..start };
        let fitted = retune(after, &hypothesis, after.begin(&hypothesis, point, None));
        Trial { hypothesis, fitted }
    };
    // What acts at one place, or from an instant on, may act everywhere: as the constant that stands for it.
    let with_constants = || {
        let point = stand_in::everywhere(before, best);
        let fitted = retune(after, &none.hypothesis, after.begin(&none.hypothesis, point, None));
        Trial { hypothesis: Hypothesis::default(), fitted }
    };
    let is_better = |t: &Trial| evidence(after, &t.hypothesis, &t.fitted).is_some_and(|moved| moved > least);
    let effects = best.hypothesis.each_alone(&best.fitted.point.effects);
    let trials: Vec<Trial> = effects.into_iter().map(|(h, e)| with_moved(h, e)).collect();
    let moved = trials.iter().any(is_better)
        || is_better(&with_moved(Hypothesis::default(), Vec::new()))
        || is_better(&with_constants());
    moved.then_some(trials)
}
