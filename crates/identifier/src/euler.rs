//! Forward Euler, for comparison.

use nn_basis::{Scalar, dot, real};

use crate::certificate::{Balance, approximation_error};
use crate::error::{IdentifierError, positive};
use crate::law::moved;
use crate::{Certificate, Law, Model, Sample, Step};

/// The gradient law (Eq. 20 of Hendzel & Trojnacki 2014) by simultaneous forward Euler steps: for comparison only.
///
/// `x̂_{k+1} = x̂_k + h (−a x̂_k + Ŵ_kᵀφ)`, `Ŵ_{k+1} = Ŵ_k + h γ φ x̃_k`. Exactly, with `e = (W* − Ŵ_k)ᵀφ` and
/// `ε = (x_{k+1} − x_k)/h + a x_k − W*ᵀφ`:
/// `ΔL = −a h x̃² + h ε x̃ + ½ h² (−a x̃ + e + ε)² + ½ h² γ ‖φ‖² x̃²`.
///
/// The last two terms are a surplus that no step size takes away: where `x̃ = 0` and `e ≠ 0`, L rises even without
/// approximation error, and regressors that turn with the weights make it grow without bound.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Euler<T> {
    gain: T,
}

impl<T: Scalar> Euler<T> {
    /// The law with adaptation gain γ.
    ///
    /// # Errors
    /// [`IdentifierError::NotPositive`] if the gain is not a finite number above zero.
    pub fn new(gain: T) -> Result<Self, IdentifierError> {
        Ok(Self { gain: positive("gain gamma", gain)? })
    }

    /// The step size, s, below which one step without approximation error raises L by at most `½ h² (1 + a h) e²`:
    /// `a/(a² + γ ‖φ‖²)` for a regressor of squared norm `regressor_square`.
    pub fn largest_step(&self, pole: T, regressor_square: T) -> T {
        pole / (pole * pole + self.gain * regressor_square)
    }
}

impl<T: Scalar, const N: usize> Law<T, N> for Euler<T> {
    #[inline(always)]
    fn advance(&self, pole: T, model: &Model<T, N>, sample: &Sample<T, N>) -> Step<T, N> {
        let (h, phi) = (sample.h, &sample.regressor);
        let error = sample.start - model.output;
        let output = model.output + h * (dot(&model.weight, phi) + sample.known - pole * model.output);
        let weight = moved(&model.weight, h * self.gain * error, phi);
        Step::new(sample, model, Model { output, weight }, error)
    }

    #[inline(always)]
    fn certify(&self, pole: T, step: &Step<T, N>, comparison: &[T; N]) -> Certificate<T> {
        let Sample { start, end, regressor: phi, h, .. } = &step.sample;
        let (epsilon, scale) = approximation_error((*end - *start) / *h + pole * *start, &step.sample, comparison);
        let error = step.error;
        let estimation = dot(comparison, phi) - dot(&step.before.weight, phi);
        let rate = estimation + epsilon - pole * error;
        let surplus = real::<T>(0.5) * *h * *h * (rate * rate + self.gain * dot(phi, phi) * error * error);
        Balance {
            output: [step.error_before, step.error_after],
            error,
            epsilon,
            scale,
            dissipation: pole * *h,
            coupling: *h,
            surplus,
            slack: T::zero(),
        }
        .certificate(step, comparison, self.gain)
    }

    fn gain(&self) -> T {
        self.gain
    }
}
