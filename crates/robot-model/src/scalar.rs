//! The number type that all models are generic over.

use core::fmt::Debug;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use nalgebra::RealField;

/// A real number that a plant can be evaluated with: `f32` on a robot, `f64` on a host, a dual number for derivatives,
/// [`Lanes`](crate::Lanes) for several plants at once.
///
/// There is no order: lanes would not agree on a branch. [`Scalar::if_less`] takes both branches and picks.
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
    /// The hyperbolic tangent.
    #[must_use]
    fn tanh(self) -> Self;
    /// Sine and cosine.
    fn sin_cos(self) -> (Self, Self);
    /// The larger of the two.
    #[must_use]
    fn max(self, other: Self) -> Self;
    /// The smaller of the two.
    #[must_use]
    fn min(self, other: Self) -> Self;
    /// `then` where `self < than`, else `otherwise`.
    #[must_use]
    fn if_less(self, than: Self, then: Self, otherwise: Self) -> Self;

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
}

impl<T: RealField + Copy> Scalar for T {
    #[inline(always)]
    fn real(x: f64) -> Self {
        nalgebra::convert(x)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        nalgebra::ComplexField::sqrt(self)
    }
    #[inline(always)]
    fn exp(self) -> Self {
        nalgebra::ComplexField::exp(self)
    }
    #[inline(always)]
    fn tanh(self) -> Self {
        nalgebra::ComplexField::tanh(self)
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        nalgebra::ComplexField::sin_cos(self)
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        RealField::max(self, other)
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        RealField::min(self, other)
    }
    #[inline(always)]
    fn if_less(self, than: Self, then: Self, otherwise: Self) -> Self {
        if self < than { then } else { otherwise }
    }
}

/// The constant `x` as a scalar.
#[inline(always)]
pub fn real<T: Scalar>(x: f64) -> T {
    T::real(x)
}

/// `exp(−x²)` as `(1 − x²/16)¹⁶`, zero beyond |x| = 4: basic operations only, at most 0.017 from it.
#[inline(always)]
pub(crate) fn bell<T: Scalar>(x: T) -> T {
    let mut b = (T::one() - x * x * real(1.0 / 16.0)).max(T::zero());
    for _ in 0..4 {
        b *= b;
    }
    b
}

/// A smooth sign: the Padé approximant `x (27 + x²) / (27 + 9 x²)` of `tanh x`, exactly ±1 beyond |x| = 3.
///
/// Only the four basic operations: cheap, and the same bits on every machine. Largest distance from `tanh`: 0.024.
#[inline(always)]
pub(crate) fn smooth_sign<T: Scalar>(x: T) -> T {
    let three = real::<T>(3.0);
    let x = x.max(-three).min(three);
    let x2 = x * x;
    x * (real::<T>(27.0) + x2) / (real::<T>(27.0) + real::<T>(9.0) * x2)
}
