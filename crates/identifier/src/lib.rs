//! Online neural identifier with a Lyapunov certificate for every step.
//!
//! One [`Identifier`] follows one output x of an unknown system `ẋ = −a x + G(x, u)` with the model
//! `d/dt x̂ = −a x̂ + Ŵᵀφ` (Hendzel & Trojnacki 2014, Eq. 10–13 with A = −a I) and adapts Ŵ. How the law is advanced
//! over a sample is a [`Law`]:
//!
//! | law | what is proved of each step |
//! |---|---|
//! | [`Midpoint`] | the paper's Lyapunov function exactly, at any step size; second order |
//! | [`Exponential`] | the same with numerical damping; with a dead zone Eq. 22 and bounded weights |
//! | [`Projection`] | any law, weights in a ball |
//! | [`Leaky`] | any law, weights that leak: sigma- and e-modification |
//! | [`Euler`] | its exact change of L, which no step size makes a decrease |
//!
//! These laws follow but keep nothing; [`Retaining`] adds a [`Memory`] that does. [`CoupledIdentifier`] takes a general
//! Hurwitz A with its proof, [`HurwitzMatrix`]. Rows 1 and 2 of Eq. 23, whose right-hand sides are known, are
//! [`AngleRow`]s.
//!
//! The Lyapunov function `L = ½ x̃² + ‖W* − Ŵ‖²/(2γ)` needs weights W* that nobody knows. A [`Certificate`] is
//! therefore stated against a comparison W* that the caller chooses: it holds for *every* choice, and all that the
//! chosen W* cannot represent counts as approximation error ε. [`Ledger`] adds certificates up to the mean-square
//! bound. What is *not* certified: convergence of the weights, or a bound on max |x̃| without a dead zone or projection.
//!
//! All laws take any [`Scalar`]: several identifiers run side by side in [`Lanes`], each with the bits it has alone. What
//! factorises a matrix ([`Memory`], [`Retaining`], [`CoupledIdentifier`]) takes a [`Field`] and runs alone.
//!
//! No standard library, no allocation; steps never panic. The feature `std` adds `HurwitzMatrix::solve`, which solves the
//! Lyapunov equation on a host.
//!
//! ```
//! use identifier::{Identifier, Midpoint};
//!
//! // Follow a sine, sampled at 1 ms, with one constant regressor entry.
//! let mut identifier = Identifier::new(8.0, Midpoint::new(500.0)?, 0.0)?;
//! let mut error = 0.0_f64;
//! for k in 0..5000 {
//!     let (now, next) = (f64::from(k) * 1e-3, f64::from(k + 1) * 1e-3);
//!     let step = identifier.step(now.sin(), next.sin(), &[1.0], 1e-3);
//!     assert!(identifier.certificate(&step, &[0.0]).residual < 1e-12);
//!     error = step.error_after;
//! }
//! assert!(error.abs() < 0.02);
//! # Ok::<(), identifier::IdentifierError>(())
//! ```
//!
//! # Files
//!
//! * `law`: the identifier, and what an adaptive law must provide.
//! * `midpoint`, `exponential`, `euler`: the schemes, each over one sample.
//! * `projection`, `leak`: what may be put around any of them.
//! * `certificate`: the Lyapunov balance of each step and the ledger of a run.
//! * `least_squares`, `memory`, `retaining`: what is kept of the past.
//! * `hurwitz`, `coupled`: a general matrix A; `lyapunov`: its equation, solved on a host (`std`).
//! * `angle`: rows whose right-hand side is known; `field`: numbers that matrices are factorised
//!   over.
//! * `error`: what can be wrong with an identifier.
#![no_std]

#[cfg(feature = "std")]
extern crate std;

mod angle;
mod certificate;
mod coupled;
mod error;
mod euler;
mod exponential;
mod field;
mod hurwitz;
mod law;
mod leak;
mod least_squares;
#[cfg(feature = "std")]
mod lyapunov;
mod memory;
mod midpoint;
mod projection;
mod retaining;
#[cfg(test)]
mod tests;

pub use angle::AngleRow;
pub use certificate::{Certificate, Ledger};
pub use coupled::{CoupledCertificate, CoupledIdentifier, CoupledSample};
pub use error::IdentifierError;
pub use euler::Euler;
pub use exponential::Exponential;
pub use field::Field;
pub use hurwitz::HurwitzMatrix;
pub use law::{Identifier, Law, Model, Sample, Step};
pub use leak::{Leaky, Rate};
pub use least_squares::{LeastSquares, LeastSquaresSettings};
#[cfg(feature = "std")]
pub use lyapunov::LyapunovError;
pub use memory::{Memory, MemorySettings};
pub use midpoint::Midpoint;
pub use nn_basis::{Lanes, Scalar};
pub use projection::Projection;
pub use retaining::Retaining;

/// The README's snippet, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
