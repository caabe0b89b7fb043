//! Causes that do much the same as those that were named, each by a fit of its own.

use inference::evidence::logistic;
use nalgebra::DVector;

use crate::answered::{Answered, is_moved, scores};
use crate::cause::Cause;
use crate::data::{Data, Prior};
use crate::fit::{Fit, fit_like, likelier};
use crate::name::{named_as, stand_ins};
use crate::observed::Observed;
use crate::settings::SETTINGS;
use crate::weigh::Evidence;

/// The same with others that may stand for its first causes, each by a fit of its own: about a fit with one of two causes that do
/// much the same, the equations, which are straight lines, leave too much to the other one.
///
/// Another one that leaves hardly more of the errors is hard to tell from it: evidence counts all errors as noise, and laws of tyres
/// and servos are not known that well. Of such two that leads which asks the constants for far fewer sigmas of what is known.
pub(crate) fn exchanged<D: Observed>(
    data: &Data<D>,
    prior: &Prior,
    causes: &[Cause],
    retuned: &Fit,
    mut best: Answered,
) -> Option<Answered> {
    let rules = SETTINGS.naming;
    let lines = |fit: &Fit| Evidence::new(&fit.theta, &fit.sessions, &data.scatter(fit.factor), &prior.mean);
    let first: Vec<usize> = best.named.chosen.iter().take(rules.exchanged).map(|w| w.cause).collect();
    // A later exchange names anew; what cannot be told from an earlier cause is kept beside it.
    let mut classes: Vec<(usize, Vec<usize>)> = Vec::new();
    for cause in first {
        let set: Vec<usize> = best.named.chosen.iter().map(|w| w.cause).collect();
        let fitted = |with: Vec<usize>| {
            let narrow = prior.with(causes, &with);
            let ends = data.bounded(&lines(retuned)?.posterior(&narrow.covariance)?).as_slice().to_vec();
            let start = likelier(data, &narrow, retuned, [retuned.theta.clone(), ends])?;
            let fit = fit_like(data, &narrow, start, &best.fit)?;
            let mut named = named_as(&lines(&fit)?, &prior.covariance, causes, &with)?;
            named.posterior.mean = DVector::from_column_slice(&fit.theta);
            Some(Answered { fit, named, set: with })
        };
        // By the equations about the re-tuned car and about the answer: the one knows no cause yet, the other too much of its own.
        let mut candidates: Vec<usize> = Vec::new();
        for fit in [retuned, &best.fit] {
            let own = stand_ins(&lines(fit)?, &prior.covariance, causes, (&set, cause));
            let near = own.into_iter().filter(|(_, by)| *by > -rules.near_enough);
            candidates.extend(near.map(|(c, _)| c).take(rules.stand_ins));
        }
        candidates.sort_unstable();
        candidates.dedup();
        let others: Vec<(usize, Answered)> = candidates
            .into_iter()
            .filter_map(|c| Some((c, fitted(set.iter().map(|&s| if s == cause { c } else { s }).collect())?)))
            .collect();

        let own = data.share(&best.fit.theta);
        let mut alike: Vec<(f64, usize, Answered)> = Vec::new();
        for (candidate, other) in others {
            // What does not move stands for nothing: re-tuning does it.
            if sigmas(prior, &other, causes[candidate].moves()) < rules.moved_as_stand_in {
                continue;
            }
            let [of_other, of_best] = scores(data, prior, causes, [&other, &best]);
            let leaves_as_much = data.share(&other.fit.theta) < (1.0 + rules.leaves_more) * own;
            let odds = if leaves_as_much { rules.alike_by_errors } else { rules.alike };
            if of_other > of_best - odds {
                alike.push((of_other - of_best, candidate, other));
            }
        }
        alike.sort_by(|a, b| b.0.total_cmp(&a.0));
        let asked = |answer: &Answered, candidate: usize| {
            sigmas(prior, answer, causes[cause].moves().into_iter().chain(causes[candidate].moves()))
        };
        let may_lead = |(by, candidate, other): &(f64, usize, Answered)| {
            let far = [&best, other].map(|answer| asked(answer, *candidate));
            let own = other.named.chosen.iter().find(|w| w.cause == *candidate);
            own.is_some_and(|w| leads(*by, far, w.probability))
                && is_moved(&causes[*candidate], prior, &other.named.posterior)
        };
        let leader = alike.iter().position(may_lead);
        let mut class: Vec<usize> = alike.iter().map(|(_, c, _)| *c).collect();
        let mut leads = cause;
        if let Some(k) = leader {
            (_, leads, best) = alike.swap_remove(k);
            class.retain(|c| *c != leads);
            class.push(cause);
        }
        classes.push((leads, class));
    }
    let chosen: Vec<usize> = best.named.chosen.iter().map(|w| w.cause).collect();
    for (cause, mut class) in classes {
        class.retain(|c| !chosen.contains(c));
        if let Some(own) = best.named.chosen.iter_mut().find(|w| w.cause == cause) {
            let new = class.into_iter().filter(|c| !own.class.contains(c)).collect::<Vec<_>>();
            own.class.extend(new);
        }
    }
    Some(best)
}

/// By how many sigmas of what was known these constants moved, the most of them.
pub(crate) fn sigmas(prior: &Prior, answer: &Answered, constants: impl IntoIterator<Item = usize>) -> f64 {
    let of = |k: usize| (answer.fit.theta[k] - prior.mean[k]).abs() / prior.covariance[(k, k)].sqrt();
    constants.into_iter().map(of).fold(0.0, f64::max)
}

/// Whether a look-alike leads in the place of a cause: by so many nats of evidence, where the answers with the cause and with it ask
/// the constants for so many sigmas of what is known; with the probability that it is there. What would not be named for itself leads
/// nothing.
fn leads(by: f64, [own, other]: [f64; 2], probability: f64) -> bool {
    let rules = SETTINGS.naming;
    let is_much_farther = rules.nearer * own < other && by < rules.alike_by_errors;
    let is_much_nearer = rules.nearer * other < own;
    probability > logistic(rules.named) && (is_much_nearer || (by > rules.alike && !is_much_farther))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_look_alike_leads_by_evidence_or_by_what_it_asks_for_and_never_where_it_would_not_be_named() {
        assert!(leads(8.0, [8.0, 10.0], 0.99));
        assert!(leads(-2.0, [52.0, 8.0], 0.99));
        assert!(!leads(2.0, [8.0, 10.0], 0.99), "neither");
        // A steering gain and axles 23 % farther apart, of which the owner is sure to 0.4 %.
        assert!(!leads(8.8, [7.9, 51.7], 0.99));
        assert!(leads(20.0, [7.9, 51.7], 0.99), "what the drives say outweighs the tape measure");
        assert!(!leads(-2.0, [52.0, 8.0], 0.376));
    }
}
