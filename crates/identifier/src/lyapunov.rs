//! The Lyapunov equation, solved on a host.

use std::vec::Vec;
use std::{format, string::String};

use faer::Mat;
use faer::linalg::solvers::Solve;

use crate::HurwitzMatrix;

/// Why a matrix got no P.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LyapunovError {
    /// An entry is NaN or infinite.
    #[error("the entry in row {row}, column {column} of {matrix} is not a finite number")]
    NotFinite {
        /// Which matrix, A or Q.
        matrix: &'static str,
        /// Row, from 0.
        row: usize,
        /// Column, from 0.
        column: usize,
    },
    /// The eigenvalues did not converge.
    #[error("the eigenvalues of A cannot be computed")]
    NoEigenvalues,
    /// A does not decay in all directions.
    #[error("A is not Hurwitz: its eigenvalues are {}, but all real parts must be negative", listed(.eigenvalues))]
    NotHurwitz {
        /// All eigenvalues, real and imaginary part, 1/s.
        eigenvalues: Vec<[f64; 2]>,
    },
    /// Q is not symmetric and positive definite, or so badly scaled that P is not.
    #[error("no proof: {what}")]
    NotProved {
        /// What is missing.
        what: &'static str,
    },
}

fn listed(eigenvalues: &[[f64; 2]]) -> String {
    let one = |[re, im]: &[f64; 2]| match im {
        0.0 => format!("{re:.6}"),
        _ => format!("{re:.6} {} {:.6}i", if *im < 0.0 { '-' } else { '+' }, im.abs()),
    };
    eigenvalues.iter().map(one).collect::<Vec<_>>().join(", ")
}

impl<const M: usize> HurwitzMatrix<f64, M> {
    /// Solves `AᵀP + PA = −Q` for P; `a` and `q` in row order, 1/s, q symmetric and positive definite.
    ///
    /// The M² linear equations `(I ⊗ Aᵀ + Aᵀ ⊗ I) vec P = −vec Q` are solved by LU with partial pivoting.
    ///
    /// # Errors
    /// [`LyapunovError`], with the eigenvalues of an A that is not Hurwitz.
    pub fn solve(a: [[f64; M]; M], q: [[f64; M]; M]) -> Result<Self, LyapunovError> {
        for (matrix, rows) in [("A", &a), ("Q", &q)] {
            for (row, entries) in rows.iter().enumerate() {
                if let Some(column) = entries.iter().position(|v| !v.is_finite()) {
                    return Err(LyapunovError::NotFinite { matrix, row, column });
                }
            }
        }
        let eigenvalues = Mat::from_fn(M, M, |i, j| a[i][j]).eigenvalues().map_err(|_| LyapunovError::NoEigenvalues)?;
        if eigenvalues.iter().any(|e| e.re >= 0.0) {
            return Err(LyapunovError::NotHurwitz { eigenvalues: eigenvalues.iter().map(|e| [e.re, e.im]).collect() });
        }
        // Entry (i, j) of AᵀP + PA is Σ_k a_ki p_kj + p_ik a_kj; P is stored row by row.
        let equations = Mat::from_fn(M * M, M * M, |e, u| {
            let ((i, j), (k, l)) = ((e / M, e % M), (u / M, u % M));
            (if l == j { a[k][i] } else { 0.0 }) + (if k == i { a[l][j] } else { 0.0 })
        });
        let right = Mat::from_fn(M * M, 1, |e, _| -q[e / M][e % M]);
        let solution = equations.partial_piv_lu().solve(&right);
        let p: [[f64; M]; M] = core::array::from_fn(|i| {
            core::array::from_fn(|j| 0.5 * (solution[(i * M + j, 0)] + solution[(j * M + i, 0)]))
        });
        Self::new(a, p).map_err(|e| match e {
            crate::IdentifierError::NotProved { what } => LyapunovError::NotProved { what },
            _ => LyapunovError::NotProved { what: "P is not finite" },
        })
    }
}
