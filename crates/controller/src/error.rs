//! What can be wrong with a path or with gains.

/// A path or a gain that cannot be used.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ControllerError {
    /// A quantity must be a finite number above zero.
    #[error("{name} is {value}, but it must be a finite number larger than zero")]
    NotPositive {
        /// Name of the quantity.
        name: &'static str,
        /// The value given.
        value: f64,
    },
    /// A quantity must be a finite number and not negative.
    #[error("{name} is {value}, but it must be a finite number and not negative")]
    Negative {
        /// Name of the quantity.
        name: &'static str,
        /// The value given.
        value: f64,
    },
}

pub(crate) fn positive(name: &'static str, value: f64) -> Result<(), ControllerError> {
    if value.is_finite() && value > 0.0 { Ok(()) } else { Err(ControllerError::NotPositive { name, value }) }
}

pub(crate) fn not_negative(name: &'static str, value: f64) -> Result<(), ControllerError> {
    if value.is_finite() && value >= 0.0 { Ok(()) } else { Err(ControllerError::Negative { name, value }) }
}
