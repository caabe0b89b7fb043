//! A candidate of the screen, and the linear problem that weighs it.

use faer::Mat;
use inference::algebra::{eliminate, select, solve_spd};
use inference::hypothesis::{Free, Onsets, Variant};
use robot_model::tunable::COUNT as NUISANCES;
use statrs::distribution::{ContinuousCDF, Normal as Gaussian};

use crate::fit::{Columns, Fitted, Problem};
use crate::settings::{fit, search};

/// A form of an effect with its evidence and where a fit of it should start.
#[derive(Clone)]
pub(crate) struct Candidate {
    pub(crate) variant: Variant,
    pub(crate) start: Vec<f64>,
    pub(crate) onsets: Onsets,
    /// Log Bayes factor over "re-tune only", nats.
    pub(crate) evidence: f64,
}

/// Evidence of a set of columns with unit-prior coefficients: `½ bᵀ(A+I)⁻¹b − ½ ln det(A+I)`, and the coefficients.
pub(crate) fn evidence(a: &Mat<f64>, b: &Mat<f64>) -> Option<(f64, Vec<f64>, f64)> {
    let n = a.nrows();
    let m = Mat::from_fn(n, n, |i, j| a[(i, j)] + f64::from(i == j));
    let (x, logdet) = solve_spd(&m, b)?;
    let gain: f64 = (0..n).map(|i| 0.5 * x[(i, 0)] * b[(i, 0)]).sum();
    let sd = 1.0 / m[(0, 0)].sqrt();
    Some((gain - 0.5 * logdet, (0..n).map(|i| x[(i, 0)]).collect(), sd))
}

/// Evidence for a coefficient that must be positive: the share of the posterior that is, over that of the prior.
pub(crate) fn positive_share(mean: f64, sd: f64) -> f64 {
    let z = mean / sd;
    if z < search::SETTINGS.screen.asymptote {
        -0.5 * z * z
    } else {
        (2.0 * Gaussian::standard().cdf(z)).max(1e-300).ln()
    }
}

pub(crate) fn single(a: f64, b: f64, signed: bool) -> Option<(f64, f64)> {
    let (value, x, sd) = evidence(&Mat::from_fn(1, 1, |_, _| a), &Mat::from_fn(1, 1, |_, _| b))?;
    Some((value + if signed { 0.0 } else { positive_share(x[0], sd) }, x[0]))
}

/// Where a screen stands: a point, and the columns of what is re-tuned together with every candidate.
pub(crate) struct Ground<'a> {
    pub(crate) problem: &'a Problem<'a>,
    pub(crate) base: &'a Fitted,
    /// Columns of the effects that are there already.
    pub(crate) beside: Columns,
}

/// `A` and `b` of the columns after θ, the effects that are there and the runs' own numbers are eliminated.
pub(crate) fn reduced(ground: &Ground<'_>, mut columns: Columns) -> Option<(Mat<f64>, Mat<f64>)> {
    let (problem, base) = (ground.problem, ground.base);
    let n = columns.0.len();
    columns.0.extend(ground.beside.0.iter().cloned());
    let mut normal = problem.normal(&base.point, &base.response, &base.columns, &columns)?;
    problem.with_prior(&base.point, &mut normal);
    let known = ground.beside.0.len();
    for i in NUISANCES + n..NUISANCES + n + known {
        normal.matrix[(i, i)] += fit::SETTINGS.fit.whiff;
    }
    let all = NUISANCES + n + known + 1;
    // Order: columns, gradient, then θ and what is there already, which are eliminated.
    let order: Vec<usize> =
        (NUISANCES..NUISANCES + n).chain([all - 1]).chain(0..NUISANCES).chain(NUISANCES + n..all - 1).collect();
    let full = Mat::from_fn(all, all, |i, j| {
        let last = all - 1;
        match (i == last, j == last) {
            (true, true) => 0.0,
            (true, false) => normal.gradient[(j, 0)],
            (false, true) => normal.gradient[(i, 0)],
            _ => normal.matrix[(i, j)],
        }
    });
    let m = eliminate(&select(&full, &order), NUISANCES + known)?;
    Some((m.submatrix(0, 0, n, n).to_owned(), m.submatrix(0, n, n, 1).to_owned()))
}

/// Sizes of an effect whose free runs are compared, of both signs, within its bounds.
pub(crate) fn sizes_tried(size: &Free) -> impl Iterator<Item = f64> {
    let Free { unit, bounds: [least, most], .. } = *size;
    let both = search::SETTINGS.finalists.sizes.into_iter().flat_map(move |times| [times * unit, -times * unit]);
    both.filter(move |x| (least..=most).contains(x))
}
