//! The function of a neuron.

use crate::Scalar;

/// The function S of a neuron, Eq. 1 of Hendzel & Trojnacki 2014; the paper says "sigmoid" without its polarity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Activation {
    /// `1 / (1 + e^(−z))`, between 0 and 1: half open at rest, so the regressor does not vanish there.
    #[default]
    Logistic,
    /// `tanh z`, between −1 and 1: vanishes at rest.
    Tanh,
}

impl Activation {
    /// The unit's output for its net input z. Finite for every z that is not NaN.
    #[inline]
    pub fn apply<T: Scalar>(self, z: T) -> T {
        match self {
            // e^(−z) may overflow to infinity, whose inverse is the right limit 0.
            Self::Logistic => T::one() / (T::one() + (-z).exp()),
            Self::Tanh => z.tanh(),
        }
    }
}
