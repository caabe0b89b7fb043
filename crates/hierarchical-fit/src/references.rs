//! What references say before the recordings, and whether what the recordings are told to lack is there in the references, too.
//!
//! References name causes as well, of which only the constants are kept. Few drives may take one cause for another there: a bend of the
//! steering map for tyres that give way. The recordings, which show the tyres, would then be told to lack what all drives lack. So that
//! what is named in recordings is fitted to the references, and both answers are weighed by the evidence of all drives together.

use inference::evidence::logistic;
use nalgebra::{DMatrix, DVector};

use crate::answered::{Answered, scores, scores_of};
use crate::cause::Cause;
use crate::data::{Data, Prior};
use crate::fit::{Fit, fit};
use crate::name::named_as;
use crate::observed::Observed;
use crate::settings::SETTINGS;
use crate::solve::{about, answered, told};

/// What is known before the recordings.
pub(crate) struct Known {
    /// Of the constants.
    pub(crate) prior: Prior,
    /// Error that the best answer leaves of the references, as a share of their motion; `None` without any.
    pub(crate) left_of_references: Option<f64>,
    /// What references and recordings lack alike.
    pub(crate) in_all: Vec<usize>,
    /// The answer about the references.
    of_references: Option<Answered>,
}

/// What is known after references, or without any by the robot file alone.
pub(crate) fn known<D: Observed>(references: Option<&Data<D>>, of_file: Prior, causes: &[Cause]) -> Option<Known> {
    let Some(right) = references else {
        return Some(Known { prior: of_file, left_of_references: None, in_all: Vec::new(), of_references: None });
    };
    let (answer, retuned) = answered(right, &of_file, causes, of_file.mean.as_slice().to_vec())?;
    let set = answer.set.clone();
    let (fit, named) = told((right, &of_file, false), causes, answer, &retuned)?;
    // What is told may be no cause at all, though some were fitted.
    let own = if named.chosen.is_empty() {
        Answered { fit: retuned, named, set: Vec::new() }
    } else {
        Answered { fit, named, set }
    };
    Some(after(right, own))
}

/// What is known after references with this answer. What they may be told to lack is of no interest: constants and scatter are.
fn after<D: Observed>(right: &Data<D>, answer: Answered) -> Known {
    let variance = |sigma: DVector<f64>| DMatrix::from_diagonal(&sigma.component_mul(&sigma));
    let between = variance(right.scatter(answer.fit.factor)) + variance(right.between_visits());
    let of = &answer.named.posterior;
    Known {
        left_of_references: Some(right.share(of.mean.as_slice())),
        prior: Prior { mean: of.mean.clone(), covariance: &of.covariance + between },
        in_all: Vec::new(),
        of_references: Some(answer),
    }
}

/// The answer about recordings where what they are told to lack may be there in the references, too: the simpler answer where the drives
/// together speak for it; else what it would spare is at most as probable as they leave it.
pub(crate) fn weighed_with<D: Observed>(
    (data, right): (&Data<D>, &Data<D>),
    (of_file, causes): (&Prior, &[Cause]),
    mut known: Known,
    (mut best, retuned): (Answered, Fit),
) -> Option<(Known, Answered, Fit)> {
    let rules = SETTINGS.naming;
    let told: Vec<usize> = best.named.chosen.iter().map(|w| w.cause).collect();
    let Some(own) = known.of_references.take().filter(|_| !told.is_empty()) else {
        return Some((known, best, retuned));
    };

    let mut tried: Vec<(f64, Answered)> = Vec::new();
    for set in sets_of_references(&told, &own.set) {
        let start = best.fit.theta.clone();
        let Some(other) = fitted(right, of_file, causes, (start, set)) else { continue };
        let [of_other, of_own] = scores(right, of_file, causes, [&other, &own]);
        tried.push((of_other - of_own + rules.odds * (other.set.len() as f64 - own.set.len() as f64), other));
    }
    tried.sort_by(|a, b| b.0.total_cmp(&a.0));
    tried.truncate(rules.also_in_references);

    for (of_references, other) in tried {
        let set = other.set.clone();
        let anew = after(right, other);
        let (mut simpler, of_none) = answered(data, &anew.prior, causes, anew.prior.mean.as_slice().to_vec())?;
        if simpler.named.chosen.len() >= told.len() {
            continue;
        }
        let [of_simpler, of_best] = scores_of(data, causes, [(&simpler, &anew.prior), (&best, &known.prior)]);
        // The causes of the references are paid for already.
        let gained = gained_with_references(of_references + of_simpler - of_best, [simpler.set.len(), best.set.len()]);
        let named: Vec<usize> = simpler.named.chosen.iter().map(|w| w.cause).collect();
        let is_difference = logistic(-gained);
        if gained <= 0.0 {
            let spared = best.named.chosen.iter_mut().filter(|w| !named.contains(&w.cause));
            spared.for_each(|w| w.probability = w.probability.min(is_difference));
            continue;
        }
        let in_all: Vec<usize> = set.into_iter().filter(|c| told.contains(c) && !named.contains(c)).collect();
        let spared = simpler.named.others.iter_mut().filter(|(c, _)| in_all.contains(c));
        spared.for_each(|(_, p)| *p = p.max(is_difference));
        return Some((Known { in_all, ..anew }, simpler, of_none));
    }
    Some((known, best, retuned))
}

/// What an answer gains, nats, that has causes in references, too: by the evidence of all drives, after the price of the causes of either
/// answer, and of drives called right that lack something.
pub fn gained_with_references(evidence: f64, [simpler, best]: [usize; 2]) -> f64 {
    let rules = SETTINGS.naming;
    evidence + rules.odds * (simpler as f64 - best as f64) - rules.references_lack
}

/// Sets of causes that references may have: each that the recordings are told to lack, and all of them, alone and beside their own.
pub fn sets_of_references(told: &[usize], own: &[usize]) -> Vec<Vec<usize>> {
    let singles = told.iter().map(|&c| vec![c]);
    let mut out: Vec<Vec<usize>> = Vec::new();
    for set in singles.chain([told.to_vec()]) {
        for beside in [&[][..], own] {
            let mut set: Vec<usize> = set.iter().chain(beside).copied().collect();
            set.sort_unstable();
            set.dedup();
            if set != own && !out.contains(&set) {
                out.push(set);
            }
        }
    }
    out
}

/// References with these causes.
fn fitted<D: Observed>(
    right: &Data<D>,
    of_file: &Prior,
    causes: &[Cause],
    (start, set): (Vec<f64>, Vec<usize>),
) -> Option<Answered> {
    let wide = of_file.with(causes, &set);
    let fit = fit(right, &wide, start)?;
    let mut named = named_as(&about(right, of_file, &fit)?, &of_file.covariance, causes, &set)?;
    named.posterior.mean = DVector::from_column_slice(&fit.theta);
    Some(Answered { fit, named, set })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::observed::Spread;
    use crate::scaled::Scaled;
    use crate::solve::{Solved, solve};

    /// Recordings whose scale is 1.3, after a rough reference with another scale, of which the owner is sure to 3 %.
    fn solved(of_reference: f64) -> Solved<Scaled> {
        let spreads = vec![Spread { sigma: 0.03, usual: 1.0, scatter: 0.01, bounds: [-5.0, 5.0] }];
        let data = |drives: Vec<Scaled>| Data { model: (), spreads: spreads.clone(), drives };
        let recordings = data(vec![Scaled::by(1.3).roughly(0.01), Scaled::by(1.3).roughly(0.01)]);
        let reference = data(vec![Scaled::by(of_reference).roughly(0.25)]);
        let directions = vec![(vec![(0, 1.0)], 1.0)];
        let scale = Cause { spec: &catalogue::odometry::GYRO_SCALE, of: None, directions, possible: None };
        solve(recordings, Some(&reference), vec![scale]).expect("solved")
    }

    #[test]
    fn what_a_reference_alone_hardly_shows_is_no_difference_where_the_recordings_show_the_same() {
        let alike = solved(1.3);
        assert!(alike.named.chosen.is_empty(), "{:?}", alike.named.chosen);
        assert_eq!(alike.in_all, [0]);
        assert!(alike.lacking_in_all().is_some_and(|text| text.contains("heading_gyro_scale")));
    }

    #[test]
    fn what_a_reference_does_not_have_is_a_difference() {
        let changed = solved(1.0);
        assert_eq!(changed.named.chosen.len(), 1);
        assert!(changed.in_all.is_empty() && changed.lacking_in_all().is_none());
    }

    #[test]
    fn sets_for_references_hold_each_named_cause_alone_and_beside_their_own() {
        assert_eq!(sets_of_references(&[2], &[]), [[2]]);
        assert_eq!(sets_of_references(&[2], &[1]), [vec![2], vec![1, 2]]);
        assert_eq!(sets_of_references(&[3, 2], &[2]), [vec![3], vec![2, 3]], "the references' own set is none");
    }
}
