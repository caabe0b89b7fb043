//! From fits to probabilities.

use inference::evidence::{logistic, none_of, probabilities};

use crate::decision::{Decision, Scored};
use crate::fit::{Fitted, Hypothesis, Problem};
use crate::level::Level;
use crate::null_scores::NullScores;
use crate::prices::{all_matter, penalties, penalty, penalty_of_form};
use crate::settings::decision::{Prices, SETTINGS, Unknown};
use crate::stand_in::StandIn;
use crate::structure::Structure;
use crate::trial::{SearchResult, Trial};
use crate::{stand_in, visits};
use inference::hypothesis::Variant;

const PRICES: Prices = SETTINGS.prices;
const UNKNOWN: Unknown = SETTINGS.unknown;

/// What an effect that is a constant under another name gets back of its price where constants are loose, nats: all but
/// `½ z²` at the sigmas `z` from which on it is named. A single effect does so without references only, since "nothing" has
/// its own constants that moved otherwise.
///
/// What the motion gains is less than it seems, since residuals are correlated and the plant's laws are not the robot's;
/// hence the price. What a constant gains that may stay where the robot file has it is as much as the file says.
fn relief_counts(problem: &Problem<'_>, found: &SearchResult, trial: &Trial) -> f64 {
    if !problem.constants_are_loose {
        return 0.0;
    }
    let named_at = 0.5 * PRICES.named_from.powi(2);
    let is_most = |without: &Fitted| {
        let relief = problem.prior(&without.point) - problem.prior(&trial.fitted.point);
        relief > PRICES.most * (without.cost - trial.fitted.cost)
    };
    let is_constant = |v: &Variant| StandIn::of(v, problem.robot).is_some();
    let parts = trial.hypothesis.parts.as_slice();
    if let [(variant, _)] = parts {
        let counts = !problem.has_references && is_constant(variant) && is_most(&found.retuned);
        return if counts { PRICES.none + PRICES.per_effect - named_at } else { 0.0 };
    }
    let effects = &trial.fitted.point.effects;
    let without = |part: &Variant| {
        let is_rest = |t: &&Trial| {
            t.hypothesis.parts.len() + 1 == parts.len()
                && trial.hypothesis.values_of(&t.hypothesis, effects).is_some()
                && t.hypothesis.variants().all(|other| other.label() != part.label())
        };
        found.singles.iter().chain(&found.several).find(is_rest)
    };
    let is_relieved = |part: &Variant| is_constant(part) && without(part).is_some_and(|rest| is_most(&rest.fitted));
    if trial.hypothesis.variants().any(is_relieved) { PRICES.second + PRICES.per_effect - named_at } else { 0.0 }
}

/// Cost that a fault-free drive of these segments would have: each as far from its expectation as
/// the references' segments are from theirs, on average.
pub(crate) fn fault_free_cost(problem: &Problem<'_>, scatter: &[f64]) -> f64 {
    let usual = [1.0];
    let scatter = if scatter.is_empty() { &usual } else { scatter };
    let mut f = 0.0;
    for (r, cut) in problem.cuts.iter().enumerate() {
        for (s, segment) in cut.segments.iter().enumerate() {
            let cost = |x: &f64| problem.segment_cost(r, s, segment.count * problem.regime[r][s] * x);
            f += scatter.iter().map(cost).sum::<f64>() / scatter.len() as f64;
        }
    }
    f
}

/// What gains are divided by: how much more the best hypothesis leaves than a fault-free drive would, where it is more. What no
/// hypothesis explains is no noise of the size that the references showed, and what little one gains beside it says little
/// (dispersion of a quasi-likelihood: McCullagh and Nelder, *Generalized Linear Models*, 9.2; in metrology Birge's ratio).
fn dispersion(best: f64, fault_free: f64) -> f64 {
    (best / fault_free.max(1e-9)).max(1.0)
}

/// Weighs all hypotheses.
///
/// `scatter`: of the references' segments about their regimes; `null_scores`: what fault-free drives reach.
pub(crate) fn decide(
    problem: &Problem<'_>,
    found: &SearchResult,
    scatter: &[f64],
    null_scores: &NullScores,
) -> Decision {
    let base: &Fitted = &found.retuned;
    let fault_free = fault_free_cost(problem, scatter);
    let sizes = problem.sizes();
    let segments = problem.cuts.iter().map(|cut| cut.segments.len()).sum();
    // What is not told explains nothing: it counts neither as a hypothesis nor for what the best of them leaves.
    let weighed = || {
        let fits = found.singles.iter().chain(&found.several);
        fits.filter(|t| all_matter(&t.hypothesis, &t.fitted.point.effects, &sizes))
    };
    let best = weighed().map(|t| t.fitted.cost).fold(base.cost, f64::min);
    let dispersion = dispersion(best, fault_free);
    let mut scored: Vec<Scored> = weighed()
        .map(|t| {
            let visits = visits::supporting(problem, base, t);
            let once = if visits.is_some_and(|n| n < SETTINGS.visits.needed) { PRICES.one_visit } else { 0.0 };
            let effects = &t.fitted.point.effects;
            let form = if problem.has_references { 0.0 } else { penalty_of_form(&t.hypothesis, effects, &sizes) };
            let price = penalty(&t.hypothesis, effects, &sizes) + once + form;
            // What fault-free drives gain by a constant under another name is taken by that constant, where it may have moved.
            let is_constant = |v: &Variant| StandIn::of(v, problem.robot).is_some();
            let may_have_moved = problem.constants_are_loose && t.hypothesis.variants().all(is_constant);
            let usual = if may_have_moved { 0.0 } else { null_scores.gain(&t.hypothesis, segments) };
            let score = (base.cost - t.fitted.cost - usual) / dispersion - price + relief_counts(problem, found, t);
            Scored { trial: t.clone(), visits, score, probability: 0.0 }
        })
        .collect();
    scored.sort_by(|a, b| b.score.total_cmp(&a.score));
    let none = PRICES.none.max(null_scores.highest());
    let excess = (best / fault_free.max(1e-9)).ln();
    let left = (best - fault_free) / (base.cost - fault_free).max(UNKNOWN.least_mismatch);
    let worse = logistic(UNKNOWN.excess_slope * (excess - UNKNOWN.excess_centre));
    let has_several = scored.first().is_some_and(|s| s.trial.hypothesis.parts.len() > 1);
    let of_one = [UNKNOWN.left_slope, UNKNOWN.left_centre];
    let [slope, centre] = if has_several { UNKNOWN.left_of_several } else { of_one };
    let by_level = worse * logistic(slope * (left - centre));
    let nearest = scored.first().map_or(base, |s| &s.trial.fitted);
    let form = (!problem.has_references).then(|| Structure::of(problem, &nearest.response));
    let unknown = 1.0 - none_of([by_level, form.map_or(0.0, Structure::is_no_noise)]);
    // "Unknown" is weighed first: what is left is shared among "nothing" and the hypotheses.
    let instead = moved_instead(problem, &scored);
    let alone = instead.iter().filter(|i| i.owner.is_none() && i.score > none);
    let moved = alone.max_by(|a, b| a.score.total_cmp(&b.score)).map(|i| scored[i.trial].trial.clone());
    let owners: Vec<(Option<usize>, f64)> = std::iter::once((None, none))
        .chain(scored.iter().enumerate().map(|(i, s)| (Some(i), s.score)))
        .chain(instead.iter().map(|i| (i.owner, i.score)))
        .collect();
    let scores: Vec<f64> = owners.iter().map(|(_, score)| *score).collect();
    let mut nothing = 0.0;
    for ((owner, _), share) in owners.iter().zip(probabilities(&scores, PRICES.temperature)) {
        match owner {
            Some(i) => scored[*i].probability += (1.0 - unknown) * share,
            None => nothing += (1.0 - unknown) * share,
        }
    }
    let named: f64 = scored.iter().map(|s| s.probability).sum();
    let told = scored.first().filter(|_| named > nothing).map_or(base, |s| &s.trial.fitted);
    let level = Level { as_it_is: found.as_it_is, fitted: told.cost, fault_free, is_unknown: by_level };
    Decision { scored, none: nothing, unknown, level, form, moved, ..Decision::default() }
}

/// A hypothesis in which a constant that moved since the references stands for one of the effects of a fit.
struct Instead {
    /// The fit, by its place.
    trial: usize,
    /// The fit with the remaining effects, whose probability this adds to; `None` for "nothing is missing".
    owner: Option<usize>,
    score: f64,
}

/// Every hypothesis in which a constant that may have moved takes the place of an effect; none without references.
fn moved_instead(problem: &Problem<'_>, scored: &[Scored]) -> Vec<Instead> {
    if !problem.has_references {
        return Vec::new();
    }
    let labels = |h: &Hypothesis| h.variants().map(Variant::label).collect::<Vec<_>>();
    let mut out = Vec::new();
    for (trial, s) in scored.iter().enumerate() {
        let own = penalties(&s.trial.hypothesis, &s.trial.fitted.point.effects, &problem.sizes());
        for (part, price) in stand_in::instead(problem, &s.trial) {
            let mut rest = s.trial.hypothesis.clone();
            rest.parts.remove(part);
            // The effect that comes first pays no price of a second one; what remains of two effects is one.
            let second = if part == 0 && !rest.parts.is_empty() { PRICES.second } else { 0.0 };
            let score = s.score + own[part] + second - price;
            if rest.parts.is_empty() {
                out.push(Instead { trial, owner: None, score });
            } else if !problem.constants_are_loose {
                // Loose constants have moved in the fit of the rest already.
                let rest = labels(&rest);
                let owner = scored.iter().position(|o| labels(&o.trial.hypothesis) == rest);
                out.extend(owner.map(|i| Instead { trial, owner: Some(i), score }));
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{cutting, driven, problem};
    use crate::windows::cut;
    use inference::hypothesis::Place;
    use testing::robot;

    #[test]
    fn without_any_hypothesis_a_fault_free_drive_has_nothing_missing() {
        let robot = robot();
        let cuts = [cut(&driven(&robot, &[], 12.0), &cutting())];
        let problem = problem(&robot, &cuts);
        let retuned = problem.begin(&Hypothesis::default(), problem.origin(), None);
        let found = SearchResult {
            as_it_is: retuned.cost,
            retuned,
            singles: Vec::new(),
            several: Vec::new(),
            screened: Vec::new(),
        };
        let decision = decide(&problem, &found, &[1.0], &NullScores::default());
        assert!(decision.scored.is_empty());
        assert!(decision.none > 0.9, "none {}", decision.none);
        approx::assert_relative_eq!(decision.none + decision.unknown, 1.0, epsilon = 1e-12);
    }

    #[test]
    fn a_second_effect_that_matters_to_nobody_is_not_weighed_and_a_single_one_from_less_than_half_of_that_on() {
        let robot = robot();
        let cuts = [cut(&driven(&robot, &[], 12.0), &cutting())];
        let problem = problem(&robot, &cuts);
        let of = |id: &str| {
            let is_it = |v: &Variant| v.spec().id == id && v.place == Place::Whole;
            problem.variants().into_iter().find(is_it).expect("in the catalogue")
        };
        let (drag, rolling) = (of("quadratic_drag"), of("rolling_resistance"));
        let [of_drag, of_rolling] = [drag, rolling].map(|v| problem.sizes().interest(v.spec()));
        let both = Hypothesis { parts: vec![(drag, Vec::new()), (rolling, Vec::new())], acting: None };
        let matter = |h: &Hypothesis, effects: &[f64]| all_matter(h, effects, &problem.sizes());
        assert!(matter(&both, &[2.0 * of_drag, -1.1 * of_rolling]));
        assert!(!matter(&both, &[2.0 * of_drag, -0.9 * of_rolling]));
        let alone = Hypothesis::single(rolling, Vec::new());
        assert!(matter(&alone, &[0.5 * of_rolling]) && !matter(&alone, &[0.3 * of_rolling]));
    }

    /// A fit of an effect everywhere that gained so many nats, without having been fitted.
    fn gained(problem: &Problem<'_>, retuned: &Fitted, id: &str, gain: f64) -> Trial {
        let form = problem.variants().into_iter().find(|v| v.spec().id == id && v.place == Place::Whole);
        let hypothesis = Hypothesis::single(form.expect("in the catalogue"), Vec::new());
        let effects = hypothesis.free(&problem.sizes()).iter().map(|f| f.usual).collect();
        let mut fitted = retuned.clone();
        fitted.point.effects = effects;
        fitted.cost -= gain;
        Trial { hypothesis, fitted }
    }

    #[test]
    fn what_is_gained_beside_much_that_stays_counts_less() {
        let robot = robot();
        let cuts = [cut(&driven(&robot, &[], 12.0), &cutting())];
        let problem = problem(&robot, &cuts);
        let usual = fault_free_cost(&problem, &[1.0]);
        let score = |left: f64| {
            let mut retuned = problem.begin(&Hypothesis::default(), problem.origin(), None);
            retuned.cost = left + 24.0;
            let singles = vec![gained(&problem, &retuned, "quadratic_drag", 24.0)];
            let (as_it_is, several, screened) = (retuned.cost, Vec::new(), Vec::new());
            decide(
                &problem,
                &SearchResult { as_it_is, retuned, singles, several, screened },
                &[1.0],
                &NullScores::default(),
            )
            .scored[0]
                .score
        };
        approx::assert_relative_eq!(score(0.5 * usual), score(usual), epsilon = 1e-9);
        approx::assert_relative_eq!(score(usual) - score(3.0 * usual), 24.0 - 8.0, epsilon = 1e-9);
    }

    #[test]
    fn two_effects_that_leave_a_third_are_unknown_and_one_that_does_is_not() {
        let robot = robot();
        let cuts = [cut(&driven(&robot, &[], 12.0), &cutting())];
        let problem = problem(&robot, &cuts);
        let usual = fault_free_cost(&problem, &[1.0]);
        let mut retuned = problem.begin(&Hypothesis::default(), problem.origin(), None);
        retuned.cost = 8.0 * usual + 60.0;
        let gain = 2.0 / 3.0 * (retuned.cost - usual);
        let single = gained(&problem, &retuned, "quadratic_drag", gain);
        let mut pair = single.clone();
        let other = gained(&problem, &retuned, "constant_pull", gain);
        pair.hypothesis.parts.extend(other.hypothesis.parts);
        pair.fitted.point.effects.extend(other.fitted.point.effects.iter().map(|size| 3.0 * size));
        pair.fitted.point.effects[0] *= 3.0;
        let unknown = |singles: Vec<Trial>, several: Vec<Trial>| {
            let (as_it_is, retuned, screened) = (retuned.cost, retuned.clone(), Vec::new());
            let found = SearchResult { as_it_is, retuned, singles, several, screened };
            decide(&problem, &found, &[1.0], &NullScores::default()).unknown
        };
        assert!(unknown(vec![single], Vec::new()) < 0.2);
        assert!(unknown(Vec::new(), vec![pair]) > 0.6);
    }

    #[test]
    fn probabilities_of_all_hypotheses_sum_to_one_and_follow_the_scores() {
        let robot = robot();
        let cuts = [cut(&driven(&robot, &[], 12.0), &cutting())];
        let problem = problem(&robot, &cuts);
        let mut retuned = problem.begin(&Hypothesis::default(), problem.origin(), None);
        retuned.cost += 100.0;
        // No constant stands for either.
        let singles = ["quadratic_drag", "constant_pull"].map(|id| gained(&problem, &retuned, id, 24.0));
        let found = SearchResult {
            as_it_is: retuned.cost,
            retuned,
            singles: singles.to_vec(),
            several: Vec::new(),
            screened: Vec::new(),
        };
        let decision = decide(&problem, &found, &[1.0], &NullScores::default());

        let named: f64 = decision.scored.iter().map(|s| s.probability).sum();
        approx::assert_relative_eq!(named + decision.none + decision.unknown, 1.0, epsilon = 1e-12);
        for s in &decision.scored {
            let odds = ((s.score - PRICES.none) / PRICES.temperature).exp();
            approx::assert_relative_eq!(s.probability / decision.none, odds, epsilon = 1e-9);
        }
        // How much is left says why the cause is unknown.
        let level = Level { as_it_is: 500.0, fitted: 140.0, fault_free: 100.0, is_unknown: 0.8 };
        let told = Decision { level, ..decision.clone() }.with_level(level);
        assert!(
            (told.unknown - 0.8).abs() < 1e-12
                && told.why_unknown("It", true).is_some_and(|why| why.starts_with("It is off by 1.2 times"))
        );
        // The score that fault-free drives reach is the least that names anything.
        let reached = NullScores { of_references: vec![("payload".to_owned(), 100.0)], ..NullScores::default() };
        let strict = decide(&problem, &found, &[1.0], &reached);
        assert!(strict.none > 0.99 * (1.0 - strict.unknown), "{}", strict.none);
    }

    #[test]
    fn a_constant_that_may_have_moved_takes_from_a_small_effect_and_not_from_a_large_one() {
        let robot = robot();
        let cuts = [cut(&driven(&robot, &[], 12.0), &cutting())];
        let problem = problem(&robot, &cuts);
        let mut retuned = problem.begin(&Hypothesis::default(), problem.origin(), None);
        retuned.cost += 100.0;
        let named = |size: f64| {
            let mut single = gained(&problem, &retuned, "torque_constant", 60.0);
            single.fitted.point.effects = vec![size];
            let several = Vec::new();
            let found = SearchResult {
                as_it_is: retuned.cost,
                retuned: retuned.clone(),
                singles: vec![single],
                several,
                screened: Vec::new(),
            };
            decide(&problem, &found, &[1.0], &NullScores::default()).scored[0].probability
        };
        assert!(named(0.023) < 0.5, "{}", named(0.023));
        assert!(named(0.2) > 0.9, "{}", named(0.2));
    }

    #[test]
    fn without_references_an_effect_that_is_a_constant_is_named_from_so_many_of_its_sigmas_on() {
        let robot = robot();
        let cuts = [cut(&driven(&robot, &[], 12.0), &cutting())];
        let problem = Problem { has_references: false, constants_are_loose: true, ..problem(&robot, &cuts) };
        let at = crate::run_numbers::constant("viscous");
        let named = |id: &str, sigmas: f64| {
            let mut point = problem.origin();
            point.theta[at] += sigmas;
            let mut retuned = problem.begin(&Hypothesis::default(), point, None);
            // The motion is the same with the constant where the file has it and the effect beside it: nothing else is left.
            retuned.cost = 0.5 * sigmas * sigmas;
            let mut single = gained(&problem, &retuned, id, 0.5 * sigmas * sigmas);
            single.fitted.point.theta = problem.origin().theta;
            let several = Vec::new();
            let found =
                SearchResult { as_it_is: retuned.cost, retuned, singles: vec![single], several, screened: Vec::new() };
            let decision = decide(&problem, &found, &[1.0], &NullScores::default());
            decision.scored[0].probability > decision.none
        };
        assert!(!named("viscous_friction", 3.5) && named("viscous_friction", 3.9));
        assert!(!named("constant_pull", 3.9), "no constant is a pull: it pays in full");
    }
}
