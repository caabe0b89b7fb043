//! Regression of columns on others, from the Gram matrix alone.

use faer::linalg::solvers::Solve;
use faer::{Mat, Side};

use crate::settings::SETTINGS;
use crate::{Gram, WeakFormError};

/// Coefficients of a linear law between columns.
#[derive(Debug, Clone, PartialEq)]
pub struct Law {
    targets: usize,
    coefficients: Vec<f64>,
    unexplained: Vec<f64>,
}

impl Law {
    /// The coefficient of the regressor that was named `regressor`-th in the law of the target that was named `target`-th,
    /// in the target's unit over the regressor's; NaN where there is none.
    pub fn coefficient(&self, regressor: usize, target: usize) -> f64 {
        let at = regressor * self.targets + target;
        if target < self.targets { self.coefficients.get(at).copied().unwrap_or(f64::NAN) } else { f64::NAN }
    }

    /// Share of each target's squares that the law leaves unexplained, 0 to 1.
    pub fn unexplained(&self) -> &[f64] {
        &self.unexplained
    }
}

impl Gram {
    /// Ridge regression of the columns `targets` on the columns `regressors`:
    /// `(A + λ diag A) x = b` with `A = H[regressors, regressors]` and `b = H[regressors, target]`.
    ///
    /// `penalty` is λ, without unit, since it counts in squares of each regressor itself.
    ///
    /// # Errors
    /// Columns that do not exist, a penalty that is negative or no number, and windows that do not determine the
    /// coefficients.
    pub fn ridge(&self, targets: &[usize], regressors: &[usize], penalty: f64) -> Result<Law, WeakFormError> {
        self.shape().columns_of(targets)?;
        self.shape().columns_of(regressors)?;
        if !(penalty.is_finite() && penalty >= 0.0) {
            return Err(WeakFormError::Penalty { value: penalty });
        }
        let undetermined = || WeakFormError::NotDetermined { windows: self.windows(), regressors: regressors.len() };
        let h = |i: usize, j: usize| self.at(i, j).unwrap_or(f64::NAN);
        // Every regressor in its own size: the diagonal becomes 1 + λ.
        let size: Vec<f64> = regressors.iter().map(|&c| h(c, c).sqrt()).collect();
        if !size.iter().all(|s| s.is_finite() && *s > 0.0) || regressors.is_empty() {
            return Err(undetermined());
        }
        let n = regressors.len();
        let a = Mat::from_fn(n, n, |i, j| {
            h(regressors[i], regressors[j]) / (size[i] * size[j]) + if i == j { penalty } else { 0.0 }
        });
        let b = Mat::from_fn(n, targets.len(), |i, t| h(regressors[i], targets[t]) / size[i]);
        let factor = a.llt(Side::Lower).map_err(|_| undetermined())?;
        if !(0..n).all(|i| factor.L()[(i, i)].powi(2) > SETTINGS.ridge.least_pivot) {
            return Err(undetermined());
        }
        let x = factor.solve(&b);
        let coefficients = (0..n).flat_map(|i| (0..targets.len()).map(move |t| (i, t)));
        let unexplained = |t: usize| {
            // |y − Xβ|² = yy − 2 βb + βAβ, without the penalty.
            let explained: f64 = (0..n)
                .map(|i| {
                    let ax: f64 = (0..n).map(|j| (a[(i, j)] - if i == j { penalty } else { 0.0 }) * x[(j, t)]).sum();
                    x[(i, t)] * (2.0 * b[(i, t)] - ax)
                })
                .sum();
            let all = h(targets[t], targets[t]);
            if all > 0.0 { (1.0 - explained / all).clamp(0.0, 1.0) } else { 0.0 }
        };
        Ok(Law {
            targets: targets.len(),
            coefficients: coefficients.map(|(i, t)| x[(i, t)] / size[i]).collect(),
            unexplained: (0..targets.len()).map(unexplained).collect(),
        })
    }
}
