//! A fit with what its equations name, and what two of them are weighed by.

use crate::cause::Cause;
use crate::data::{Data, Prior};
use crate::descent::sessions;
use crate::fit::Fit;
use crate::name::{Named, covariance};
use crate::observed::Observed;
use crate::weigh::{Evidence, Posterior};
use inference::robust::NINETY;

/// A fit with what its equations name.
pub(crate) struct Answered {
    pub(crate) fit: Fit,
    pub(crate) named: Named,
    /// Causes with which it was fitted, in order.
    pub(crate) set: Vec<usize>,
}

/// Evidence of two answers, nats. Errors count in the same sigmas, those of the fit that leaves less.
pub(crate) fn scores<D: Observed>(data: &Data<D>, prior: &Prior, causes: &[Cause], both: [&Answered; 2]) -> [f64; 2] {
    scores_of(data, causes, both.map(|answer| (answer, prior)))
}

/// The same of answers that start from what is known each.
pub(crate) fn scores_of<D: Observed>(data: &Data<D>, causes: &[Cause], both: [(&Answered, &Prior); 2]) -> [f64; 2] {
    let noise = both[0].0.fit.noise.least(both[1].0.fit.noise);
    both.map(|(of, prior)| {
        let sessions = sessions(data, &of.fit.theta, &of.fit.own, noise);
        let evidence = Evidence::new(&of.fit.theta, &sessions, &data.scatter(of.fit.factor), &prior.mean);
        let known = covariance(&prior.covariance, causes, &of.set);
        evidence.and_then(|e| Some(e.of(&known)? - e.base)).unwrap_or(f64::NEG_INFINITY)
    })
}

/// Whether one of a cause's constants is elsewhere than it was known to be, by its 90 % interval.
pub(crate) fn is_moved(cause: &Cause, prior: &Prior, posterior: &Posterior) -> bool {
    cause.moves().into_iter().any(|k| {
        let sd = posterior.covariance[(k, k)].max(0.0).sqrt();
        (posterior.mean[k] - prior.mean[k]).abs() > NINETY * sd
    })
}
