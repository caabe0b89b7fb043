//! Numbers that matrices can be factorised over.

use nalgebra::RealField;
use nn_basis::Scalar;

/// A [`Scalar`] with an order and all functions: `f32`, `f64` or a dual number, but not lanes.
pub trait Field: Scalar + RealField {}
impl<T: Scalar + RealField> Field for T {}
