//! From a car and its drives to fitted constants and named causes.

use nalgebra::{DMatrix, DVector};
use odometry::Cause;
use odometry::weighing::{Evidence, Named, covariance, name};

use crate::answered::{Answered, is_moved, scores, within_bounds};
use crate::car::Car;
use crate::cause::causes;
use crate::drive::Drive;
use crate::error::CarError;
use crate::fit::{Data, Fit, Prior, fit, likelier, sessions, without};
use crate::look_alikes::exchanged;
use crate::settings::SETTINGS;

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

/// A cause whose constants are all where they were known to be, by their 90 % intervals, is none.
fn drop_unmoved(causes: &[Cause], prior: &Prior, named: &mut Named) {
    let Named { chosen, posterior, .. } = named;
    chosen.retain(|w| is_moved(&causes[w.cause], prior, posterior));
}

/// Keeps constants within what they can be.
fn within(data: &Data<'_>, named: &mut Named) {
    let Named { posterior, retuned, placebo, .. } = named;
    for posterior in [Some(posterior), Some(retuned), placebo.as_mut().map(|(_, p)| p)].into_iter().flatten() {
        posterior.mean = DVector::from_vec(within_bounds(data, &posterior.mean));
    }
}

fn named_about(data: &Data<'_>, prior: &Prior, causes: &[Cause], fit: &Fit) -> Option<Named> {
    let evidence = Evidence::new(&fit.theta, &fit.sessions, &data.scatter(fit.factor), &prior.mean)?;
    name(&evidence, &prior.covariance, causes)
}
