//! The implicit midpoint scheme.

use nn_basis::{Scalar, dot, real};

use crate::certificate::{difference_of_squares, lyapunov};
use crate::error::{IdentifierError, positive};
use crate::{Certificate, Law, Model, Sample, Step};

/// The gradient law `d/dt Ŵ = γ φ x̃` (Eq. 20 of Hendzel & Trojnacki 2014) by the implicit midpoint rule.
///
/// With `x_m = ½(x_k + x_{k+1})` and `q = ¼ h² γ ‖φ‖²` the implicit equations have a closed solution:
/// `x̃_m = ((1 + ½ah) x_m − x̂_k − ½h Ŵ_kᵀφ) / (1 + ½ah + q)`,
/// `x̂_{k+1} = 2 (x_m − x̃_m) − x̂_k`, `Ŵ_{k+1} = Ŵ_k + h γ φ x̃_m`.
///
/// Exactly, for any h, γ, φ and W*: `ΔL = −a h x̃_m² + h ε x̃_m`, where
/// `ε = (x_{k+1} − x_k)/h + a x_m − W*ᵀφ`. So L falls whenever `|x̃_m| > |ε|/a`. Second order in h.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Midpoint<T> {
    gain: T,
}

impl<T: Scalar> Midpoint<T> {
    /// The law with adaptation gain γ (the paper's 500).
    ///
    /// # Errors
    /// [`IdentifierError::NotPositive`] if the gain is not a finite number above zero.
    pub fn new(gain: T) -> Result<Self, IdentifierError> {
        Ok(Self { gain: positive("gain gamma", gain)? })
    }
}

impl<T: Scalar, const N: usize> Law<T, N> for Midpoint<T> {
    #[inline]
    fn advance(&self, pole: T, model: &Model<T, N>, sample: &Sample<T, N>) -> Step<T, N> {
        let (half, two) = (real::<T>(0.5), real::<T>(2.0));
        let Sample { start, end, regressor: phi, h } = *sample;
        let q = real::<T>(0.25) * h * h * self.gain * dot(&phi, &phi);
        let damping = T::one() + half * pole * h;
        let mid = half * (start + end);
        // Formed directly: x_m − x̂_m would cancel all digits where q is large.
        let mismatch = damping * mid - model.output - half * h * dot(&model.weight, &phi);
        let error_mid = mismatch / (damping + q);
        let output = two * (mid - error_mid) - model.output;
        let change = h * self.gain * error_mid;
        let mut weight = model.weight;
        for (w, p) in weight.iter_mut().zip(&phi) {
            *w += change * *p;
        }
        let error_before = start - model.output;
        Step {
            sample: *sample,
            before: *model,
            after: Model { output, weight },
            error_before,
            error_mid,
            error_after: end - output,
            innovation: two * mismatch / damping - error_before,
        }
    }

    #[inline]
    fn certify(&self, pole: T, step: &Step<T, N>, comparison: &[T; N]) -> Certificate<T> {
        let Sample { start, end, regressor: phi, h } = step.sample;
        let error = step.error_mid;
        let epsilon = (end - start) / h + pole * real::<T>(0.5) * (start + end) - dot(comparison, &phi);
        let dissipated = pole * h * error * error;
        let injected = h * epsilon * error;
        let before = lyapunov(step.error_before, &step.before.weight, comparison, self.gain);
        let after = lyapunov(step.error_after, &step.after.weight, comparison, self.gain);
        let change = difference_of_squares(step, comparison, self.gain);
        let predicted = injected - dissipated;
        let size = before + after + dissipated + injected.abs();
        // Not `size > 0`: a size that is not a number must give a residual that is not a number.
        let residual = if size == T::zero() { T::zero() } else { (change - predicted).abs() / size };
        let bound = h * epsilon * epsilon / (real::<T>(4.0) * pole);
        Certificate { before, after, change, predicted, bound, residual, epsilon, error, h }
    }

    fn gain(&self) -> T {
        self.gain
    }
}
