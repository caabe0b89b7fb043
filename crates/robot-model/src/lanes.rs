//! Several numbers that go through the same computation side by side.

use core::array::from_fn;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use crate::scalar::Scalar;

/// `N` numbers side by side: every operation acts on each by itself, in the same order as on one number alone, so that
/// a lane has the same bits as a plant of its own would give.
///
/// Plain arrays, which the compiler turns into vector instructions where the caller's target has them.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(64))]
pub struct Lanes<const N: usize>(pub [f64; N]);

macro_rules! by_lane {
    ($($trait:ident $fn:ident $assign_trait:ident $assign_fn:ident $op:tt;)*) => {$(
        impl<const N: usize> $trait for Lanes<N> {
            type Output = Self;
            #[inline(always)]
            fn $fn(self, other: Self) -> Self {
                Self(from_fn(#[inline(always)] |i| self.0[i] $op other.0[i]))
            }
        }
        impl<const N: usize> $assign_trait for Lanes<N> {
            #[inline(always)]
            fn $assign_fn(&mut self, other: Self) {
                *self = *self $op other;
            }
        }
    )*};
}

by_lane! {
    Add add AddAssign add_assign +;
    Sub sub SubAssign sub_assign -;
    Mul mul MulAssign mul_assign *;
    Div div DivAssign div_assign /;
}

impl<const N: usize> Neg for Lanes<N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.map(|x| -x)
    }
}

impl<const N: usize> Lanes<N> {
    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self(from_fn(
            #[inline(always)]
            |i| f(self.0[i]),
        ))
    }
}

impl<const N: usize> Scalar for Lanes<N> {
    #[inline(always)]
    fn real(x: f64) -> Self {
        Self([x; N])
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        // Correctly rounded either way, but only the standard library's is known to the vectoriser.
        #[cfg(feature = "std")]
        return self.map(f64::sqrt);
        #[cfg(not(feature = "std"))]
        return self.map(Scalar::sqrt);
    }
    #[inline(always)]
    fn exp(self) -> Self {
        self.map(Scalar::exp)
    }
    #[inline(always)]
    fn tanh(self) -> Self {
        self.map(Scalar::tanh)
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let both: [(f64, f64); N] = from_fn(|i| Scalar::sin_cos(self.0[i]));
        (Self(both.map(|b| b.0)), Self(both.map(|b| b.1)))
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(from_fn(
            #[inline(always)]
            |i| if self.0[i] > other.0[i] { self.0[i] } else { other.0[i] },
        ))
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(from_fn(
            #[inline(always)]
            |i| if self.0[i] < other.0[i] { self.0[i] } else { other.0[i] },
        ))
    }
    #[inline(always)]
    fn if_less(self, than: Self, then: Self, otherwise: Self) -> Self {
        Self(from_fn(
            #[inline(always)]
            |i| if self.0[i] < than.0[i] { then.0[i] } else { otherwise.0[i] },
        ))
    }
}
