//! The implicit midpoint scheme.

use nn_basis::{Scalar, dot, real};

use crate::certificate::{Balance, approximation_error};
use crate::error::{IdentifierError, positive};
use crate::law::moved;
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
    #[inline(always)]
    fn advance(&self, pole: T, model: &Model<T, N>, sample: &Sample<T, N>) -> Step<T, N> {
        let (half, two, h, phi) = (real::<T>(0.5), real::<T>(2.0), sample.h, &sample.regressor);
        let q = real::<T>(0.25) * h * h * self.gain * dot(phi, phi);
        let damping = T::one() + half * pole * h;
        let mid = sample.middle();
        // Formed directly: x_m − x̂_m would cancel all digits where q is large.
        let mismatch = damping * mid - model.output - half * h * (dot(&model.weight, phi) + sample.known);
        let error = mismatch / (damping + q);
        let output = two * (mid - error) - model.output;
        let weight = moved(&model.weight, h * self.gain * error, phi);
        Step::new(sample, model, Model { output, weight }, error)
    }

    #[inline(always)]
    fn certify(&self, pole: T, step: &Step<T, N>, comparison: &[T; N]) -> Certificate<T> {
        let sample = &step.sample;
        let (epsilon, scale) = approximation_error(sample.right_hand_side(pole), sample, comparison);
        Balance {
            output: [step.error_before, step.error_after],
            error: step.error,
            epsilon,
            scale,
            dissipation: pole * sample.h,
            coupling: sample.h,
            surplus: T::zero(),
            slack: T::zero(),
        }
        .certificate(step, comparison, self.gain)
    }

    fn gain(&self) -> T {
        self.gain
    }
}
