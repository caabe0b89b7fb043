//! The exact exponential step with an a-posteriori update, with or without a dead zone.

use nn_basis::{Scalar, dot, real};

use crate::certificate::{Balance, approximation_error};
use crate::error::{IdentifierError, finite, positive};
use crate::law::moved;
use crate::{Certificate, Law, Model, Sample, Step};

/// The gradient law with an exact exponential step of x̂ and an update by the error that remains after it.
///
/// With `ρ = e^(−ah)`, `b = (1 − ρ)/a` and the a-priori error `x̃° = x_{k+1} − ρ x̂_k − b Ŵ_kᵀφ`:
/// `x̃_{k+1} = x̃°/(1 + γ b² ‖φ‖²)`, `Ŵ_{k+1} = Ŵ_k + γ b φ x̃_{k+1}`, `x̂_{k+1} = x_{k+1} − x̃_{k+1}`.
/// Exactly, for any h, γ, φ and W*, with `ε = (x_{k+1} − ρ x_k)/b − W*ᵀφ`:
/// `ΔL = −½(x̃_{k+1} − ρ x̃_k)² − ½(1 − ρ²) x̃_k² − ½ γ b² ‖φ‖² x̃_{k+1}² + b ε x̃_{k+1}`.
///
/// With a dead zone `d = z/a` the weights rest while `|x̃°| ≤ d` and follow the excess
/// `D(x̃) = sign(x̃) max(|x̃| − d, 0)` beyond. `L_D = ½ D² + ‖W* − Ŵ‖²/(2γ)` then never rises while `|ε| ≤ z`, so that
/// `‖W* − Ŵ_k‖² ≤ ‖W* − Ŵ_0‖² + γ D_0²` and `limsup |x̃| ≤ z/a`: Eq. 22 of Hendzel & Trojnacki 2014 made true.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exponential<T> {
    gain: T,
    tolerated: T,
}

impl<T: Scalar> Exponential<T> {
    /// The law with adaptation gain γ and no dead zone.
    ///
    /// # Errors
    /// [`IdentifierError::NotPositive`] if the gain is not a finite number above zero.
    pub fn new(gain: T) -> Result<Self, IdentifierError> {
        Self::with_dead_zone(gain, T::zero())
    }

    /// The law with a dead zone that tolerates approximation errors up to z, unit of the output per second.
    ///
    /// # Errors
    /// [`IdentifierError`] if the gain is not positive, or z negative or not finite.
    pub fn with_dead_zone(gain: T, z: T) -> Result<Self, IdentifierError> {
        let tolerated = finite("tolerated approximation error z", z)?;
        if !T::zero().is_at_most(tolerated) {
            return Err(IdentifierError::Negative { name: "tolerated approximation error z" });
        }
        Ok(Self { gain: positive("gain gamma", gain)?, tolerated })
    }

    /// ρ, b and the width d of the dead zone.
    #[inline(always)]
    fn constants(&self, pole: T, h: T) -> [T; 3] {
        // Not 1 − e^(−ah): that would cancel for short steps.
        let risen = -(-pole * h).exp_m1();
        [T::one() - risen, risen / pole, self.tolerated / pole]
    }
}

/// `sign(x) max(|x| − d, 0)`; not a number stays not a number.
#[inline(always)]
fn excess<T: Scalar>(x: T, d: T) -> T {
    let sign = x.if_less(T::zero(), -T::one(), T::one());
    d.if_less(x.abs(), x - d * sign, T::zero() * x.abs())
}

impl<T: Scalar, const N: usize> Law<T, N> for Exponential<T> {
    #[inline(always)]
    fn advance(&self, pole: T, model: &Model<T, N>, sample: &Sample<T, N>) -> Step<T, N> {
        let phi = &sample.regressor;
        let [rho, b, d] = self.constants(pole, sample.h);
        let prior = sample.end - rho * model.output - b * (dot(&model.weight, phi) + sample.known);
        // |x̃| − d after the update is (|x̃°| − d)/(1 + γ b² ‖φ‖²).
        let error = excess(prior, d) / (T::one() + self.gain * b * b * dot(phi, phi));
        let weight = moved(&model.weight, self.gain * b * error, phi);
        let after = error + (prior - excess(prior, d));
        Step::new(sample, model, Model { output: sample.end - after, weight }, error)
    }

    #[inline(always)]
    fn certify(&self, pole: T, step: &Step<T, N>, comparison: &[T; N]) -> Certificate<T> {
        let (half, sample, phi) = (real::<T>(0.5), &step.sample, &step.sample.regressor);
        let [rho, b, d] = self.constants(pole, sample.h);
        let shown = (sample.end - rho * sample.start) / b;
        let (from, to) = (excess(step.error_before, d), step.error);
        let (error, scale) = approximation_error(shown, sample, comparison);
        // What the dead zone does not tolerate.
        let epsilon = excess(error, self.tolerated);
        let dissipation = half * (T::one() - rho * rho);
        let tolerated = b * (error * to - self.tolerated * to.abs() - epsilon * to);
        // −½(D₊ − ρD)² − ½(1 − ρ²)D² is −½(1 − ρ²)D₊² and a square.
        let lag = from - rho * to;
        let surplus = tolerated - half * (lag * lag + self.gain * b * b * dot(phi, phi) * to * to);
        Balance {
            output: [from, to],
            error: to,
            epsilon,
            scale,
            dissipation,
            coupling: b,
            surplus,
            slack: self.tolerated,
        }
        .certificate(step, comparison, self.gain)
    }

    fn gain(&self) -> T {
        self.gain
    }
}
