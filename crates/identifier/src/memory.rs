//! What an identifier keeps.

use nn_basis::real;

use crate::Field;
use crate::error::{IdentifierError, finite, positive};
use crate::least_squares::{LeastSquares, LeastSquaresSettings, relaxed};

/// The two spans of a memory.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MemorySettings<T> {
    /// What is kept: a span of minutes.
    pub long: LeastSquaresSettings<T>,
    /// What acts: a span of about a second that also fits changes, its prior what is kept.
    pub short: LeastSquaresSettings<T>,
    /// Rate at which the long span's weights are taken over into what is kept, 1/s: slow, because the first guesses of
    /// least squares are wild.
    pub consolidation: T,
}

impl<T: Field> Default for MemorySettings<T> {
    /// Settings for wheel speeds sampled at 1 kHz with noise of about 0.01 rad/s; where they come from is told in
    /// `docs/paper/learning.md`.
    fn default() -> Self {
        let span = |bandwidth, lead, forgetting, ridge| LeastSquaresSettings {
            bandwidth: real(bandwidth),
            lead: real(lead),
            forgetting: real(forgetting),
            ridge: real(ridge),
        };
        Self { long: span(30.0, 0.5, 0.02, 1e-5), short: span(200.0, 0.5, 2.0, 0.25), consolidation: real(0.05) }
    }
}

/// A long and a short memory of an equation `y = Wᵀφ`, each by least squares over its span.
///
/// The long one fits what the regressor explains over minutes; its weights are kept. The short one fits the last second,
/// as near to what is kept as the data allow: where they say nothing it is what is kept, so that what was learned on one
/// lap helps on the next. Both are bounded while the output is.
///
/// Regressor entries should be of the order of one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Memory<T: Field, const N: usize> {
    long: LeastSquares<T, N>,
    short: LeastSquares<T, N>,
    consolidation: T,
    /// Prior of the long span: what was kept before this memory began.
    prior: [T; N],
    kept: [T; N],
    acting: [T; N],
}

impl<T: Field, const N: usize> Memory<T, N> {
    /// A memory of nothing.
    ///
    /// # Errors
    /// [`IdentifierError`] names the setting that cannot be used.
    pub fn new(settings: MemorySettings<T>) -> Result<Self, IdentifierError> {
        Self::recalling(settings, [real(0.0); N])
    }

    /// A memory that begins with the weights that another one had kept, as after a restart.
    ///
    /// # Errors
    /// [`IdentifierError`] if a setting cannot be used or a weight is not finite.
    pub fn recalling(settings: MemorySettings<T>, kept: [T; N]) -> Result<Self, IdentifierError> {
        for weight in kept {
            finite("weight that is recalled", weight)?;
        }
        Ok(Self {
            long: LeastSquares::new(settings.long)?,
            short: LeastSquares::new(settings.short)?,
            consolidation: positive("consolidation of the memory", settings.consolidation)?,
            prior: kept,
            kept,
            acting: kept,
        })
    }

    /// Takes in `y = Wᵀφ`, as it was over `h` seconds.
    ///
    /// The work is the same for every sample: two Cholesky factorisations of N × N. One that fails, which takes input that
    /// is not finite, leaves its weights as they are.
    pub fn learn(&mut self, y: T, phi: &[T; N], h: T) {
        if let Some(weight) = self.long.learn(y, phi, h, &self.prior) {
            let share = relaxed(self.consolidation, h);
            for (kept, weight) in self.kept.iter_mut().zip(weight) {
                *kept += share * (weight - *kept);
            }
        }
        if let Some(weight) = self.short.learn(y, phi, h, &self.kept) {
            self.acting = weight;
        }
    }

    /// The weights that are kept.
    pub fn kept(&self) -> [T; N] {
        self.kept
    }

    /// The weights that act now.
    pub fn acting(&self) -> [T; N] {
        self.acting
    }
}
