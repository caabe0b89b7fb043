//! An identifier that keeps what it learned.

use nn_basis::dot;

use crate::error::IdentifierError;
use crate::{Certificate, Field, Identifier, Law, Memory, Midpoint, Sample, Step};

/// The paper's identifier with a [`Memory`] beside it.
///
/// `d/dt x̂ = −a x̂ + (W_m + Ŵ)ᵀφ`: the memory's weights W_m come by least squares from what was seen, and the gradient
/// law's Ŵ follow what is left. Pole, gain and regressor are the paper's. To the gradient law `W_mᵀφ` is a known part of
/// the right-hand side, so every certificate of the law holds as it is, with `ε = G − W_mᵀφ − W*ᵀφ`: the memory enters as
/// a bounded term, and the better it knows, the smaller ε is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Retaining<T: Field, const N: usize, L = Midpoint<T>> {
    identifier: Identifier<T, N, L>,
    memory: Memory<T, N>,
}

impl<T: Field, const N: usize, L: Law<T, N>> Retaining<T, N, L> {
    /// An identifier with a memory; `pole`, `law` and `output` as for [`Identifier::new`].
    ///
    /// # Errors
    /// [`IdentifierError`] names what cannot be used.
    pub fn new(pole: T, law: L, output: T, memory: Memory<T, N>) -> Result<Self, IdentifierError> {
        Ok(Self { identifier: Identifier::new(pole, law, output)?, memory })
    }

    /// Follows a sample with what the memory knew before it, then takes it in.
    #[inline(always)]
    pub fn follow(&mut self, sample: &Sample<T, N>) -> Step<T, N> {
        let remembered = dot(&self.memory.acting(), &sample.regressor);
        let step = self.identifier.follow(&Sample { known: sample.known + remembered, ..*sample });
        self.memory.learn(sample.right_hand_side(self.identifier.pole()) - sample.known, &sample.regressor, sample.h);
        step
    }

    /// The certificate of a step against the comparison weights `w_star` of the gradient law.
    #[inline(always)]
    pub fn certificate(&self, step: &Step<T, N>, w_star: &[T; N]) -> Certificate<T> {
        self.identifier.certificate(step, w_star)
    }

    /// The gradient law's part.
    pub fn identifier(&self) -> &Identifier<T, N, L> {
        &self.identifier
    }

    /// What is kept.
    pub fn memory(&self) -> &Memory<T, N> {
        &self.memory
    }

    /// The weights that act now, `W_m + Ŵ`.
    pub fn weight(&self) -> [T; N] {
        let mut weight = self.memory.acting();
        for (w, g) in weight.iter_mut().zip(&self.identifier.model().weight) {
            *w += *g;
        }
        weight
    }
}
