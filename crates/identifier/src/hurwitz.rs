//! A Hurwitz matrix with its proof of stability.

use nalgebra::SMatrix;
use nn_basis::real;

use crate::{Field, IdentifierError};

/// A matrix A with a P that proves it Hurwitz: `AᵀP + PA = −Q` with P and Q symmetric and positive definite.
///
/// Eq. 21 of Hendzel & Trojnacki 2014 bounds `xᵀAx` by the largest eigenvalue of A, which is false for a general A; with P
/// the argument holds. On a host `HurwitzMatrix::solve` (feature `std`) finds P; on a robot it is a constant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HurwitzMatrix<T, const M: usize> {
    a: SMatrix<T, M, M>,
    p: SMatrix<T, M, M>,
    q: SMatrix<T, M, M>,
}

impl<T: Field, const M: usize> HurwitzMatrix<T, M> {
    /// Checks a matrix and its P, both in row order: `a` in 1/s, `p` dimensionless.
    ///
    /// # Errors
    /// [`IdentifierError::NotProved`] if P is not symmetric (to rounding), or P or `−(AᵀP + PA)` not positive definite.
    pub fn new(a: [[T; M]; M], p: [[T; M]; M]) -> Result<Self, IdentifierError> {
        let matrix = |rows: [[T; M]; M]| SMatrix::<T, M, M>::from_fn(|i, j| rows[i][j]);
        let (a, p) = (matrix(a), matrix(p));
        let asymmetry = (p - p.transpose()).norm();
        let symmetric = asymmetry <= real::<T>(8.0) * T::default_epsilon() * p.norm();
        if !symmetric {
            return Err(IdentifierError::NotProved { what: "P is not symmetric" });
        }
        let half = real::<T>(0.5);
        let p = (p + p.transpose()) * half;
        let q = -(a.transpose() * p + p * a);
        if p.cholesky().is_none() {
            return Err(IdentifierError::NotProved { what: "P is not positive definite" });
        }
        if q.cholesky().is_none() {
            return Err(IdentifierError::NotProved { what: "Q = -(A'P + PA) is not positive definite" });
        }
        Ok(Self { a, p, q })
    }

    /// A, 1/s.
    pub fn a(&self) -> &SMatrix<T, M, M> {
        &self.a
    }

    /// P, dimensionless.
    pub fn p(&self) -> &SMatrix<T, M, M> {
        &self.p
    }

    /// Q, 1/s.
    pub fn q(&self) -> &SMatrix<T, M, M> {
        &self.q
    }
}
