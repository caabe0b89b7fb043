//! What can be wrong with an identifier.

/// An identifier that cannot be built.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum IdentifierError {
    /// A gain must be a finite number above zero.
    #[error("the {name} must be a finite number larger than zero")]
    NotPositive {
        /// Which gain.
        name: &'static str,
    },
    /// A bound must not be negative.
    #[error("the {name} must not be negative")]
    Negative {
        /// Which bound.
        name: &'static str,
    },
    /// A matrix comes without a valid proof of its stability.
    #[error("the stability of A is not proved: {what}")]
    NotProved {
        /// What is missing.
        what: &'static str,
    },
    /// A start value must be finite.
    #[error("the {name} must be a finite number")]
    NotFinite {
        /// Which value.
        name: &'static str,
    },
}

pub(crate) fn positive<T: nn_basis::Scalar>(name: &'static str, value: T) -> Result<T, IdentifierError> {
    if value.is_finite() && T::zero().is_less(value) { Ok(value) } else { Err(IdentifierError::NotPositive { name }) }
}

pub(crate) fn finite<T: nn_basis::Scalar>(name: &'static str, value: T) -> Result<T, IdentifierError> {
    if value.is_finite() { Ok(value) } else { Err(IdentifierError::NotFinite { name }) }
}
