//! Weak form of recordings: windows of monomials and their Gram matrix, in one pass and in memory that does not grow.
//!
//! ```text
//! rows z_t of S signals ──> monomials x_t of degree 1 and 2, C = S + S (S + 1)/2 columns
//!                       ──> g_w = Σ_k φ_k x_{w·stride + k},  φ_k = (1 − s_k²)^p,  s_k = (2k − W + 1)/(W + 1)
//!                       ──> H = Σ_w g_w g_wᵀ
//! ```
//!
//! A linear law between monomials of signals holds for their windows as well, with far less noise; its coefficients come
//! from `H` alone ([`Gram::ridge`]). Nothing of the size rows × columns is ever stored.
//!
//! * [`Shape`] says how many signals there are and what a window is.
//! * [`WeakForm`] takes rows in any portions. Its sums run in the order of the rows and of the windows, with separate
//!   multiplications and additions: the bits depend neither on the portions nor on the machine's vector unit.
//! * [`Gram`] is the result. Parts of a recording add up; [`Shape::rows_of_windows`] says where to cut.
//!
//! ```
//! use weak_form::{Shape, WeakForm};
//!
//! let shape = Shape::new(2, 49, 12, 4)?;
//! let mut weak = WeakForm::new(shape);
//! for t in 0..1000 {
//!     let x = (0.01 * f64::from(t)).sin();
//!     weak.push(&[x, 3.0 * x - 0.5 * x * x])?;
//! }
//! // The second signal (column 1) from the first (column 0) and its square (column 2).
//! let law = weak.gram().ridge(&[1], &shape.columns_of(&[0, 2])?, 0.0)?;
//! assert!((law.coefficient(0, 0) - 3.0).abs() < 1e-9);
//! assert!((law.coefficient(1, 0) + 0.5).abs() < 1e-9);
//! # Ok::<(), weak_form::WeakFormError>(())
//! ```
//!
//! # Files
//!
//! * `shape`: how many signals there are and what a window is.
//! * `stream`: rows in, in any portions; windows and their Gram matrix out.
//! * `kernel`: the three sums, in one order whatever the vector unit.
//! * `aligned`: numbers that begin at a line of the cache.
//! * `gram`, `ridge`: the matrix, and regression from it alone.
//! * `settings`: every tuned number.
//! * `error`: why there is no weak form.

mod aligned;
mod error;
mod gram;
mod kernel;
mod ridge;
mod settings;
mod shape;
mod stream;

pub use error::WeakFormError;
pub use gram::Gram;
pub use ridge::Law;
pub use shape::Shape;
pub use stream::WeakForm;

/// Every tuned number of this crate, for the page of settings.
pub fn settings() -> impl Iterator<Item = &'static ::settings::Setting> {
    settings::Settings::ALL.iter()
}

/// Name of the vector unit that the sums are compiled for on this machine, as `pulp` detects it.
pub fn vector_unit() -> &'static str {
    struct Name;
    impl pulp::WithSimd for Name {
        type Output = usize;
        #[inline(always)]
        fn with_simd<S: pulp::Simd>(self, _: S) -> usize {
            S::F64_LANES
        }
    }
    match pulp::Arch::new().dispatch(Name) {
        8 => "8 lanes of f64 (x86-64-v4, AVX-512)",
        4 => "4 lanes of f64 (x86-64-v3, AVX2)",
        2 => "2 lanes of f64",
        _ => "one f64 at a time",
    }
}

/// The README's snippet, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
