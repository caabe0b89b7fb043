//! From a car and its drives to fitted constants and named causes.

use nalgebra::{DMatrix, DVector};
use odometry::Cause;
use odometry::weighing::{Evidence, Named, covariance, name};

use crate::car::Car;
use crate::cause::causes;
use crate::drive::Drive;
use crate::error::CarError;
use crate::fit::{Data, Fit, Prior, fit, refit, sessions, without};
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
        fit.sessions = sessions(&data, &fit.theta, fit.scales);
        let mut named = named_about(&data, &self.prior, &self.causes, &fit)?;
        within(&data, &mut named);
        drop_unmoved(&self.causes, &self.prior, &mut named);
        Some(Self { data, causes: self.causes.clone(), prior: self.prior.clone(), fit, named })
    }
}

/// Fits all constants as if every cause may be there, and weighs the causes about that fit and once more about the answer.
fn weigh(data: &Data<'_>, prior: &Prior, causes: &[Cause], start: Vec<f64>) -> Option<(Fit, Named)> {
    let every: Vec<usize> = (0..causes.len()).collect();
    let wide = Prior { mean: prior.mean.clone(), covariance: covariance(&prior.covariance, causes, &every) };
    let fit = fit(data, &wide, start)?;
    let first = named_about(data, prior, causes, &fit)?;
    // The equations of the wide fit hold about it only: the answer is fitted anew with what it names.
    let set: Vec<usize> = first.chosen.iter().map(|w| w.cause).collect();
    let narrow = Prior { mean: prior.mean.clone(), covariance: covariance(&prior.covariance, causes, &set) };
    let fit = refit(data, &narrow, fit)?;
    let mut named = named_about(data, prior, causes, &fit)?;
    named.posterior.mean = DVector::from_column_slice(&fit.theta);
    within(data, &mut named);
    drop_unmoved(causes, prior, &mut named);
    Some((fit, named))
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
        for (k, c) in data.constants.iter().enumerate() {
            let [least, most] = c.bounds();
            posterior.mean[k] = posterior.mean[k].clamp(least, most);
        }
    }
}

fn named_about(data: &Data<'_>, prior: &Prior, causes: &[Cause], fit: &Fit) -> Option<Named> {
    let evidence = Evidence::new(&fit.theta, &fit.sessions, &data.scatter(fit.factor), &prior.mean)?;
    name(&evidence, &prior.covariance, causes)
}
