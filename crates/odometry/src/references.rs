//! What references say before the recordings, and whether they lack what the recordings are told to lack.
//!
//! As of [`hierarchical_fit`]: a reference may take slip in turns for another track, or not show it. What is named in recordings is fitted to
//! the references, too, and both answers are weighed by the evidence of all drives.

use hierarchical_fit::{
    Cause, Evidence, Named, Prior, covariance, gained_with_references, named_as, sets_of_references,
};
use inference::evidence::logistic;
use nalgebra::{DMatrix, DVector};

use crate::diagnose::weigh;
use crate::fit::{Factors, Fit, equations, fit, scatter};
use crate::said::share;
use crate::windows::Data;

/// What is known before the recordings, where there are references.
#[derive(Debug, Clone)]
pub(crate) struct Known {
    pub(crate) prior: Prior,
    /// Error that the best answer leaves of the references, as a share of their motion.
    pub(crate) left: f64,
    /// Causes that references and recordings lack alike.
    pub(crate) in_all: Vec<usize>,
}

/// An answer about drives: the fit, what is named, and the causes that were free.
struct Answered {
    fit: Fit,
    named: Named,
    set: Vec<usize>,
}

impl Answered {
    fn of((fit, named): (Fit, Named)) -> Self {
        let set = named.chosen.iter().map(|w| w.cause).collect();
        Self { fit, named, set }
    }
}

/// What is known after references by what they name of themselves. What they may be told to lack is of no interest: constants and
/// scatter are.
pub(crate) fn known(right: &Data<'_>, of_file: &Prior, causes: &[Cause]) -> Option<Known> {
    let (fit, named) = weigh(right, of_file, causes, vec![0.0; of_file.mean.len()])?;
    Some(after(right, fit.factors, &named))
}

fn after(right: &Data<'_>, factors: Factors, named: &Named) -> Known {
    let deviation = scatter(right, factors);
    let between = DMatrix::from_diagonal(&deviation.component_mul(&deviation));
    let of = &named.posterior;
    Known {
        prior: Prior { mean: of.mean.clone(), covariance: &of.covariance + between },
        left: share(right, &of.mean).1,
        in_all: Vec::new(),
    }
}

/// The answer about recordings where what they are told to lack may be there in the references, too: the simpler answer where the drives
/// together speak for it; else what it would spare is at most as probable as they leave it. `None` where nothing is simpler.
pub(crate) fn weighed_with(
    (data, right): (&Data<'_>, &Data<'_>),
    (of_file, prior, causes): (&Prior, &Prior, &[Cause]),
    (of_drives, named): (&Fit, &mut Named),
) -> Option<(Known, Fit, Named)> {
    let best = Answered::of((of_drives.clone(), named.clone()));
    if best.set.is_empty() {
        return None;
    }
    // Anew, for the recordings may have widened what counts as usual.
    let own = Answered::of(weigh(right, of_file, causes, vec![0.0; of_file.mean.len()])?);
    let mut tried: Vec<(f64, Answered)> = Vec::new();
    for set in sets_of_references(&best.set, &own.set) {
        let Some(other) = fitted(right, of_file, causes, (of_drives.theta.clone(), set)) else { continue };
        let by = scores(right, causes, [(&other, of_file), (&own, of_file)]);
        tried.push((by[0] - by[1], other));
    }
    tried.sort_by(|a, b| b.0.total_cmp(&a.0));

    for (of_references, other) in tried {
        let known = after(right, other.fit.factors, &other.named);
        let Some(answer) = weigh(data, &known.prior, causes, of_drives.theta.clone()) else { continue };
        let simpler = Answered::of(answer);
        if simpler.set.len() >= best.set.len() {
            continue;
        }
        let by = scores(data, causes, [(&simpler, &known.prior), (&best, prior)]);
        let counts = [other.set.len() + simpler.set.len(), own.set.len() + best.set.len()];
        let gained = gained_with_references(of_references + by[0] - by[1], counts);
        let is_spared = |cause: usize| !simpler.set.contains(&cause);
        if gained <= 0.0 {
            let spared = named.chosen.iter_mut().filter(|w| is_spared(w.cause));
            spared.for_each(|w| w.probability = w.probability.min(logistic(-gained)));
            continue;
        }
        let in_all = other.set.iter().copied().filter(|c| best.set.contains(c) && is_spared(*c)).collect();
        return Some((Known { in_all, ..known }, simpler.fit, simpler.named));
    }
    None
}

/// References with these causes.
fn fitted(
    right: &Data<'_>,
    of_file: &Prior,
    causes: &[Cause],
    (start, set): (Vec<f64>, Vec<usize>),
) -> Option<Answered> {
    let wide = of_file.with(causes, &set);
    let fit = fit(right, &wide, start)?;
    let evidence = Evidence::new(&fit.theta, &fit.sessions, &scatter(right, fit.factors), &of_file.mean)?;
    let mut named = named_as(&evidence, &of_file.covariance, causes, &set)?;
    named.posterior.mean = DVector::from_column_slice(&fit.theta);
    Some(Answered { fit, named, set })
}

/// Evidence of two answers, nats, each from what is known before it. Errors count in the same sigma, that of the fit that leaves less.
fn scores(data: &Data<'_>, causes: &[Cause], both: [(&Answered, &Prior); 2]) -> [f64; 2] {
    let scale = both[0].0.fit.scale.min(both[1].0.fit.scale);
    both.map(|(of, prior)| {
        let theta = of.named.posterior.mean.as_slice();
        let sessions = equations(data, theta, scale);
        let evidence = Evidence::new(theta, &sessions, &scatter(data, of.fit.factors), &prior.mean);
        let known = covariance(&prior.covariance, causes, &of.set);
        evidence.and_then(|e| Some(e.of(&known)? - e.base)).unwrap_or(f64::NEG_INFINITY)
    })
}
