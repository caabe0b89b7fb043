//! Which causes the sessions ask for.

use nalgebra::DMatrix;

use crate::cause::{Cause, Possible};
use crate::settings::SETTINGS;
use crate::weigh::{Evidence, Posterior};
use inference::evidence::{is_within_odds, log_sum_exp, logistic};

/// A cause with what speaks for it.
#[derive(Debug, Clone, PartialEq)]
pub struct Weighed {
    /// Index among the causes.
    pub cause: usize,
    /// Probability that it is part of the truth.
    pub probability: f64,
    /// Causes that stand for it within the odds, itself first.
    pub class: Vec<usize>,
}

/// What was named.
#[derive(Debug, Clone)]
pub struct Named {
    /// Causes that were named, most probable first.
    pub chosen: Vec<Weighed>,
    /// Probability of every cause that was not.
    pub others: Vec<(usize, f64)>,
    /// Constants with these causes.
    pub posterior: Posterior,
    /// Constants with none.
    pub retuned: Posterior,
    /// Constants with the best wrong cause in the place of the first.
    pub placebo: Option<(usize, Posterior)>,
    /// The cause of the placebo, where it is little less probable than the first.
    pub rival: Option<usize>,
}

/// Names causes by evidence: one joins while its log odds pass the threshold, and leaves when it no longer earns its place.
pub fn name(evidence: &Evidence, known: &DMatrix<f64>, causes: &[Cause]) -> Option<Named> {
    name_from(evidence, known, causes, &[])
}

/// The same from causes that are there already.
pub fn name_from(evidence: &Evidence, known: &DMatrix<f64>, causes: &[Cause], already: &[usize]) -> Option<Named> {
    let rules = SETTINGS.naming;
    let score = |set: &[usize]| score(evidence, known, causes, set).unwrap_or(f64::NEG_INFINITY);
    let mut set: Vec<usize> = already.to_vec();
    let mut current = score(&set);
    loop {
        // What joined may stand for what was there.
        while let Some((without, c)) = set
            .iter()
            .map(|&c| (score(&less(&set, c)), c))
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .filter(|(without, _)| current - without + rules.odds <= rules.named)
        {
            set = less(&set, c);
            current = without;
        }
        if set.len() >= rules.most {
            break;
        }
        let open = (0..causes.len()).filter(|c| !set.contains(c));
        let joined = open.map(|c| (score(&with(&set, c)), c)).max_by(|a, b| a.0.total_cmp(&b.0));
        let Some((best, cause)) = joined.filter(|(best, _)| best - current + rules.odds > rules.named) else { break };
        set.push(cause);
        current = best;
    }
    named_as(evidence, known, causes, &set)
}

/// The first of several causes that stand for each other, none of which earns its place alone and all of which do together: one
/// of them is there, and the evidence does not say which.
pub fn of_class(evidence: &Evidence, known: &DMatrix<f64>, causes: &[Cause]) -> Option<Named> {
    let rules = SETTINGS.naming;
    let score = |set: &[usize]| score(evidence, known, causes, set).unwrap_or(f64::NEG_INFINITY);
    let scores: Vec<f64> = (0..causes.len()).map(|c| score(&[c])).collect();
    let best = (0..causes.len()).max_by(|a, b| scores[*a].total_cmp(&scores[*b]))?;
    let stands_for_it = |c: &usize| {
        let adds = score(&with(&[best], *c)) - scores[best] + rules.odds;
        *c == best || (is_within_odds(scores[*c], scores[best], rules.alike) && adds < 0.0)
    };
    let class: Vec<f64> = (0..causes.len()).filter(stands_for_it).map(|c| scores[c]).collect();
    let together = log_sum_exp(&class) - score(&[]) + rules.odds;
    if together > rules.named { named_as(evidence, known, causes, &[best]) } else { None }
}

/// The same of a set of causes that is given.
pub fn named_as(evidence: &Evidence, known: &DMatrix<f64>, causes: &[Cause], set: &[usize]) -> Option<Named> {
    let rules = SETTINGS.naming;
    let score = |set: &[usize]| score(evidence, known, causes, set).unwrap_or(f64::NEG_INFINITY);
    let current = score(set);
    let mut chosen: Vec<Weighed> = Vec::new();
    for &cause in set {
        let rest = less(set, cause);
        let log_odds = current - score(&rest) + rules.odds;
        let mut rivals: Vec<(f64, usize)> = (0..causes.len())
            .filter(|c| !set.contains(c))
            .map(|c| (score(&with(&rest, c)), c))
            .filter(|(other, _)| is_within_odds(*other, current, rules.alike))
            .collect();
        rivals.sort_by(|a, b| b.0.total_cmp(&a.0));
        let class = std::iter::once(cause).chain(rivals.into_iter().map(|(_, c)| c)).collect();
        chosen.push(Weighed { cause, probability: logistic(log_odds), class });
    }
    // The first is that which the data would miss most.
    let missed = |w: &Weighed| current - score(&less(set, w.cause));
    chosen.sort_by(|a, b| missed(b).total_cmp(&missed(a)));
    let stands_in = |c: usize| chosen.iter().any(|w| w.class.contains(&c));
    let others = (0..causes.len())
        .filter(|c| !stands_in(*c))
        .map(|c| (c, logistic(score(&with(set, c)) - current + rules.odds)))
        .collect();
    let placebo = chosen.first().and_then(|first| {
        let rest = less(set, first.cause);
        let wrong = (0..causes.len()).filter(|c| !set.contains(c) && !first.class.contains(c));
        let (score, best) = wrong.map(|c| (score(&with(&rest, c)), c)).max_by(|a, b| a.0.total_cmp(&b.0))?;
        Some((score, best, evidence.posterior(&covariance(known, causes, &with(&rest, best)))?))
    });
    let rival = placebo.as_ref().filter(|(score, ..)| *score > current - rules.near);
    let rival = rival.map(|(_, cause, _)| *cause);
    let placebo = placebo.map(|(_, cause, posterior)| (cause, posterior));
    Some(Named {
        posterior: evidence.posterior(&covariance(known, causes, set))?,
        retuned: evidence.posterior(known)?,
        chosen,
        others,
        placebo,
        rival,
    })
}

/// Causes that could stand for one of a set, the best first, with their evidence in its place less that of the set, nats.
pub fn stand_ins(
    evidence: &Evidence,
    known: &DMatrix<f64>,
    causes: &[Cause],
    (set, cause): (&[usize], usize),
) -> Vec<(usize, f64)> {
    let rest = less(set, cause);
    let own = score(evidence, known, causes, set).unwrap_or(f64::NEG_INFINITY);
    let others = (0..causes.len()).filter(|c| !set.contains(c));
    let mut out: Vec<(usize, f64)> =
        others.filter_map(|c| Some((c, score(evidence, known, causes, &with(&rest, c))? - own))).collect();
    out.sort_by(|a, b| b.1.total_cmp(&a.1));
    out
}

/// Evidence of a set of causes, nats; `None` where a constant would lie outside of what it can be by more than its sigma: about
/// such a fit its other numbers mean nothing, whatever they gain. The prior of such a constant is the part of the Gaussian within
/// its range, which multiplies the evidence by the posterior's share in the range over the prior's.
pub(crate) fn score(evidence: &Evidence, known: &DMatrix<f64>, causes: &[Cause], set: &[usize]) -> Option<f64> {
    let covariance = covariance(known, causes, set);
    let gaussian = evidence.of(&covariance)?;
    let ranges: Vec<Possible> = set.iter().filter_map(|&c| causes[c].possible).collect();
    if ranges.is_empty() {
        return Some(gaussian);
    }
    let posterior = evidence.posterior(&covariance)?;
    let of_range = |range: Possible| {
        let k = range.constant;
        let before = range.probability(evidence.mean()[k], covariance[(k, k)]);
        let after = range.probability(posterior.mean[k], posterior.covariance[(k, k)]);
        range.may_hold(&posterior).then(|| (after / before.max(f64::MIN_POSITIVE)).ln())
    };
    ranges.into_iter().try_fold(gaussian, |sum, range| Some(sum + of_range(range)?))
}

pub(crate) fn with(set: &[usize], cause: usize) -> Vec<usize> {
    set.iter().copied().chain([cause]).collect()
}

pub(crate) fn less(set: &[usize], cause: usize) -> Vec<usize> {
    set.iter().copied().filter(|c| *c != cause).collect()
}

/// What is known of the constants where these causes may be there.
pub fn covariance(known: &DMatrix<f64>, causes: &[Cause], set: &[usize]) -> DMatrix<f64> {
    let mut out = known.clone();
    for (direction, usual) in set.iter().flat_map(|&c| &causes[c].directions) {
        for &(i, a) in direction {
            for &(j, b) in direction {
                out[(i, j)] += usual * usual * a * b;
            }
        }
    }
    out
}
