//! The search: screen, finalists, refits, two effects together, three.

use std::sync::Arc;

use law::OwnEffect;
use robot_model::EffectSpec;

use crate::candidate::Candidate;
use crate::fit::{Fitted, Hypothesis, Point, Problem};
use crate::screen::screen;
use crate::settings::search::{Finalists, Pairs, Retuning, SETTINGS, Thirds};
use crate::trial::{SearchResult, Trial, include};
use crate::{disc, handed_over, onset};

const FINALISTS: Finalists = SETTINGS.finalists;
const RETUNING: Retuning = SETTINGS.retuning;
const PAIRS: Pairs = SETTINGS.pairs;
const THIRDS: Thirds = SETTINGS.thirds;

/// Places that are left to common and to rare effects.
struct Places([usize; 2]);

impl Places {
    /// Takes a place for `spec`, if one is left.
    fn take(&mut self, spec: &EffectSpec) -> bool {
        let left = &mut self.0[usize::from(spec.rarity > 0.0)];
        let free = *left > 0;
        *left -= usize::from(free);
        free
    }
}

/// Distinct ids in the order of evidence, with the best candidate of each.
fn by_id(candidates: &[Candidate]) -> Vec<&Candidate> {
    let mut out: Vec<&Candidate> = Vec::new();
    for c in candidates {
        if !out.iter().any(|o| o.variant.spec().id == c.variant.spec().id) {
            out.push(c);
        }
    }
    out
}

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

fn begin(problem: &Problem<'_>, h: &Hypothesis, point: &Point, effects: &[f64], base: &Fitted) -> Fitted {
    let point = Point { effects: effects.to_vec(), ..point.clone() };
    problem.begin(h, point, Some(base.columns.clone()))
}

/// A first refit, with the columns of θ that are there: they are renewed where it may win.
fn refit(problem: &Problem<'_>, h: Hypothesis, start: Fitted, steps: usize, renew: Option<usize>) -> Trial {
    let fitted = problem.refine(&h, start, steps, renew);
    let mut trial = Trial { hypothesis: h, fitted };
    onset::scan(problem, &mut trial);
    trial
}

/// Refits a trial that may win: more steps, and its place looked for by exact free runs.
fn polish(problem: &Problem<'_>, trial: &Trial, steps: usize) -> Trial {
    let mut trial = trial.clone();
    disc::scan(problem, &mut trial);
    let mut trial = refit(problem, trial.hypothesis, trial.fitted, steps, Some(0));
    disc::scan(problem, &mut trial);
    trial
}

/// Re-tunes constants, beside the effects of a hypothesis.
pub(crate) fn retune(problem: &Problem<'_>, h: &Hypothesis, start: Fitted) -> Fitted {
    let retuned = problem.refine(h, start, RETUNING.first_steps, Some(1));
    problem.refine(h, retuned, RETUNING.second_steps, Some(0))
}

/// Runs the whole search on the recordings. `known`: fits of single effects that were found elsewhere.
pub(crate) fn search(problem: &Problem<'_>, known: &[Trial], progress: &dyn Fn(&str)) -> SearchResult {
    let none = Hypothesis::default();
    let all = problem.variants();
    progress("screening every effect");
    let origin = problem.begin(&none, problem.origin(), None);
    let first = screen(problem, &origin, &all, &none);

    progress("re-tuning without any effect");
    let mut retuned = retune(problem, &none, origin.clone());
    retuned.columns = Arc::new(problem.nuisance_columns(&retuned.point, &none, &retuned.response));
    let second = screen(problem, &retuned, &all, &none);

    progress("fitting the finalists");
    let places = if problem.has_references { FINALISTS.places } else { FINALISTS.places_by_file };
    let mut singles: Vec<Trial> = finalists(&first, &second, places)
        .into_iter()
        .map(|c| {
            let h = Hypothesis::single(c.variant, c.onsets.clone());
            let start = begin(problem, &h, &origin.point, &c.start, &origin);
            let trial = refit(problem, h.clone(), start, FINALISTS.steps, None);
            if retuned.cost - trial.fitted.cost < FINALISTS.small_gain {
                let start = begin(problem, &h, &retuned.point, &c.start, &retuned);
                let again = refit(problem, h.clone(), start, FINALISTS.steps, None);
                if again.fitted.cost < trial.fitted.cost {
                    return again;
                }
            }
            trial
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

    // An unconverged null would invent a gain for whatever comes next: polish it from the best single's tuning. Where only
    // the robot file holds the constants, an effect can spare "nothing" a long way: it starts from several.
    let starts = if problem.has_references {
        usize::from(singles.first().is_some_and(|top| retuned.cost - top.fitted.cost < RETUNING.small_gain))
    } else {
        RETUNING.starts
    };
    for single in singles.iter().take(starts) {
        let point = Point { effects: Vec::new(), ..single.fitted.point.clone() };
        let start = problem.begin(&none, point, Some(single.fitted.columns.clone()));
        let again = problem.refine(&none, start, RETUNING.last_steps, Some(2));
        if again.cost < retuned.cost {
            retuned = again;
        }
    }

    progress("looking for a second effect");
    let mut several = pairs(problem, &singles, &origin);
    if let Some(best) = several.first() {
        converge_members(problem, best, &mut singles);
    }
    if let Some(best) = singles.first() {
        converge_wholes(problem, best, &mut several);
    }
    let mut three = thirds(problem, &singles, &several, &origin, progress);
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

/// Adds effects that may hide in a constant which was re-tuned far beside `h`, each in the better of both fits.
fn include_handed_over(problem: &Problem<'_>, h: &Hypothesis, fitted: &Fitted, trials: &mut Vec<Trial>) {
    for (hypothesis, point) in handed_over::starts(problem, h, fitted) {
        let start = problem.begin(&hypothesis, point, Some(fitted.columns.clone()));
        let trial = refit(problem, hypothesis, start, FINALISTS.more_steps, Some(2));
        include(trials, trial);
    }
}

/// Fits what a hypothesis holds with one effect less again, from its tuning: a fit that had not converged would invent a
/// gain for the effect that is added.
fn converge_members(problem: &Problem<'_>, whole: &Trial, members: &mut [Trial]) {
    for member in members.iter_mut().filter(|t| t.hypothesis.parts.len() + 1 == whole.hypothesis.parts.len()) {
        let Some(effects) = whole.hypothesis.values_of(&member.hypothesis, &whole.fitted.point.effects) else {
            continue;
        };
        if member.fitted.cost - whole.fitted.cost > PAIRS.least_second {
            let start = begin(problem, &member.hypothesis, &whole.fitted.point, &effects, &whole.fitted);
            let again = problem.refine(&member.hypothesis, start, FINALISTS.more_steps, Some(2));
            if again.cost < member.fitted.cost {
                member.fitted = again;
            }
        }
    }
    best_first(members);
}

/// Fits hypotheses that hold all of `part`, and more, again from its tuning where they fit no better than it alone: these
/// cannot have converged.
fn converge_wholes(problem: &Problem<'_>, part: &Trial, wholes: &mut Vec<Trial>) {
    for whole in wholes.iter_mut().filter(|whole| whole.fitted.cost > part.fitted.cost) {
        let effects = &whole.fitted.point.effects;
        if whole.hypothesis.values_of(&part.hypothesis, effects).is_none() {
            continue;
        }
        let start = begin(problem, &whole.hypothesis, &part.fitted.point, effects, &part.fitted);
        let again = problem.refine(&whole.hypothesis, start, FINALISTS.more_steps, Some(2));
        if again.cost < whole.fitted.cost {
            whole.fitted = again;
        }
    }
    if problem.constants_are_loose {
        include_handed_over(problem, &part.hypothesis, &part.fitted, wholes);
    }
    best_first(wholes);
}

fn best_first(trials: &mut [Trial]) {
    trials.sort_by(|a, b| a.fitted.cost.total_cmp(&b.fitted.cost));
}

/// Second effects beside the two best: screened with the first at its size, both refitted from the calibrated point.
fn pairs(problem: &Problem<'_>, singles: &[Trial], origin: &Fitted) -> Vec<Trial> {
    let mut out: Vec<Trial> = Vec::new();
    let mut ids: Vec<&'static str> = Vec::new();
    let mut firsts = Places(PAIRS.firsts);
    for first in singles {
        let spec = first.hypothesis.parts[0].0.spec();
        let id = spec.id;
        // A rare effect that is no better than a common one is not worth a search of its own.
        let behind = spec.rarity > 0.0 && !ids.is_empty();
        if ids.contains(&id) || behind || !firsts.take(spec) {
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
            let start = begin(problem, &h, &origin.point, &start, origin);
            include(&mut out, refit(problem, h, start, FINALISTS.steps, None));
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
fn thirds(
    problem: &Problem<'_>,
    singles: &[Trial],
    pairs: &[Trial],
    origin: &Fitted,
    progress: &dyn Fn(&str),
) -> Vec<Trial> {
    let single = singles.first().map_or(f64::MAX, |t| t.fitted.cost);
    let mut out: Vec<Trial> = Vec::new();
    for pair in pairs.iter().take(THIRDS.pairs).filter(|t| single - t.fitted.cost > THIRDS.least_second) {
        if out.is_empty() {
            progress("looking for a third effect");
        }
        let (h2, e2) = (&pair.hypothesis, &pair.fitted.point.effects);
        let base = begin(problem, h2, &origin.point, e2, origin);
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
            let start = begin(problem, &h, &origin.point, &start, origin);
            out.push(refit(problem, h, start, FINALISTS.steps, None));
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

#[cfg(test)]
mod tests {
    use robot_model::tunable::tunables;
    use testing::robot;

    use super::*;
    use crate::testing::{cutting, driven, problem};
    use crate::windows::cut;
    use inference::hypothesis::{Dose, Place, Variant};

    #[test]
    fn two_effects_that_fit_worse_than_one_of_them_are_fitted_again_and_a_loose_constant_becomes_its_effect() {
        let robot = robot();
        let blank = problem(&robot, &[]);
        let of = |id: &str| -> Variant {
            let is_whole = |v: &Variant| v.spec().id == id && v.place == Place::Whole;
            blank.variants().into_iter().find(is_whole).expect("in the catalogue")
        };
        let (drag, viscous) = (of("quadratic_drag"), of("viscous_friction"));
        let size = |v: &Variant| v.free(&blank.sizes())[0].usual;
        let doses: Vec<Dose> = vec![drag.dose(&[size(&drag)], None), viscous.dose(&[size(&viscous)], None)];
        let cuts = [16.0, 20.0].map(|seconds| cut(&driven(&robot, &doses, seconds), &cutting()));
        let loose = Problem { constants_are_loose: true, ..problem(&robot, &cuts) };

        // One effect, beside which the constant of the other has moved.
        let single = Hypothesis::single(drag, Vec::new());
        let start = loose.begin(&single, Point { effects: vec![size(&drag)], ..loose.origin() }, None);
        let single = Trial { fitted: retune(&loose, &single, start), hypothesis: single };
        let viscous_at = tunables::<f64>().iter().position(|t| t.id == "viscous").expect("tunable");
        assert!(single.fitted.point.theta[viscous_at] > 1.6, "{:?}", single.fitted.point.theta);

        // Both, as a fit that went astray left them.
        let both = Hypothesis { parts: vec![(drag, Vec::new()), (viscous, Vec::new())], acting: None };
        let astray = loose.begin(&both, Point { effects: vec![0.0, 0.0], ..loose.origin() }, None);
        assert!(astray.cost > single.fitted.cost);
        let mut wholes = vec![Trial { hypothesis: both, fitted: astray }];
        converge_wholes(&loose, &single, &mut wholes);
        assert!(wholes[0].fitted.cost <= single.fitted.cost, "{} {}", wholes[0].fitted.cost, single.fitted.cost);

        // The same pair is found where nobody tried it, and not where constants are known.
        let mut none = Vec::new();
        converge_wholes(&loose, &single, &mut none);
        let found: Vec<_> = none.iter().map(|t| t.hypothesis.ids()).collect();
        assert!(found.contains(&vec!["quadratic_drag", "viscous_friction"]), "{found:?}");
        let mut none = Vec::new();
        converge_wholes(&problem(&robot, &cuts), &single, &mut none);
        assert!(none.is_empty());
    }
}
