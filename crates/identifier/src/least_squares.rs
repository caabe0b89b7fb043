//! Recursive least squares over a span of the past.

use nalgebra::{SMatrix, SVector};
use nn_basis::real;

use crate::Field;
use crate::error::{IdentifierError, finite, positive};

/// How far back least squares reach, what they listen to and how they are held back.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LeastSquaresSettings<T> {
    /// Bandwidth β of the filter `(1 + τ s)/(1 + s/β)²` that both sides of the equation pass, 1/s: noise beyond it does
    /// not count.
    pub bandwidth: T,
    /// Lead τ, s: 0 fits levels; with τ > 0 changes count as well, those faster than 1/τ most.
    pub lead: T,
    /// Rate at which old samples lose weight, 1/s; 0 keeps all.
    pub forgetting: T,
    /// Ridge δ, s: as if the weights had been seen to have their prior value, with a regressor of one, for so long.
    pub ridge: T,
}

impl<T: Field> LeastSquaresSettings<T> {
    fn check(self) -> Result<Self, IdentifierError> {
        positive("bandwidth of the least squares", self.bandwidth)?;
        positive("ridge of the least squares", self.ridge)?;
        not_negative("lead of the least squares", self.lead)?;
        not_negative("forgetting of the least squares", self.forgetting)?;
        Ok(self)
    }
}

pub(crate) fn not_negative<T: Field>(name: &'static str, value: T) -> Result<T, IdentifierError> {
    if finite(name, value)? < real(0.0) { Err(IdentifierError::Negative { name }) } else { Ok(value) }
}

/// Recursive least squares with forgetting and a prior: the W that minimises
/// `Σ h λ (y_f − Wᵀφ_f)² + δ ‖W − W_prior‖²` over the samples so far, λ their discount.
///
/// Kept are `R = Σ h λ φ_f φ_fᵀ` and `r = Σ h λ φ_f y_f`, so that `W = (R + δI)⁻¹ (r + δ W_prior)` by one Cholesky
/// factorisation. In this form the matrix stays positive definite, in single precision and without excitation too, and
/// `‖W − W_prior‖ ≤ √(Σ h λ (y_f − W_priorᵀφ_f)²)/(2√δ)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LeastSquares<T: Field, const N: usize> {
    settings: LeastSquaresSettings<T>,
    /// Both stages of the filter, of the target and of the regressor.
    target: [T; 2],
    regressor: [SVector<T, N>; 2],
    information: SMatrix<T, N, N>,
    cross: SVector<T, N>,
}

impl<T: Field, const N: usize> LeastSquares<T, N> {
    /// Least squares that have seen nothing.
    ///
    /// # Errors
    /// [`IdentifierError`] names the setting that cannot be used.
    pub fn new(settings: LeastSquaresSettings<T>) -> Result<Self, IdentifierError> {
        Ok(Self {
            settings: settings.check()?,
            target: [real(0.0); 2],
            regressor: [SVector::zeros(); 2],
            information: SMatrix::zeros(),
            cross: SVector::zeros(),
        })
    }

    /// Takes in `y = Wᵀφ`, as it was over `h` seconds, and returns the best W given a prior.
    ///
    /// The work is the same for every sample. `None` takes input that is not finite.
    pub fn learn(&mut self, y: T, phi: &[T; N], h: T, prior: &[T; N]) -> Option<[T; N]> {
        let (phi, prior) = (SVector::from(*phi), SVector::from(*prior));
        let s = &self.settings;
        let share = relaxed(s.bandwidth, h);
        self.target[0] += (y - self.target[0]) * share;
        self.target[1] += (self.target[0] - self.target[1]) * share;
        self.regressor[0] += (phi - self.regressor[0]) * share;
        self.regressor[1] += (self.regressor[0] - self.regressor[1]) * share;
        // β (first − second stage) is the rate of the second.
        let lead = s.lead * s.bandwidth;
        let y = self.target[1] + (self.target[0] - self.target[1]) * lead;
        let phi = self.regressor[1] + (self.regressor[0] - self.regressor[1]) * lead;
        let kept = real::<T>(1.0) - relaxed(s.forgetting, h);
        let weighted = phi * h;
        self.information = (self.information + weighted * phi.transpose()) * kept;
        self.cross = (self.cross + weighted * y) * kept;
        let normal = self.information + SMatrix::identity() * s.ridge;
        Some(normal.cholesky()?.solve(&(self.cross + prior * s.ridge)).into())
    }
}

/// Share of the way that a first-order lag of `rate` (1/s) goes in `h` seconds, by an implicit step.
pub(crate) fn relaxed<T: Field>(rate: T, h: T) -> T {
    let product = rate * h;
    product / (real::<T>(1.0) + product)
}
