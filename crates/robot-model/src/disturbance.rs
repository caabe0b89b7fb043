//! What acts on a robot beside the effects of the catalogue.

use crate::effect::{Coefficients, OperatingPoint};
use crate::scalar::Scalar;

/// Something without a name in the catalogue that changes the coefficients and forces of an instant, after the effects.
pub trait Disturbance<T: Scalar>: Sync {
    /// Changes the coefficients and forces of an instant.
    fn act(&self, at: &OperatingPoint<T>, c: &mut Coefficients<T>);
}
