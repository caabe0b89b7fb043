//! The little dense algebra the diagnosis needs, over faer.

use faer::linalg::solvers::Solve;
use faer::{Mat, Side};

/// Solution and log-determinant of `M x = B` for a symmetric positive definite `M`; `None` if it is not.
pub fn solve_spd(m: &Mat<f64>, b: &Mat<f64>) -> Option<(Mat<f64>, f64)> {
    let llt = m.llt(Side::Lower).ok()?;
    let l = llt.L();
    let logdet = 2.0 * (0..m.nrows()).map(|i| l[(i, i)].ln()).sum::<f64>();
    let x = llt.solve(b);
    (logdet.is_finite()).then_some((x, logdet))
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

    #[test]
    fn elimination_is_the_schur_complement() {
        let m = faer::mat![[4.0, 1.0, 2.0], [1.0, 3.0, 0.5], [2.0, 0.5, 5.0]];
        let s = eliminate(&m, 1).expect("positive definite");
        approx::assert_relative_eq!(s[(0, 0)], 4.0 - 2.0 * 2.0 / 5.0, epsilon = 1e-14);
        approx::assert_relative_eq!(s[(0, 1)], 1.0 - 2.0 * 0.5 / 5.0, epsilon = 1e-14);
        let (x, logdet) = solve_spd(&m, &faer::mat![[1.0], [2.0], [3.0]]).expect("positive definite");
        let back = &m * &x;
        approx::assert_relative_eq!(back[(2, 0)], 3.0, epsilon = 1e-12);
        approx::assert_relative_eq!(logdet, m.determinant().ln(), epsilon = 1e-12);
        assert!(solve_spd(&faer::mat![[1.0, 2.0], [2.0, 1.0]], &faer::mat![[1.0], [1.0]]).is_none());
    }
}
