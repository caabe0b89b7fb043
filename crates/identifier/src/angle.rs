//! Rows of the identifier whose right-hand side is known.

use nn_basis::{Scalar, real};

use crate::error::{IdentifierError, finite, positive};

/// Rows 1 and 2 of Eq. 23: `d/dt x̂ = −a x̂ + (ẋ + a x)` for a wheel angle x with known rate ẋ.
///
/// With the measured wheel speed as ẋ the error obeys `x̃' = −a x̃` and decays as `e^(−a t)`, whatever the robot does.
/// With an estimated speed it is driven by that estimate's error. The paper writes the first; its Fig. 6b looks like
/// the second. Advanced by the implicit midpoint rule.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AngleRow<T> {
    pole: T,
    estimate: T,
}

impl<T: Scalar> AngleRow<T> {
    /// A row with pole a (1/s) that starts at `estimate` (rad).
    ///
    /// # Errors
    /// [`IdentifierError`] if the pole is not positive or the start value not finite.
    pub fn new(pole: T, estimate: T) -> Result<Self, IdentifierError> {
        Ok(Self { pole: positive("pole a", pole)?, estimate: finite("start value of the angle", estimate)? })
    }

    /// Advances over `h` seconds in which the angle went from `start` to `end` (rad) at the mean rate `speed` (rad/s).
    ///
    /// Returns the error `x̃ = end − x̂` at the end.
    #[inline(always)]
    pub fn step(&mut self, start: T, end: T, speed: T, h: T) -> T {
        let half = real::<T>(0.5);
        let drive = speed + self.pole * half * (start + end);
        let mid = (self.estimate + half * h * drive) / (T::one() + half * self.pole * h);
        self.estimate = mid + mid - self.estimate;
        end - self.estimate
    }

    /// The estimated angle, rad.
    pub fn estimate(&self) -> T {
        self.estimate
    }
}
