//! The adaptable second layer.

use crate::{Scalar, dot};

/// `y = Wᵀ φ`: R outputs that are linear in the N × R weights (Eq. 3 of Hendzel & Trojnacki 2014).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearNet<T, const N: usize, const R: usize> {
    /// One column of W per output, in the unit of that output.
    pub weight: [[T; N]; R],
}

impl<T: Scalar, const N: usize, const R: usize> Default for LinearNet<T, N, R> {
    /// All weights zero: nothing learned yet, as in the paper.
    fn default() -> Self {
        Self { weight: [[T::zero(); N]; R] }
    }
}

impl<T: Scalar, const N: usize, const R: usize> LinearNet<T, N, R> {
    /// The outputs for a regressor.
    #[inline(always)]
    pub fn output(&self, phi: &[T; N]) -> [T; R] {
        self.weight.map(|w| dot(&w, phi))
    }

    /// Adds `rate · φ` to the weights of one output, minus a leak: `w += rate φ − leak w`.
    ///
    /// The explicit form of the gradient laws `Ẇ = Γ (φ s − κ |s| W)`, with rate = h Γ s and leak = h Γ κ |s|.
    /// An `output` that does not exist is ignored.
    #[inline(always)]
    pub fn adapt(&mut self, output: usize, phi: &[T; N], rate: T, leak: T) {
        if let Some(weight) = self.weight.get_mut(output) {
            for (w, p) in weight.iter_mut().zip(phi) {
                *w += rate * *p - leak * *w;
            }
        }
    }
}
