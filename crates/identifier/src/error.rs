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
    /// A start value must be finite.
    #[error("the {name} must be a finite number")]
    NotFinite {
        /// Which value.
        name: &'static str,
    },
}

pub(crate) fn positive<T: nn_basis::Scalar>(name: &'static str, value: T) -> Result<T, IdentifierError> {
    if value.is_finite() && value > T::zero() { Ok(value) } else { Err(IdentifierError::NotPositive { name }) }
}

pub(crate) fn finite<T: nn_basis::Scalar>(name: &'static str, value: T) -> Result<T, IdentifierError> {
    if value.is_finite() { Ok(value) } else { Err(IdentifierError::NotFinite { name }) }
}
