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
    #[inline(always)]
    pub fn apply<T: Scalar>(self, z: T) -> T {
        match self {
            Self::Logistic => z.logistic(),
            Self::Tanh => z.tanh(),
        }
    }
}
