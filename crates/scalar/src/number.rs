//! What a number must be able to do.

use core::fmt::Debug;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// A real number that a model can be evaluated with: `f32` on a robot, `f64` on a host, a dual number for derivatives,
/// [`Lanes`](crate::Lanes) for several models at once.
///
/// There is no order: lanes would not agree on a branch. [`Scalar::if_less`] takes both branches and picks. The few
/// questions that have one answer ([`Scalar::is_finite`], [`Scalar::is_less`], [`Scalar::is_at_most`]) ask whether it is so
/// in every lane; they are for checks before a run, not for branches within.
pub trait Scalar:
    Copy
    + Debug
    + PartialEq
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + DivAssign
{
    /// The constant `x`.
    fn real(x: f64) -> Self;
    /// The square root.
    #[must_use]
    fn sqrt(self) -> Self;
    /// `eˣ`.
    #[must_use]
    fn exp(self) -> Self;
    /// `eˣ − 1` without cancellation about zero.
    #[must_use]
    fn exp_m1(self) -> Self;
    /// The hyperbolic tangent.
    #[must_use]
    fn tanh(self) -> Self;
    /// Sine and cosine.
    fn sin_cos(self) -> (Self, Self);
    /// The larger of the two; `other` where they cannot be compared.
    #[must_use]
    fn max(self, other: Self) -> Self;
    /// The smaller of the two; `other` where they cannot be compared.
    #[must_use]
    fn min(self, other: Self) -> Self;
    /// `then` where `self < than`, else `otherwise`.
    #[must_use]
    fn if_less(self, than: Self, then: Self, otherwise: Self) -> Self;
    /// Whether it is neither infinite nor NaN; in every lane.
    fn is_finite(self) -> bool;
    /// Whether `self < than`; in every lane.
    fn is_less(self, than: Self) -> bool;
    /// Whether `self <= bound`; in every lane.
    fn is_at_most(self, bound: Self) -> bool;

    /// 0.
    #[inline(always)]
    fn zero() -> Self {
        Self::real(0.0)
    }

    /// 1.
    #[inline(always)]
    fn one() -> Self {
        Self::real(1.0)
    }

    /// The distance from zero.
    #[must_use]
    #[inline(always)]
    fn abs(self) -> Self {
        self.max(-self)
    }

    /// The logistic function `1/(1 + e^(−x))`.
    #[must_use]
    #[inline(always)]
    fn logistic(self) -> Self {
        Self::one() / (Self::one() + (-self).exp())
    }

    /// The hyperbolic tangents of two numbers, where that is cheaper with one division.
    #[must_use]
    #[inline(always)]
    fn tanh_of_both(both: [Self; 2]) -> [Self; 2] {
        both.map(Self::tanh)
    }
}

/// The constant `x` as a scalar.
#[inline(always)]
pub fn real<T: Scalar>(x: f64) -> T {
    T::real(x)
}
