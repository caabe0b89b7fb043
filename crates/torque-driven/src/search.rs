//! The search: screen, finalists, refits, two effects together, three.

use std::sync::Arc;

use law::OwnEffect;

use crate::candidate::Candidate;
use crate::fit::{Hypothesis, Point, Problem};
use crate::nothing::{is_far, without_effect};
use crate::refits::{
    Places, Starts, best_first, better, by_id, converge_members, converge_wholes, include_handed_over, polish,
    refit_from, refit_from_the_best,
};
use crate::screen::screen;
use crate::settings::search::{Finalists, Retuning, SETTINGS};
use crate::several::{pairs, thirds};
use crate::trial::{SearchResult, Trial, include};
use crate::{later_side, other_side};

const FINALISTS: Finalists = SETTINGS.finalists;
const RETUNING: Retuning = SETTINGS.retuning;

/// Finalists: alternately from both rankings until their places are taken, with a second form of an effect that has one close by.
/// An effect of one's own is always one of them: somebody asked for it.
fn finalists(first: &[Candidate], second: &[Candidate], places: [usize; 2]) -> Vec<Candidate> {
    let (a, b) = (by_id(first), by_id(second));
    let mut ids: Vec<&'static str> = Vec::new();
    let mut out: Vec<Candidate> = Vec::new();
    let mut places = Places(places);
    for i in 0..a.len().max(b.len()) {
        for list in [&a, &b] {
            if let Some(c) = list.get(i)
                && !ids.contains(&c.variant.spec().id)
                && (OwnEffect::of(c.variant.effect).is_some() || places.take(c.variant.spec()))
            {
                ids.push(c.variant.spec().id);
                out.push((*c).clone());
                // Its next best form (other side, axis, place) in the same ranking.
                let ranking = if std::ptr::eq(list, &raw const a) { first } else { second };
                let rival = ranking
                    .iter()
                    .filter(|o| o.variant.spec().id == c.variant.spec().id && o.variant.label() != c.variant.label())
                    .find(|o| o.evidence > c.evidence - FINALISTS.close);
                out.extend(rival.cloned());
            }
        }
    }
    out
}

/// Runs the whole search on the recordings. `known`: fits of single effects that were found elsewhere.
pub(crate) fn search(problem: &Problem<'_>, known: &[Trial], progress: &dyn Fn(&str)) -> SearchResult {
    let none = Hypothesis::default();
    let all = problem.variants();
    progress("screening every effect");
    let origin = problem.begin(&none, problem.origin(), None);
    let first = screen(problem, &origin, &all, &none);

    progress("re-tuning without any effect");
    let mut retuned = without_effect(problem, &origin);
    retuned.columns = Arc::new(problem.nuisance_columns(&retuned.point, &none, &retuned.response));
    let second = screen(problem, &retuned, &all, &none);
    let is_far = is_far(&origin, &retuned);
    let starts = Starts { origin: &origin, is_far, tries_both_tunings: is_far && !problem.has_references };

    progress("fitting the finalists");
    let places = if problem.has_references { FINALISTS.places } else { FINALISTS.places_by_file };
    let mut singles: Vec<Trial> = finalists(&first, &second, places)
        .into_iter()
        .map(|c| {
            let h = Hypothesis::single(c.variant, c.onsets.clone());
            let mut first = refit_from(problem, &h, &c.start, &origin);
            if let Some(start) = starts.size_by_free_run(problem, &h, &c.start) {
                first = better(first, refit_from(problem, &h, &start, &origin));
            }
            if starts.tries_both_tunings || retuned.cost - first.fitted.cost < FINALISTS.small_gain {
                better(first, refit_from(problem, &h, &c.start, &retuned))
            } else {
                first
            }
        })
        .collect();
    if problem.constants_are_loose {
        include_handed_over(problem, &none, &retuned, &mut singles);
    }
    for trial in known {
        include(&mut singles, trial.clone());
    }
    best_first(&mut singles);
    let best = singles.first().map_or(f64::MAX, |t| t.fitted.cost);
    let close = singles.iter_mut().filter(|t| t.fitted.cost < best + FINALISTS.close);
    for trial in close.take(FINALISTS.most_close) {
        *trial = polish(problem, trial, FINALISTS.more_steps);
    }
    best_first(&mut singles);
    if problem.constants_are_loose && !problem.has_references {
        refit_from_the_best(problem, &mut singles);
    }

    other_side::include(problem, &mut singles);
    later_side::include(problem, &origin, &mut singles);

    // An unconverged null would invent a gain for whatever comes next: polish it from the best single's tuning. Where only
    // the robot file holds the constants, an effect can spare "nothing" a long way: it starts from several.
    let again_from = if problem.has_references {
        usize::from(singles.first().is_some_and(|top| retuned.cost - top.fitted.cost < RETUNING.small_gain))
    } else {
        RETUNING.starts
    };
    for single in singles.iter().take(again_from) {
        let point = Point { effects: Vec::new(), ..single.fitted.point.clone() };
        let start = problem.begin(&none, point, Some(single.fitted.columns.clone()));
        let again = problem.refine(&none, start, RETUNING.last_steps, Some(2));
        if again.cost < retuned.cost {
            retuned = again;
        }
    }

    progress("looking for a second effect");
    let mut several = pairs(problem, &singles, starts);
    if let Some(best) = several.first() {
        converge_members(problem, best, &mut singles);
    }
    if let Some(best) = singles.first() {
        converge_wholes(problem, best, &mut several);
    }
    let mut three = thirds(problem, &singles, &several, starts, progress);
    if let Some(best) = three.first() {
        converge_members(problem, best, &mut several);
    }
    if let Some(best) = several.first().filter(|_| !three.is_empty()) {
        converge_wholes(problem, best, &mut three);
    }
    several.extend(three);
    best_first(&mut several);

    let mut screened: Vec<(String, f64)> =
        by_id(&first).iter().map(|c| (c.variant.spec().id.to_owned(), c.evidence)).collect();
    for c in by_id(&second) {
        if let Some(s) = screened.iter_mut().find(|s| s.0 == c.variant.spec().id) {
            s.1 = s.1.max(c.evidence);
        }
    }
    SearchResult { as_it_is: origin.cost, retuned, singles, several, screened }
}
