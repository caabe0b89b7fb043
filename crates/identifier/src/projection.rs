//! Weights kept in a ball.

use nn_basis::{Scalar, dot, real};

use crate::certificate::{difference, positive_part};
use crate::error::{IdentifierError, positive};
use crate::{Certificate, Exponential, Law, Model, Sample, Step};

/// Any law, its weights drawn back to the ball `‖Ŵ‖ ≤ R` after each step.
///
/// Against comparison weights inside the ball this only lowers L, so the law's balance becomes an upper bound. Over
/// [`Exponential`], with `‖φ‖ ≤ Φ` and `|ε| ≤ z`: `limsup |x̃| ≤ (2 R Φ + z)/a`, whatever happens.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Projection<T, L = Exponential<T>> {
    law: L,
    radius: T,
}

impl<T: Scalar, L> Projection<T, L> {
    /// The law `law` with weights of at most the norm `radius`, unit of the output per second.
    ///
    /// # Errors
    /// [`IdentifierError::NotPositive`] if the radius is not a finite number above zero.
    pub fn new(law: L, radius: T) -> Result<Self, IdentifierError> {
        Ok(Self { law, radius: positive("radius of the projection", radius)? })
    }

    /// The largest norm of the weights.
    pub fn radius(&self) -> T {
        self.radius
    }

    /// The nearest weights in the ball.
    #[inline(always)]
    fn project<const N: usize>(&self, mut weight: [T; N]) -> [T; N] {
        let square = dot(&weight, &weight);
        let outside = self.radius / square.sqrt();
        let share = (self.radius * self.radius).if_less(square, outside, T::one());
        for w in &mut weight {
            *w *= share;
        }
        weight
    }
}

impl<T: Scalar, L: Law<T, N>, const N: usize> Law<T, N> for Projection<T, L> {
    #[inline(always)]
    fn advance(&self, pole: T, model: &Model<T, N>, sample: &Sample<T, N>) -> Step<T, N> {
        let free = self.law.advance(pole, model, sample);
        let after = Model { weight: self.project(free.after.weight), ..free.after };
        Step { after, ..free }
    }

    #[inline(always)]
    fn certify(&self, pole: T, step: &Step<T, N>, comparison: &[T; N]) -> Certificate<T> {
        let free = self.law.advance(pole, &step.before, &step.sample);
        let c = self.law.certify(pole, &free, comparison);
        // Never positive for comparison weights inside the ball.
        let moved = difference(&free.after.weight, &step.after.weight, comparison);
        let moved = real::<T>(0.5) * moved / self.law.gain();
        Certificate {
            after: c.after + moved,
            change: c.change + moved,
            predicted: c.predicted + positive_part(moved),
            ..c
        }
    }

    fn gain(&self) -> T {
        self.law.gain()
    }
}
