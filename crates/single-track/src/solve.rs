//! From a car and its drives to fitted constants and named causes.

use nalgebra::{DMatrix, DVector};
use odometry::Cause;
use odometry::weighing::{Evidence, Named, Posterior, covariance, name, named_as, stand_ins};

use crate::car::Car;
use crate::cause::causes;
use crate::constants::Constant;
use crate::drive::Drive;
use crate::error::CarError;
use crate::fit::{Data, Fit, Prior, fit, fit_like, likelier, sessions, without};
use crate::settings::SETTINGS;
use inference::robust::NINETY;

/// Drives with the constants fitted to them, and what was named.
pub(crate) struct Solved<'a> {
    pub(crate) data: Data<'a>,
    pub(crate) causes: Vec<Cause>,
    pub(crate) prior: Prior,
    pub(crate) fit: Fit,
    pub(crate) named: Named,
}

/// Fits drives and names causes.
pub(crate) fn solve<'a>(car: &Car, references: &[Drive], drives: &[&'a Drive]) -> Result<Solved<'a>, CarError> {
    let data = Data::new(car, drives)?;
    let causes = causes(&data.constants);
    let short = || CarError::Short { windows: 0, length: SETTINGS.windows.length, needed: SETTINGS.windows.least };
    let mut prior = data.prior();
    if !references.is_empty() {
        let right = Data::new(car, &references.iter().collect::<Vec<_>>())?;
        // What they may be told to lack is of no interest: constants and scatter are.
        let of_right = answered(&right, &prior, &causes, prior.mean.as_slice().to_vec());
        let (fit, named) = of_right.map(|(of, _)| told(&right, &prior, &causes, of)).ok_or_else(short)?;
        let scatter = right.scatter(fit.factor);
        let between = DMatrix::from_diagonal(&scatter.component_mul(&scatter));
        prior = Prior { mean: named.posterior.mean, covariance: named.posterior.covariance + between };
    }
    let start = prior.mean.as_slice().to_vec();
    let found = answered(&data, &prior, &causes, start);
    let best = found.and_then(|(best, retuned)| exchanged(&data, &prior, &causes, &retuned, best)).ok_or_else(short)?;
    let (fit, named) = told(&data, &prior, &causes, best);
    Ok(Solved { data, causes, prior, fit, named })
}

impl Solved<'_> {
    /// The same without one of its drives: constants and causes follow from the equations of the others, set up once more
    /// where those lead.
    pub(crate) fn without(&self, left: usize) -> Option<Self> {
        let mut data = self.data.clone();
        data.shown.remove(left);
        let mut fit = without(&data, &self.prior, &self.fit, left);
        let mut first = named_about(&data, &self.prior, &self.causes, &fit)?;
        within(&data, &mut first);
        fit.theta = first.posterior.mean.as_slice().to_vec();
        fit.sessions = sessions(&data, &fit.theta, fit.noise);
        let mut named = named_about(&data, &self.prior, &self.causes, &fit)?;
        within(&data, &mut named);
        drop_unmoved(&self.causes, &self.prior, &mut named);
        Some(Self { data, causes: self.causes.clone(), prior: self.prior.clone(), fit, named })
    }
}

/// A fit with what its equations name.
struct Answered {
    fit: Fit,
    named: Named,
    /// Causes with which it was fitted, in order.
    set: Vec<usize>,
}

/// Fits constants and names causes from what is known; where much is left, also from where every cause is free, and takes what
/// is more probable; also the fit without any cause.
fn answered(data: &Data<'_>, prior: &Prior, causes: &[Cause], start: Vec<f64>) -> Option<(Answered, Fit)> {
    let retuned = fit(data, prior, start.clone())?;
    let near = settled(data, prior, causes, retuned.clone())?;
    let best = if data.share(&near.fit.theta) > SETTINGS.naming.near_share {
        let every: Vec<usize> = (0..causes.len()).collect();
        let wide = Prior { mean: prior.mean.clone(), covariance: covariance(&prior.covariance, causes, &every) };
        let far = settled(data, prior, causes, fit(data, &wide, start)?)?;
        let [of_far, of_near] = scores(data, prior, causes, [&far, &near]);
        if of_far > of_near { far } else { near }
    } else {
        near
    };
    Some((best, retuned))
}

/// What is told of an answer.
fn told(data: &Data<'_>, prior: &Prior, causes: &[Cause], answer: Answered) -> (Fit, Named) {
    let Answered { fit, mut named, set } = answer;
    // About where it stands the fit is what it was fitted to be.
    if named.chosen.len() == set.len() && named.chosen.iter().all(|w| set.contains(&w.cause)) {
        named.posterior.mean = DVector::from_column_slice(&fit.theta);
    }
    within(data, &mut named);
    drop_unmoved(causes, prior, &mut named);
    (fit, named)
}

/// Weighs the causes about a fit, and fits anew with what they name, until the same are named.
fn settled(data: &Data<'_>, prior: &Prior, causes: &[Cause], from: Fit) -> Option<Answered> {
    let named = named_about(data, prior, causes, &from)?;
    let mut out = Answered { fit: from, named, set: Vec::new() };
    let mut tried = vec![Vec::new()];
    for _ in 0..SETTINGS.naming.rounds {
        let mut set: Vec<usize> = out.named.chosen.iter().map(|w| w.cause).collect();
        set.sort_unstable();
        if tried.contains(&set) {
            break;
        }
        let narrow = Prior { mean: prior.mean.clone(), covariance: covariance(&prior.covariance, causes, &set) };
        // Along a valley that only what is known closes, a fit hardly moves; the equations know where it ends.
        let ends = within_bounds(data, &out.named.posterior.mean);
        let start = likelier(data, &narrow, out.fit.noise, [out.fit.theta, ends])?;
        let fit = fit(data, &narrow, start)?;
        let named = named_about(data, prior, causes, &fit)?;
        tried.push(set.clone());
        out = Answered { fit, named, set };
    }
    Some(out)
}

/// Evidence of two answers, nats. Errors count in the same sigmas, those of the fit that leaves less.
fn scores(data: &Data<'_>, prior: &Prior, causes: &[Cause], both: [&Answered; 2]) -> [f64; 2] {
    let noise = both[0].fit.noise.least(both[1].fit.noise);
    both.map(|of| {
        let sessions = sessions(data, &of.fit.theta, noise);
        let evidence = Evidence::new(&of.fit.theta, &sessions, &data.scatter(of.fit.factor), &prior.mean);
        let known = covariance(&prior.covariance, causes, &of.set);
        evidence.and_then(|e| Some(e.of(&known)? - e.base)).unwrap_or(f64::NEG_INFINITY)
    })
}

/// The same with others that may stand for its first causes, each by a fit of its own: about a fit with one of two causes that do
/// much the same, the equations, which are straight lines, leave too much to the other one.
///
/// Another one that leaves hardly more of the errors is hard to tell from it: evidence counts all errors as noise, and laws of tyres
/// and servos are not known that well. Of such two that leads which asks the constants for far fewer sigmas of what is known.
fn exchanged(data: &Data<'_>, prior: &Prior, causes: &[Cause], retuned: &Fit, mut best: Answered) -> Option<Answered> {
    let rules = SETTINGS.naming;
    let lines = |fit: &Fit| Evidence::new(&fit.theta, &fit.sessions, &data.scatter(fit.factor), &prior.mean);
    let first: Vec<usize> = best.named.chosen.iter().take(rules.exchanged).map(|w| w.cause).collect();
    // A later exchange names anew; what cannot be told from an earlier cause is kept beside it.
    let mut classes: Vec<(usize, Vec<usize>)> = Vec::new();
    for cause in first {
        let set: Vec<usize> = best.named.chosen.iter().map(|w| w.cause).collect();
        let fitted = |with: Vec<usize>| {
            let narrow = Prior { mean: prior.mean.clone(), covariance: covariance(&prior.covariance, causes, &with) };
            let ends = within_bounds(data, &lines(retuned)?.posterior(&narrow.covariance)?.mean);
            let start = likelier(data, &narrow, retuned.noise, [retuned.theta.clone(), ends])?;
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
            if sigmas(prior, &other, causes[candidate].moves()) < rules.moved {
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
        let much_nearer = |(_, candidate, other): &(f64, usize, Answered)| {
            let both = || causes[cause].moves().into_iter().chain(causes[*candidate].moves());
            rules.nearer * sigmas(prior, other, both()) < sigmas(prior, &best, both())
        };
        let leads = |other: &(f64, usize, Answered)| {
            is_moved(&causes[other.1], prior, &other.2.named.posterior) && (other.0 > rules.alike || much_nearer(other))
        };
        let leader = alike.iter().position(leads);
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
fn sigmas(prior: &Prior, answer: &Answered, constants: impl IntoIterator<Item = usize>) -> f64 {
    let of = |k: usize| (answer.fit.theta[k] - prior.mean[k]).abs() / prior.covariance[(k, k)].sqrt();
    constants.into_iter().map(of).fold(0.0, f64::max)
}

/// A cause whose constants are all where they were known to be, by their 90 % intervals, is none.
fn drop_unmoved(causes: &[Cause], prior: &Prior, named: &mut Named) {
    let Named { chosen, posterior, .. } = named;
    chosen.retain(|w| is_moved(&causes[w.cause], prior, posterior));
}

/// Whether one of a cause's constants is elsewhere than it was known to be, by its 90 % interval.
fn is_moved(cause: &Cause, prior: &Prior, posterior: &Posterior) -> bool {
    cause.moves().into_iter().any(|k| {
        let sd = posterior.covariance[(k, k)].max(0.0).sqrt();
        (posterior.mean[k] - prior.mean[k]).abs() > NINETY * sd
    })
}

/// Keeps constants within what they can be.
fn within(data: &Data<'_>, named: &mut Named) {
    let Named { posterior, retuned, placebo, .. } = named;
    for posterior in [Some(posterior), Some(retuned), placebo.as_mut().map(|(_, p)| p)].into_iter().flatten() {
        posterior.mean = DVector::from_vec(within_bounds(data, &posterior.mean));
    }
}

/// Constants within what they can be.
fn within_bounds(data: &Data<'_>, theta: &DVector<f64>) -> Vec<f64> {
    let of = |(c, x): (&Constant, &f64)| {
        let [least, most] = c.bounds();
        x.clamp(least, most)
    };
    data.constants.iter().zip(theta.iter()).map(of).collect()
}

fn named_about(data: &Data<'_>, prior: &Prior, causes: &[Cause], fit: &Fit) -> Option<Named> {
    let evidence = Evidence::new(&fit.theta, &fit.sessions, &data.scatter(fit.factor), &prior.mean)?;
    name(&evidence, &prior.covariance, causes)
}
