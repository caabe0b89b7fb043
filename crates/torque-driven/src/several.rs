//! Two effects together, and three.

use crate::candidate::Candidate;
use crate::fit::{Fitted, Hypothesis, Problem};
use crate::later_side;
use crate::refits::{Places, Starts, begin, best_first, by_id, include_handed_over, polish};
use crate::screen::screen;
use crate::settings::search::{Finalists, Pairs, SETTINGS, Thirds};
use crate::trial::{Trial, include};

const FINALISTS: Finalists = SETTINGS.finalists;
const PAIRS: Pairs = SETTINGS.pairs;
const THIRDS: Thirds = SETTINGS.thirds;

/// Second effects beside the two best: screened with the first at its size, both refitted from the calibrated point.
pub(crate) fn pairs(problem: &Problem<'_>, singles: &[Trial], starts: Starts<'_>) -> Vec<Trial> {
    let origin = starts.origin;
    let mut out: Vec<Trial> = Vec::new();
    let mut ids: Vec<&'static str> = Vec::new();
    let mut firsts = Places(PAIRS.firsts);
    for first in singles {
        let spec = first.hypothesis.parts[0].0.spec();
        let id = spec.id;
        // A rare effect that is no better than a common one is not worth a search of its own.
        let behind = spec.rarity > 0.0 && !ids.is_empty();
        let is_alone = later_side::is_alone(problem, &first.hypothesis.parts[0].0);
        if ids.contains(&id) || behind || is_alone || !firsts.take(spec) {
            continue;
        }
        ids.push(id);
        let (h1, e1) = (&first.hypothesis, &first.fitted.point.effects);
        let base = begin(problem, h1, &origin.point, e1, origin);
        let mut partners = screen_beside(problem, &base, first);
        let mut places = Places(PAIRS.partners);
        if problem.constants_are_loose {
            // What constants hide shows beside re-tuned ones, and the other way round.
            partners = in_turn(&partners, &screen_beside(problem, &first.fitted, first));
            places = Places(PAIRS.partners_by_file);
            include_handed_over(problem, h1, &first.fitted, &mut out);
        }
        let worth = partners.into_iter().filter(|p| p.evidence > PAIRS.partner_evidence);
        for p in worth.filter(|p| places.take(p.variant.spec())) {
            let known = out.iter().any(|t: &Trial| t.hypothesis.ids() == [p.variant.spec().id, id]);
            if known {
                continue;
            }
            let mut h = h1.clone();
            h.parts.push((p.variant, p.onsets.clone()));
            let start: Vec<f64> = e1.iter().chain(&p.start).copied().collect();
            include(&mut out, starts.refit(problem, &h, &start, &first.fitted));
        }
    }
    best_first(&mut out);
    for trial in out.iter_mut().take(PAIRS.polished) {
        *trial = polish(problem, trial, FINALISTS.more_steps);
    }
    best_first(&mut out);
    out
}

/// Two rankings in one, alternately; of each effect the candidate that comes first.
fn in_turn(first: &[Candidate], second: &[Candidate]) -> Vec<Candidate> {
    let mut out: Vec<Candidate> = Vec::new();
    for i in 0..first.len().max(second.len()) {
        for candidate in [first, second].iter().filter_map(|list| list.get(i)) {
            if !out.iter().any(|o| o.variant.spec().id == candidate.variant.spec().id) {
                out.push(candidate.clone());
            }
        }
    }
    out
}

/// Third effects beside the two best pairs, where a second effect matters: screened with both at their sizes, refitted from
/// the calibrated point, the best with more steps.
pub(crate) fn thirds(
    problem: &Problem<'_>,
    singles: &[Trial],
    pairs: &[Trial],
    starts: Starts<'_>,
    progress: &dyn Fn(&str),
) -> Vec<Trial> {
    let single = singles.first().map_or(f64::MAX, |t| t.fitted.cost);
    let mut out: Vec<Trial> = Vec::new();
    for pair in pairs.iter().take(THIRDS.pairs).filter(|t| single - t.fitted.cost > THIRDS.least_second) {
        if out.is_empty() {
            progress("looking for a third effect");
        }
        let (h2, e2) = (&pair.hypothesis, &pair.fitted.point.effects);
        let base = begin(problem, h2, &starts.origin.point, e2, starts.origin);
        let partners = screen_beside(problem, &base, pair);
        for p in partners.into_iter().filter(|p| p.evidence > THIRDS.partner_evidence).take(THIRDS.partners) {
            let mut h = h2.clone();
            h.parts.push((p.variant, p.onsets.clone()));
            let sorted = |h: &Hypothesis| {
                let mut ids = h.ids();
                ids.sort_unstable();
                ids
            };
            if out.iter().any(|t| sorted(&t.hypothesis) == sorted(&h)) {
                continue;
            }
            let start: Vec<f64> = e2.iter().chain(&p.start).copied().collect();
            out.push(starts.refit(problem, &h, &start, &pair.fitted));
        }
    }
    best_first(&mut out);
    for trial in out.iter_mut().take(THIRDS.polished) {
        *trial = polish(problem, trial, FINALISTS.more_steps);
    }
    best_first(&mut out);
    out
}

/// Partners of the effects of `first`, screened with these present at their fitted sizes.
fn screen_beside(problem: &Problem<'_>, base: &Fitted, first: &Trial) -> Vec<Candidate> {
    let ids = first.hypothesis.ids();
    let others: Vec<_> = problem.variants().into_iter().filter(|v| !ids.contains(&v.spec().id)).collect();
    let list = screen(problem, base, &others, &first.hypothesis);
    by_id(&list).into_iter().cloned().collect()
}
