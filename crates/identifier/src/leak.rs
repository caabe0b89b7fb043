//! Weights that leak: sigma- and e-modification.

use nn_basis::{Scalar, dot, real};

use crate::certificate::{difference, worse};
use crate::error::{IdentifierError, positive};
use crate::{Certificate, Law, Midpoint, Model, Sample, Step};

/// How fast weights leak.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rate<T> {
    /// σ-modification `d/dt Ŵ = γ (φ x̃ − σ Ŵ)`: always.
    Sigma(T),
    /// e-modification `d/dt Ŵ = γ (φ x̃ − κ |x̃| Ŵ)`: in proportion to the error.
    Error(T),
}

/// Any law, its weights leaking afterwards by an implicit step, `Ŵ_{k+1} = Ŵ/(1 + γ h s)` with s = σ or κ|e|.
///
/// This adds exactly `½ h s (‖W*‖² − ‖Ŵ_{k+1}‖² − ‖W* − Ŵ_{k+1}‖²) − ½ γ h² s² ‖Ŵ_{k+1}‖²` to the change of L: a surplus
/// of at most `½ h s ‖W*‖²`, and a pull on weights that are far from W*. Weights stay bounded for ever; the price is that
/// what was learned leaks as well.
///
/// Sources: Ioannou & Kokotovic 1984 (σ); Narendra & Annaswamy 1987 (e).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Leaky<T, L = Midpoint<T>> {
    law: L,
    rate: Rate<T>,
}

impl<T: Scalar, L> Leaky<T, L> {
    /// The law `law` with a leak.
    ///
    /// # Errors
    /// [`IdentifierError::NotPositive`] if σ or κ is not a finite number above zero.
    pub fn new(law: L, rate: Rate<T>) -> Result<Self, IdentifierError> {
        match rate {
            Rate::Sigma(sigma) => positive("leak sigma", sigma)?,
            Rate::Error(kappa) => positive("leak kappa", kappa)?,
        };
        Ok(Self { law, rate })
    }

    #[inline(always)]
    fn strength(&self, error: T) -> T {
        match self.rate {
            Rate::Sigma(sigma) => sigma,
            Rate::Error(kappa) => kappa * error.abs(),
        }
    }
}

impl<T: Scalar, L: Law<T, N>, const N: usize> Law<T, N> for Leaky<T, L> {
    #[inline(always)]
    fn advance(&self, pole: T, model: &Model<T, N>, sample: &Sample<T, N>) -> Step<T, N> {
        let free = self.law.advance(pole, model, sample);
        let kept = T::one() / (T::one() + self.law.gain() * sample.h * self.strength(free.error));
        let mut weight = free.after.weight;
        for w in &mut weight {
            *w *= kept;
        }
        Step { after: Model { weight, ..free.after }, ..free }
    }

    #[inline(always)]
    fn certify(&self, pole: T, step: &Step<T, N>, comparison: &[T; N]) -> Certificate<T> {
        let (half, gain) = (real::<T>(0.5), self.law.gain());
        let free = self.law.advance(pole, &step.before, &step.sample);
        let c = self.law.certify(pole, &free, comparison);
        let moved = half * difference(&free.after.weight, &step.after.weight, comparison) / gain;
        let leak = step.sample.h * self.strength(free.error);
        let weight = &step.after.weight;
        // h s Ŵᵀ(W* − Ŵ) − ½ γ h² s² ‖Ŵ‖², the same without the three squares.
        let added =
            leak * (dot(weight, comparison) - dot(weight, weight)) - half * gain * leak * leak * dot(weight, weight);
        let size = c.before + c.after + leak * (dot(weight, weight) + dot(comparison, comparison));
        let gap = T::zero().if_less(size, (moved - added).abs() / size, size);
        Certificate {
            after: c.after + moved,
            change: c.change + moved,
            predicted: c.predicted + added,
            residual: worse(c.residual, gap),
            ..c
        }
    }

    fn gain(&self) -> T {
        self.law.gain()
    }
}
