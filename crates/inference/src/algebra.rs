//! The little dense algebra that inference needs, over faer.

use faer::linalg::solvers::Solve;
use faer::{Mat, Side};

/// Solution and log-determinant of `M x = B` for a symmetric positive definite `M`; `None` if it is
/// not.
pub fn solve_spd(m: &Mat<f64>, b: &Mat<f64>) -> Option<(Mat<f64>, f64)> {
    let llt = m.llt(Side::Lower).ok()?;
    let l = llt.L();
    let logdet = 2.0 * (0..m.nrows()).map(|i| l[(i, i)].ln()).sum::<f64>();

    let x = llt.solve(b);
    logdet.is_finite().then_some((x, logdet))
}

/// Inverse of a symmetric positive definite matrix; `None` if it is not.
pub fn inverse_spd(m: &Mat<f64>) -> Option<Mat<f64>> {
    Some(solve_spd(m, &Mat::identity(m.nrows(), m.nrows()))?.0)
}

/// `L⁻¹ b` with `C = L Lᵀ`: residuals of covariance `C` become independent ones of unit variance.
///
/// `None` if `C` is not positive definite.
pub fn whitening(c: &Mat<f64>) -> Option<Mat<f64>> {
    let llt = c.llt(Side::Lower).ok()?;
    let l = llt.L();
    let n = c.nrows();

    // Forward substitution of the unit vectors; L is lower triangular and small.
    let mut w = Mat::<f64>::zeros(n, n);
    for k in 0..n {
        for i in k..n {
            let known: f64 = (k..i).map(|j| l[(i, j)] * w[(j, k)]).sum();
            w[(i, k)] = (f64::from(i == k) - known) / l[(i, i)];
        }
    }
    Some(w)
}

/// `½ dᵀ H d`.
pub fn half_quadratic(h: &Mat<f64>, d: &[f64]) -> f64 {
    let mut sum = 0.0;
    for i in 0..d.len() {
        for j in 0..d.len() {
            sum += 0.5 * d[i] * h[(i, j)] * d[j];
        }
    }
    sum
}

/// Eliminates the last `drop` rows and columns of the symmetric `m`: `A − B D⁻¹ Bᵀ`.
///
/// `None` when the eliminated block is not positive definite.
pub fn eliminate(m: &Mat<f64>, drop: usize) -> Option<Mat<f64>> {
    let keep = m.nrows() - drop;
    if drop == 0 {
        return Some(m.clone());
    }

    let d = m.submatrix(keep, keep, drop, drop).to_owned();
    let b = m.submatrix(keep, 0, drop, keep).to_owned();
    let (x, _) = solve_spd(&d, &b)?;
    Some(m.submatrix(0, 0, keep, keep) - b.transpose() * &x)
}

/// The symmetric matrix of the chosen rows and columns, in the given order.
pub fn select(m: &Mat<f64>, index: &[usize]) -> Mat<f64> {
    Mat::from_fn(index.len(), index.len(), |i, j| m[(index[i], index[j])])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn example() -> Mat<f64> {
        faer::mat![[4.0, 1.0, 2.0], [1.0, 3.0, 0.5], [2.0, 0.5, 5.0]]
    }

    #[test]
    fn elimination_is_the_schur_complement() {
        let s = eliminate(&example(), 1).expect("positive definite");
        approx::assert_relative_eq!(s[(0, 0)], 4.0 - 2.0 * 2.0 / 5.0, epsilon = 1e-14);
        approx::assert_relative_eq!(s[(0, 1)], 1.0 - 2.0 * 0.5 / 5.0, epsilon = 1e-14);
    }

    #[test]
    fn equations_are_solved_and_indefinite_ones_refused() {
        let m = example();
        let b = faer::mat![[1.0], [2.0], [3.0]];
        let (x, logdet) = solve_spd(&m, &b).expect("positive definite");
        let back = &m * &x;
        approx::assert_relative_eq!(back[(2, 0)], 3.0, epsilon = 1e-12);
        approx::assert_relative_eq!(logdet, m.determinant().ln(), epsilon = 1e-12);
        assert!(solve_spd(&faer::mat![[1.0, 2.0], [2.0, 1.0]], &faer::mat![[1.0], [1.0]]).is_none());
    }

    #[test]
    fn whitened_residuals_weigh_as_the_inverse_covariance() {
        let (c, r) = (example(), [0.3, -1.0, 2.0]);
        let w = whitening(&c).expect("positive definite");
        let white = &w * Mat::from_fn(3, 1, |i, _| r[i]);
        let squares: f64 = (0..3).map(|i| 0.5 * white[(i, 0)].powi(2)).sum();
        let inverse = inverse_spd(&c).expect("positive definite");
        approx::assert_relative_eq!(squares, half_quadratic(&inverse, &r), epsilon = 1e-12);
    }
}
