//! What can be wrong with a basis.

/// A network that cannot be built.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum BasisError {
    /// A first-layer weight is NaN or infinite.
    #[error("the first-layer weight of unit {unit}, input {input} is not a finite number")]
    Weight {
        /// Row, from 0.
        unit: usize,
        /// Column, from 0.
        input: usize,
    },
    /// A threshold, or an entry of a constant regressor, is NaN or infinite.
    #[error("the threshold of unit {unit} is not a finite number")]
    Threshold {
        /// Row, from 0.
        unit: usize,
    },
    /// An input scale is not a finite number above zero.
    #[error("the scale of input {input} is not a finite number larger than zero")]
    Scale {
        /// Which input, from 0.
        input: usize,
    },
}
