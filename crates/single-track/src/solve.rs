//! From a car and its drives to fitted constants and named causes.

use nalgebra::DMatrix;
use odometry::Cause;
use odometry::weighing::{Evidence, Named, covariance, name};

use crate::car::Car;
use crate::cause::causes;
use crate::drive::Drive;
use crate::error::CarError;
use crate::fit::{Data, Fit, Prior, fit, sessions};
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
///
/// `start` is where another fit of nearly the same drives ended.
pub(crate) fn solve<'a>(
    car: &Car,
    references: &[Drive],
    drives: &[&'a Drive],
    start: Option<&[f64]>,
) -> Result<Solved<'a>, CarError> {
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
    let start = start.map_or_else(|| prior.mean.as_slice().to_vec(), <[f64]>::to_vec);
    let (fit, named) = weigh(&data, &prior, &causes, start).ok_or_else(short)?;
    Ok(Solved { data, causes, prior, fit, named })
}

/// Fits all constants as if every cause may be there, and weighs the causes about that fit and once more about the answer.
fn weigh(data: &Data<'_>, prior: &Prior, causes: &[Cause], start: Vec<f64>) -> Option<(Fit, Named)> {
    let every: Vec<usize> = (0..causes.len()).collect();
    let wide = Prior { mean: prior.mean.clone(), covariance: covariance(&prior.covariance, causes, &every) };
    let mut fit = fit(data, &wide, start)?;
    let weighed = |fit: &Fit| {
        let evidence = Evidence::new(&fit.theta, &fit.sessions, &data.scatter(fit.factor), &prior.mean)?;
        name(&evidence, &prior.covariance, causes)
    };
    let first = weighed(&fit)?;
    fit.theta = first.posterior.mean.iter().copied().collect();
    fit.sessions = sessions(data, &fit.theta, fit.scales);
    let named = weighed(&fit)?;
    Some((fit, named))
}
