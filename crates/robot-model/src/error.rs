//! What can be wrong with a model's parameters.

/// A parameter that no robot can have.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ModelError {
    /// A quantity must be larger than zero.
    #[error("{name} is {value}, but it must be larger than zero")]
    NotPositive {
        /// Name of the quantity.
        name: &'static str,
        /// The value given.
        value: f64,
    },
    /// A quantity must not be negative.
    #[error("{name} is {value}, but it must not be negative")]
    Negative {
        /// Name of the quantity.
        name: &'static str,
        /// The value given.
        value: f64,
    },
    /// A quantity must be a finite number.
    #[error("{name} is {value}, but it must be a finite number")]
    NotFinite {
        /// Name of the quantity.
        name: &'static str,
        /// The value given.
        value: f64,
    },
    /// A quantity lies outside the range in which the model holds.
    #[error("{name} is {value}, but it must lie between {low} and {high}")]
    OutOfRange {
        /// Name of the quantity.
        name: &'static str,
        /// The value given.
        value: f64,
        /// Smallest allowed value.
        low: f64,
        /// Largest allowed value.
        high: f64,
    },
}

/// Refuses what is not finite and larger than zero.
pub(crate) fn positive(name: &'static str, value: f64) -> Result<(), ModelError> {
    finite(name, value)?;
    if value > 0.0 { Ok(()) } else { Err(ModelError::NotPositive { name, value }) }
}

/// Refuses what is not finite or below zero.
pub(crate) fn not_negative(name: &'static str, value: f64) -> Result<(), ModelError> {
    finite(name, value)?;
    if value >= 0.0 { Ok(()) } else { Err(ModelError::Negative { name, value }) }
}

/// Refuses NaN and the infinities.
pub(crate) fn finite(name: &'static str, value: f64) -> Result<(), ModelError> {
    if value.is_finite() { Ok(()) } else { Err(ModelError::NotFinite { name, value }) }
}

/// Refuses what lies outside `low..=high`.
pub(crate) fn within(name: &'static str, value: f64, low: f64, high: f64) -> Result<(), ModelError> {
    finite(name, value)?;
    if value >= low && value <= high { Ok(()) } else { Err(ModelError::OutOfRange { name, value, low, high }) }
}
