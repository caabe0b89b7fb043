//! Drives with the model that they are compared with, what their rows scatter by, and what is known before them.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::cause::Cause;
use crate::name::covariance;
use crate::observed::{Kind, Observed, Spread};
use crate::onset::Onset;
use crate::settings::SETTINGS;
use crate::weigh::Posterior;
use inference::robust::{quantile, rms, sorted};

/// Drives with the model that they are compared with.
#[derive(Debug, Clone)]
pub struct Data<D: Observed> {
    /// The model.
    pub model: D::Model,
    /// How far each of its constants may be from what is given.
    pub spreads: Vec<Spread>,
    /// The drives.
    pub drives: Vec<D>,
}

/// What rows of each kind scatter by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Noise {
    /// Sigma of a row's error.
    pub sigma: [f64; 3],
    /// Independent rows for each row, at most 1: errors that follow one another say less (effective number of samples).
    pub power: [f64; 3],
}

impl Noise {
    /// The same with every row for itself.
    #[must_use]
    pub fn of_single_rows(self) -> Self {
        Self { power: [1.0; 3], ..self }
    }

    /// The same where rows say so many times as much.
    pub(crate) fn times(self, by: f64) -> Self {
        Self { power: self.power.map(|p| p * by), ..self }
    }

    /// Of two that under which rows say more, kind by kind.
    pub(crate) fn sharper(self, other: Self) -> Self {
        let variance = |of: Self, kind: usize| of.sigma[kind].powi(2) / of.power[kind];
        let of = |kind: usize| if variance(other, kind) < variance(self, kind) { other } else { self };
        Self { sigma: std::array::from_fn(|k| of(k).sigma[k]), power: std::array::from_fn(|k| of(k).power[k]) }
    }

    /// The less noisy of two, kind by kind.
    pub(crate) fn least(self, other: Self) -> Self {
        let of = |a: [f64; 3], b: [f64; 3]| std::array::from_fn(|kind| a[kind].min(b[kind]));
        Self { sigma: of(self.sigma, other.sigma), power: of(self.power, other.power) }
    }
}

/// What is known of the constants before the drives.
#[derive(Debug, Clone, PartialEq)]
pub struct Prior {
    /// Most probable deviations.
    pub mean: DVector<f64>,
    /// Covariance about them.
    pub covariance: DMatrix<f64>,
}

impl Prior {
    /// The same where these causes may be there.
    #[must_use]
    pub fn with(&self, causes: &[Cause], set: &[usize]) -> Self {
        Self { mean: self.mean.clone(), covariance: covariance(&self.covariance, causes, set) }
    }
}

impl<D: Observed> Data<D> {
    pub(crate) fn errors(&self, thetas: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let of = |(drive, theta): (&D, &Vec<f64>)| drive.errors(&self.model, theta);
        self.drives.par_iter().zip(thetas).map(of).collect()
    }

    /// Of errors of rows in motion: sigmas by their upper quantile, and how many are independent.
    pub(crate) fn noise(&self, errors: &[Vec<f64>]) -> Noise {
        let sigma = self.sigmas(errors);
        let power = Kind::ALL.map(|kind| {
            let most = 2.0 * SETTINGS.errors.quantile_sigmas * sigma[kind as usize];
            let (mut square, mut product) = (0.0, 0.0);
            for (drive, errors) in self.drives.iter().zip(errors) {
                let of_kind = drive.rows().iter().zip(errors).filter(|(r, _)| r.kind == kind);
                let held: Vec<Option<f64>> =
                    of_kind.map(|(r, e)| (r.is_moving && *e != 0.0).then(|| e.clamp(-most, most))).collect();
                for (a, b) in held.iter().zip(held.iter().skip(drive.apart(kind))) {
                    if let (Some(a), Some(b)) = (a, b) {
                        product += a * b;
                        square += 0.5 * (a * a + b * b);
                    }
                }
            }
            // Of a process of first order with this correlation.
            let correlation = (product / square.max(f64::MIN_POSITIVE)).clamp(0.0, SETTINGS.errors.correlated);
            (1.0 - correlation) / (1.0 + correlation)
        });
        Noise { sigma, power }
    }

    fn sigmas(&self, errors: &[Vec<f64>]) -> [f64; 3] {
        let rules = SETTINGS.errors;
        Kind::ALL.map(|kind| {
            let of = |(drive, e): (&D, &Vec<f64>)| {
                let rows = drive.rows().iter().zip(e).filter(|(r, e)| r.kind == kind && r.is_moving && **e != 0.0);
                rows.map(|(_, e)| e.abs()).collect::<Vec<f64>>()
            };
            let sizes = sorted(self.drives.iter().zip(errors).flat_map(of));
            let limit = quantile(&sizes, rules.quantile).unwrap_or(0.0) / rules.quantile_sigmas;
            let cut = 2.0 * rules.quantile_sigmas * limit;
            rms(sizes.iter().map(|e| e.min(cut))).unwrap_or(0.0).max(D::FLOOR[kind as usize])
        })
    }

    /// Scale of the errors of the rows in motion, by kind.
    pub(crate) fn left(&self, theta: &[f64]) -> [f64; 3] {
        self.sigmas(&self.errors(&vec![theta.to_vec(); self.drives.len()]))
    }

    /// Root mean square error of the rows in motion over the size of what they measure.
    pub fn share(&self, theta: &[f64]) -> f64 {
        self.share_of(&self.errors(&vec![theta.to_vec(); self.drives.len()]))
    }

    /// The same where a cause is not there all the time, `theta` being the constants where it is.
    pub(crate) fn share_with(&self, theta: &[f64], onset: &Onset) -> f64 {
        self.share_of(&self.errors_with(theta, onset))
    }

    /// Scales of errors, by kind, of the same.
    pub(crate) fn left_with(&self, theta: &[f64], onset: &Onset) -> [f64; 3] {
        self.sigmas(&self.errors_with(theta, onset))
    }

    fn errors_with(&self, theta: &[f64], onset: &Onset) -> Vec<Vec<f64>> {
        let all = |theta: &[f64]| self.errors(&vec![theta.to_vec(); self.drives.len()]);
        let both = all(theta).into_iter().zip(all(onset.off.as_slice())).enumerate();
        let chosen =
            |(k, (on, off)): (usize, (Vec<f64>, Vec<f64>))| onset.gate.chosen(k, self.drives[k].rows(), &on, &off);
        both.map(chosen).collect()
    }

    fn share_of(&self, errors: &[Vec<f64>]) -> f64 {
        let (mut ways, mut sizes) = (Vec::new(), Vec::new());
        for (drive, errors) in self.drives.iter().zip(errors) {
            let kind = drive.judged_by();
            let moving = drive.rows().iter().zip(errors).filter(|(r, _)| r.kind == kind && r.is_moving);
            ways.extend(moving.map(|(_, e)| *e));
            sizes.extend(drive.sizes());
        }
        rms(ways).unwrap_or(0.0) / rms(sizes).unwrap_or(1.0).max(f64::MIN_POSITIVE)
    }

    /// The same share that the noise of what is measured alone would leave.
    pub fn share_of_noise(&self) -> f64 {
        let drives = || self.drives.iter().filter(|drive| !drive.sizes().is_empty());
        let noise = rms(drives().map(Observed::noise)).unwrap_or(0.0);
        noise / rms(drives().flat_map(Observed::sizes)).unwrap_or(1.0).max(f64::MIN_POSITIVE)
    }

    /// One sigma by which drives differ.
    pub fn scatter(&self, factor: f64) -> DVector<f64> {
        DVector::from_iterator(self.spreads.len(), self.spreads.iter().map(|c| factor * c.scatter))
    }

    /// One sigma by which constants move between the references and the recordings, beside what drives scatter by.
    pub(crate) fn between_visits(&self) -> DVector<f64> {
        let rules = SETTINGS.visits;
        let of = |c: &Spread| (rules.moved * c.sigma).min(rules.most * c.usual);
        DVector::from_iterator(self.spreads.len(), self.spreads.iter().map(of))
    }

    /// Constants within what they can be.
    fn within_bounds(&self, theta: &DVector<f64>) -> Vec<f64> {
        self.spreads.iter().zip(theta.iter()).map(|(c, x)| x.clamp(c.bounds[0], c.bounds[1])).collect()
    }

    /// The most probable constants within their bounds: those that lie beyond are held there, and the others follow as they go with them.
    pub(crate) fn bounded(&self, posterior: &Posterior) -> DVector<f64> {
        let Posterior { mean, covariance } = posterior;
        let clamped = |at: &DVector<f64>, k: usize| at[k].clamp(self.spreads[k].bounds[0], self.spreads[k].bounds[1]);
        let mut held: Vec<(usize, f64)> = Vec::new();
        let mut at = mean.clone();
        loop {
            let open = (0..at.len()).filter(|k| held.iter().all(|(h, _)| h != k) && clamped(&at, *k) != at[*k]);
            let beyond: Vec<(usize, f64)> = open.map(|k| (k, clamped(&at, k))).collect();
            if beyond.is_empty() {
                break;
            }
            held.extend(beyond);
            let indices: Vec<usize> = held.iter().map(|(k, _)| *k).collect();
            let off = DVector::from_iterator(held.len(), held.iter().map(|(k, value)| value - mean[*k]));
            let columns = covariance.select_columns(&indices);
            let Some(of_held) = columns.select_rows(&indices).cholesky() else { break };
            at = mean + columns * of_held.solve(&off);
            for (k, value) in &held {
                at[*k] = *value;
            }
        }
        DVector::from_vec(self.within_bounds(&at))
    }

    /// Constants of a drive that deviates from the robot's.
    pub(crate) fn own_constants(&self, theta: &[f64], own: &DVector<f64>) -> Vec<f64> {
        self.within_bounds(&(DVector::from_column_slice(theta) + own))
    }

    /// What the robot file knows.
    pub(crate) fn prior(&self) -> Prior {
        let n = self.spreads.len();
        let variances = DVector::from_iterator(n, self.spreads.iter().map(|c| c.sigma.powi(2)));
        Prior { mean: DVector::zeros(n), covariance: DMatrix::from_diagonal(&variances) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scaled::Scaled;
    use approx::assert_relative_eq;

    #[test]
    fn what_goes_with_a_constant_follows_it_to_its_bound() {
        let spread = |bounds: [f64; 2]| Spread { sigma: 1.0, usual: 1.0, scatter: 0.1, bounds };
        let spreads = vec![spread([-5.0, 1.0]), spread([-0.5, 5.0]), spread([-5.0, 5.0])];
        let data = Data { model: (), spreads, drives: Vec::<Scaled>::new() };
        let covariance = DMatrix::from_row_slice(3, 3, &[1.0, 0.8, 0.2, 0.8, 1.0, 0.5, 0.2, 0.5, 1.0]);
        let of =
            |mean: [f64; 3]| data.bounded(&Posterior { mean: mean.to_vec().into(), covariance: covariance.clone() });

        assert_eq!(of([0.5, 0.1, 2.0]).as_slice(), [0.5, 0.1, 2.0]);
        assert_relative_eq!(of([1.5, 1.0, 2.0]).as_slice(), [1.0, 0.6, 1.9].as_slice(), epsilon = 1e-12);
        // The second one reaches its bound only because the first does: the third follows both.
        let both = of([2.0, 0.0, 2.0]);
        assert_relative_eq!(both.as_slice()[..2], [1.0, -0.5]);
        assert_relative_eq!(both[2], 2.0 + 0.2 / 0.36 - 0.17 / 0.36, epsilon = 1e-12);
    }
}
