//! A regressor that does not depend on the input.

use crate::{Basis, BasisError, Scalar};

/// The same φ for every input.
///
/// An identifier over it is a pure integrator: the baseline that tells what a network adds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constant<T, const N: usize> {
    phi: [T; N],
}

impl<T: Scalar, const N: usize> Constant<T, N> {
    /// A basis that always returns `phi`.
    ///
    /// # Errors
    /// [`BasisError::Threshold`] if an entry is not finite.
    pub fn new(phi: [T; N]) -> Result<Self, BasisError> {
        match phi.iter().position(|p| !p.is_finite()) {
            Some(unit) => Err(BasisError::Threshold { unit }),
            None => Ok(Self { phi }),
        }
    }
}

impl<T: Scalar, const I: usize, const N: usize> Basis<T, I, N> for Constant<T, N> {
    #[inline(always)]
    fn regressor(&self, _input: &[T; I]) -> [T; N] {
        self.phi
    }
}
