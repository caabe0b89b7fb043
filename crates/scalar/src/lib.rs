//! The number type that models, networks, identifiers and controllers are generic over.
//!
//! * [`Scalar`]: what a number must be able to do. There is no order, so that one body of code serves one robot and many;
//! * `f32` on a robot, `f64` on a host, dual numbers for derivatives (feature `num-dual`);
//! * [`Lanes`]: several `f64` side by side. Every lane has the bits that the number alone would have.
//!
//! `exp`, `exp_m1`, `tanh`, the logistic function and sine and cosine of `f64` and lanes are polynomials after a reduction
//! of the range, in the four basic operations and without branches (but for angles beyond 10⁶, which go to `libm`): the same
//! bits on every machine, and vector instructions in lanes. Errors against extended precision over three million values,
//! in units in the last place:
//!
//! | function | largest found | bound that the tests hold, against `libm` |
//! |---|---|---|
//! | `exp` | 1.1 | 2 |
//! | `exp_m1` | 1.9 | 3 |
//! | `tanh` | 2.4 | 4 |
//! | `tanh_of_both` | 3.5 | 5 |
//! | `logistic` | 2.3 | 4; absolutely 1e-307 below that |
//! | `sin_cos` | 2.3 | 3 |
//!
//! No standard library, no allocation; nothing panics.
//!
//! ```
//! use scalar::{Lanes, Scalar};
//!
//! fn bump<T: Scalar>(x: T) -> T {
//!     (-(x * x)).exp()
//! }
//! let both = bump(Lanes([0.5, -2.0]));
//! assert_eq!(both.0, [bump(0.5), bump(-2.0)]);
//! ```
//!
//! # Files
//!
//! * `number`: what a number must be able to do; no order, so that lanes never disagree on a
//!   branch.
//! * `lanes`: several numbers side by side, each with the bits it has alone.
//! * `elementary`: exp, tanh, sine and cosine in basic operations.
//! * `double`, `single`, `dual`: the same for `f64`, `f32` and dual numbers.
#![cfg_attr(not(feature = "std"), no_std)]

mod double;
#[cfg(feature = "num-dual")]
mod dual;
mod elementary;
mod lanes;
mod number;
mod single;

pub use lanes::Lanes;
pub use number::{Scalar, real};

/// The README's snippet, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
