//! The identifier, and what an adaptive law must provide.

use nn_basis::Scalar;

use crate::error::{IdentifierError, finite, positive};
use crate::{Certificate, Midpoint};

/// One interval of the recorded output.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample<T, const N: usize> {
    /// Measured output at the start, `x_k`.
    pub start: T,
    /// Measured output at the end, `x_{k+1}`.
    pub end: T,
    /// Regressor φ over the interval.
    pub regressor: [T; N],
    /// What is known of G over the interval besides `Ŵᵀφ`, in the unit of the output per second: mostly zero.
    pub known: T,
    /// Length of the interval h, s.
    pub h: T,
}

impl<T: Scalar, const N: usize> Sample<T, N> {
    /// The mean output `x_m = ½(x_k + x_{k+1})`.
    #[inline(always)]
    pub fn middle(&self) -> T {
        nn_basis::real::<T>(0.5) * (self.start + self.end)
    }

    /// The right-hand side that the interval shows by the midpoint rule, `(x_{k+1} − x_k)/h + a x_m`.
    #[inline(always)]
    pub fn right_hand_side(&self, pole: T) -> T {
        (self.end - self.start) / self.h + pole * self.middle()
    }
}

/// What the identifier believes: the estimate x̂ and the weights Ŵ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Model<T, const N: usize> {
    /// Estimated output x̂, in the unit of the output.
    pub output: T,
    /// Weights Ŵ, in the unit of the output per second.
    pub weight: [T; N],
}

/// One step of an identifier, complete: enough to certify it afterwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step<T, const N: usize> {
    /// The interval.
    pub sample: Sample<T, N>,
    /// The model before.
    pub before: Model<T, N>,
    /// The model after.
    pub after: Model<T, N>,
    /// Error x̃ = x − x̂ at the start.
    pub error_before: T,
    /// The error e that drove the weights: at the start, in the middle or at the end, as the law has it.
    pub error: T,
    /// Error x̃ = x − x̂ at the end.
    pub error_after: T,
}

impl<T: Scalar, const N: usize> Step<T, N> {
    /// The step from a model to the next.
    #[inline(always)]
    pub(crate) fn new(sample: &Sample<T, N>, before: &Model<T, N>, after: Model<T, N>, error: T) -> Self {
        let (error_before, error_after) = (sample.start - before.output, sample.end - after.output);
        Self { sample: *sample, before: *before, after, error_before, error, error_after }
    }
}

/// A discrete adaptive law: how x̂ and Ŵ advance over one interval, and what that does to L.
pub trait Law<T: Scalar, const N: usize> {
    /// Advances the model over the sample; `pole` is a, 1/s.
    ///
    /// Never panics and never branches on more than signs; input that is not finite gives output that is not finite.
    fn advance(&self, pole: T, model: &Model<T, N>, sample: &Sample<T, N>) -> Step<T, N>;

    /// The certificate of a step of this law against the comparison weights W*.
    fn certify(&self, pole: T, step: &Step<T, N>, comparison: &[T; N]) -> Certificate<T>;

    /// Adaptation gain γ.
    fn gain(&self) -> T;
}

/// `Ŵ + rate φ`.
#[inline(always)]
pub(crate) fn moved<T: Scalar, const N: usize>(weight: &[T; N], rate: T, phi: &[T; N]) -> [T; N] {
    let mut weight = *weight;
    for (w, p) in weight.iter_mut().zip(phi) {
        *w += rate * *p;
    }
    weight
}

/// Follows one output online.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Identifier<T, const N: usize, L = Midpoint<T>> {
    pole: T,
    law: L,
    model: Model<T, N>,
}

impl<T: Scalar, const N: usize, L: Law<T, N>> Identifier<T, N, L> {
    /// An identifier with zero weights, as in the paper.
    ///
    /// `pole`: a > 0 of A = −a I, 1/s (the paper's 8); `output`: x̂(0).
    ///
    /// # Errors
    /// [`IdentifierError`] if the pole is not positive or the start value not finite.
    pub fn new(pole: T, law: L, output: T) -> Result<Self, IdentifierError> {
        Ok(Self {
            pole: positive("pole a", pole)?,
            law,
            model: Model { output: finite("start value of the estimate", output)?, weight: [T::zero(); N] },
        })
    }

    /// Advances over one interval of the measured output, from `x_k` to `x_k1` in `h` seconds with regressor `phi`.
    ///
    /// Never panics; input that is not finite gives a step that is not finite.
    #[inline(always)]
    pub fn step(&mut self, x_k: T, x_k1: T, phi: &[T; N], h: T) -> Step<T, N> {
        self.follow(&Sample { start: x_k, end: x_k1, regressor: *phi, known: T::zero(), h })
    }

    /// The same for a sample of whose right-hand side a part is known.
    #[inline(always)]
    pub fn follow(&mut self, sample: &Sample<T, N>) -> Step<T, N> {
        let step = self.law.advance(self.pole, &self.model, sample);
        self.model = step.after;
        step
    }

    /// The certificate of a step against the comparison weights `w_star`; see [`Certificate`].
    #[inline(always)]
    pub fn certificate(&self, step: &Step<T, N>, w_star: &[T; N]) -> Certificate<T> {
        self.law.certify(self.pole, step, w_star)
    }

    /// What the identifier believes now.
    pub fn model(&self) -> &Model<T, N> {
        &self.model
    }

    /// The pole a, 1/s.
    pub fn pole(&self) -> T {
        self.pole
    }
}
