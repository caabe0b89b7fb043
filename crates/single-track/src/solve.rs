//! From a car and its drives to fitted constants and named causes.

use nalgebra::{DMatrix, DVector};
use odometry::Cause;
use odometry::weighing::{Evidence, Named, covariance, name};

use crate::car::Car;
use crate::cause::causes;
use crate::constants::Constant;
use crate::drive::Drive;
use crate::error::CarError;
use crate::fit::{Data, Fit, Prior, fit, likelier, sessions, without};
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
        let (fit, named) = weigh(&right, &prior, &causes, prior.mean.as_slice().to_vec()).ok_or_else(short)?;
        let scatter = right.scatter(fit.factor);
        let between = DMatrix::from_diagonal(&scatter.component_mul(&scatter));
        prior = Prior { mean: named.posterior.mean, covariance: named.posterior.covariance + between };
    }
    let start = prior.mean.as_slice().to_vec();
    let (fit, named) = weigh(&data, &prior, &causes, start).ok_or_else(short)?;
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
/// is more probable.
fn weigh(data: &Data<'_>, prior: &Prior, causes: &[Cause], start: Vec<f64>) -> Option<(Fit, Named)> {
    let near = settled(data, prior, causes, fit(data, prior, start.clone())?)?;
    let best = if data.share(&near.fit.theta) > SETTINGS.naming.near_share {
        let every: Vec<usize> = (0..causes.len()).collect();
        let wide = Prior { mean: prior.mean.clone(), covariance: covariance(&prior.covariance, causes, &every) };
        let far = settled(data, prior, causes, fit(data, &wide, start)?)?;
        // Errors count in the same sigmas, those of the fit that leaves less.
        let noise = near.fit.noise.least(far.fit.noise);
        let score = |of: &Answered| {
            let sessions = sessions(data, &of.fit.theta, noise);
            let evidence = Evidence::new(&of.fit.theta, &sessions, &data.scatter(of.fit.factor), &prior.mean);
            let known = covariance(&prior.covariance, causes, &of.set);
            evidence.and_then(|e| Some(e.of(&known)? - e.base)).unwrap_or(f64::NEG_INFINITY)
        };
        if score(&far) > score(&near) { far } else { near }
    } else {
        near
    };
    let Answered { fit, mut named, set } = best;
    // About where it stands the fit is what it was fitted to be.
    if named.chosen.len() == set.len() && named.chosen.iter().all(|w| set.contains(&w.cause)) {
        named.posterior.mean = DVector::from_column_slice(&fit.theta);
    }
    within(data, &mut named);
    drop_unmoved(causes, prior, &mut named);
    Some((fit, named))
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

/// A cause whose constants are all where they were known to be, by their 90 % intervals, is none.
fn drop_unmoved(causes: &[Cause], prior: &Prior, named: &mut Named) {
    let Named { chosen, posterior, .. } = named;
    let is_moved = |&k: &usize| {
        let sd = posterior.covariance[(k, k)].max(0.0).sqrt();
        (posterior.mean[k] - prior.mean[k]).abs() > NINETY * sd
    };
    chosen.retain(|w| causes[w.cause].moves().iter().any(is_moved));
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
