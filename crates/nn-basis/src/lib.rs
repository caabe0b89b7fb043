//! Sigmoid bases and networks that are linear in their parameters.
//!
//! A network `y = Wᵀ S(Vᵀ x)` (Hendzel & Trojnacki 2014, Eq. 1) whose first layer V stays fixed is linear in W
//! (Eq. 3): `y = Wᵀ φ(x)`. This crate holds the fixed part, a [`Basis`] that turns an input into a regressor φ, and
//! the linear part, [`LinearNet`].
//!
//! | basis | φ |
//! |---|---|
//! | [`SigmoidLayer`] | logistic or tanh units of scaled inputs |
//! | [`Constant`] | the same vector at all times: what remains when the network is taken away |
//!
//! Sizes are part of the types: I inputs, N units, R outputs. One body of code for `f32`, `f64`, dual numbers and lanes
//! ([`Scalar`]). No standard library, no allocation; steps never panic.
//!
//! ```
//! use nn_basis::{Activation, Basis, SigmoidLayer};
//!
//! // Two units of one input that is about 7 rad/s at most.
//! let layer = SigmoidLayer::new([0.0, 0.5], [[1.0], [-1.0]], [7.0], Activation::Logistic)?;
//! let phi = layer.regressor(&[0.0_f64]);
//! assert_eq!(phi[0], 0.5);
//! # Ok::<(), nn_basis::BasisError>(())
//! ```
//!
//! # Files
//!
//! * `activation`, `layer`: the function of a neuron, and the fixed first layer.
//! * `net`: the second layer, whose weights adapt.
//! * `constant`: the regressor without a network, for comparison.
//! * `error`: what can be wrong with a basis.
#![no_std]

mod activation;
mod constant;
mod error;
mod layer;
mod net;
#[cfg(test)]
mod tests;

pub use activation::Activation;
pub use constant::Constant;
pub use error::BasisError;
pub use layer::SigmoidLayer;
pub use net::LinearNet;

pub use scalar::{Lanes, Scalar, real};

/// The README's snippet, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;

/// `Σ a_i b_i`, summed from the first entry on so that the result is the same everywhere.
#[inline(always)]
pub fn dot<T: Scalar, const N: usize>(a: &[T; N], b: &[T; N]) -> T {
    let mut sum = T::zero();
    for i in 0..N {
        sum += a[i] * b[i];
    }
    sum
}

/// Functions of the input that a network combines linearly: x in R^I gives φ in R^N.
pub trait Basis<T: Scalar, const I: usize, const N: usize> {
    /// The regressor φ(x), dimensionless. Never fails; finite inputs give finite values.
    fn regressor(&self, input: &[T; I]) -> [T; N];
}
