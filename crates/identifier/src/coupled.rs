//! Several outputs whose errors act on each other.

use nalgebra::{SMatrix, SVector};
use nn_basis::{Scalar, real};

use crate::error::{IdentifierError, finite, positive};
use crate::{Field, HurwitzMatrix};

/// One interval of M measured outputs, with the regressor φ and the known part of G over it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoupledSample<T, const M: usize, const N: usize> {
    /// Measured outputs at the start.
    pub start: [T; M],
    /// Measured outputs at the end.
    pub end: [T; M],
    /// Regressor φ over the interval.
    pub regressor: [T; N],
    /// What is known of G besides `Ŵᵀφ`, in the unit of the outputs per second.
    pub known: [T; M],
    /// Length of the interval h, s.
    pub h: T,
}

/// What a step did to L, against comparison weights W*.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoupledCertificate<T> {
    /// L before the step.
    pub before: T,
    /// L after the step.
    pub after: T,
    /// The change of L, measured.
    pub change: T,
    /// The change of L by the identity, `h (−½ x̃_mᵀ Q x̃_m + x̃_mᵀ P ε)`.
    pub predicted: T,
    /// How far they are apart, relative to the quantities involved.
    pub residual: T,
}

/// The paper's identifier with a general Hurwitz A (Eq. 13 of Hendzel & Trojnacki 2014) and the law
/// `d/dt Ŵ = γ φ x̃ᵀP`, by the implicit midpoint rule.
///
/// With `AᵀP + PA = −Q`, `L = ½ x̃ᵀPx̃ + tr(W̃ᵀW̃)/(2γ)` obeys, exactly and at any step size,
/// `ΔL = h (−½ x̃_mᵀ Q x̃_m + x̃_mᵀ P ε)`. The middle error solves `(P − ½h PA + ¼h²γ‖φ‖² P²) x̃_m = P r`, whose matrix has a
/// positive definite symmetric part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoupledIdentifier<T, const M: usize, const N: usize> {
    matrix: HurwitzMatrix<T, M>,
    gain: T,
    output: SVector<T, M>,
    weight: SMatrix<T, N, M>,
}

impl<T: Field, const M: usize, const N: usize> CoupledIdentifier<T, M, N> {
    /// An identifier with zero weights that starts at `output`, with gain γ.
    ///
    /// # Errors
    /// [`IdentifierError`] if the gain is not positive or a start value not finite.
    pub fn new(matrix: HurwitzMatrix<T, M>, gain: T, output: [T; M]) -> Result<Self, IdentifierError> {
        for x in output {
            finite("start value of the estimate", x)?;
        }
        Ok(Self { matrix, gain: positive("gain gamma", gain)?, output: output.into(), weight: SMatrix::zeros() })
    }

    /// Advances over a sample; returns the errors x̃ at its end.
    pub fn follow(&mut self, sample: &CoupledSample<T, M, N>) -> [T; M] {
        let (half, two, h) = (real::<T>(0.5), real::<T>(2.0), sample.h);
        let (a, p) = (self.matrix.a(), self.matrix.p());
        let (end, phi) = (SVector::from(sample.end), SVector::from(sample.regressor));
        let mid = (SVector::from(sample.start) + end) * half;
        let known = SVector::from(sample.known);
        let q = real::<T>(0.25) * h * h * self.gain * phi.norm_squared();
        let mismatch = mid - self.output - (a * mid + self.weight.transpose() * phi + known) * (half * h);
        let system = p - p * a * (half * h) + p * p * q;
        // Invertible for every h and φ; a solution that is missing takes input that is not finite.
        let error = system.try_inverse().map_or(mismatch / real::<T>(0.0), |inverse| inverse * (p * mismatch));
        self.output = (mid - error) * two - self.output;
        self.weight += phi * (p * error).transpose() * (h * self.gain);
        (end - self.output).into()
    }

    /// The certificate of the step from `before` to this state over `sample`, against weights W* (a row per unit).
    pub fn certificate(
        &self,
        before: &Self,
        sample: &CoupledSample<T, M, N>,
        w_star: &[[T; M]; N],
    ) -> CoupledCertificate<T> {
        let (half, h) = (real::<T>(0.5), sample.h);
        let (a, p) = (self.matrix.a(), self.matrix.p());
        let (start, end) = (SVector::from(sample.start), SVector::from(sample.end));
        let star = SMatrix::<T, N, M>::from_fn(|i, j| w_star[i][j]);
        let (x0, x1) = (start - before.output, end - self.output);
        let (w0, w1) = (star - before.weight, star - self.weight);
        let energy = |x: &SVector<T, M>, w: &SMatrix<T, N, M>| half * (x.dot(&(p * x)) + w.norm_squared() / self.gain);
        let error = (x0 + x1) * half;
        let shown = (end - start) / h - a * (start + end) * half;
        let epsilon = shown - SVector::from(sample.known) - star.transpose() * SVector::from(sample.regressor);
        let dissipated = half * h * error.dot(&(self.matrix.q() * error));
        let injected = h * error.dot(&(p * epsilon));
        // Differences times sums, as in the scalar balance.
        let change = half * ((x1 - x0).dot(&(p * (x1 + x0))) + (w1 - w0).dot(&(w1 + w0)) / self.gain);
        let (predicted, before, after) = (injected - dissipated, energy(&x0, &w0), energy(&x1, &w1));
        let size = before + after + dissipated + Scalar::abs(injected);
        let residual = if size == real(0.0) { real(0.0) } else { Scalar::abs(change - predicted) / size };
        CoupledCertificate { before, after, change, predicted, residual }
    }

    /// Estimated outputs x̂.
    pub fn output(&self) -> [T; M] {
        self.output.into()
    }

    /// Weights Ŵ, a row per unit.
    pub fn weight(&self) -> [[T; M]; N] {
        core::array::from_fn(|i| core::array::from_fn(|j| self.weight[(i, j)]))
    }
}
