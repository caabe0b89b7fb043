//! Several numbers that go through the same computation side by side.

use core::array::from_fn;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use crate::Scalar;
use crate::elementary::{self, Double, LARGEST_ANGLE};

/// `N` numbers side by side: every operation acts on each by itself, in the same order as on one number alone, so that
/// a lane has the same bits as the number alone would have.
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
        elementary::exp(self)
    }
    #[inline(always)]
    fn exp_m1(self) -> Self {
        elementary::exp_m1(self)
    }
    #[inline(always)]
    fn tanh(self) -> Self {
        elementary::tanh(self)
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (mut sin, mut cos) = elementary::sin_cos(self);
        if !self.abs().is_at_most(Self::real(LARGEST_ANGLE)) {
            for i in 0..N {
                (sin.0[i], cos.0[i]) = Scalar::sin_cos(self.0[i]);
            }
        }
        (sin, cos)
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
    #[inline(always)]
    fn is_finite(self) -> bool {
        // Counted: a short cut would be a branch per lane.
        self.0.iter().filter(|x| x.is_finite()).count() == N
    }
    #[inline(always)]
    fn is_less(self, than: Self) -> bool {
        self.0.iter().zip(&than.0).filter(|(x, t)| x < t).count() == N
    }
    #[inline(always)]
    fn is_at_most(self, bound: Self) -> bool {
        self.0.iter().zip(&bound.0).filter(|(x, b)| x <= b).count() == N
    }
    #[inline(always)]
    fn abs(self) -> Self {
        self.map(f64::abs)
    }
    #[inline(always)]
    fn logistic(self) -> Self {
        elementary::logistic(self)
    }
    #[inline(always)]
    fn tanh_of_both(both: [Self; 2]) -> [Self; 2] {
        elementary::tanh_of_both(both)
    }
}

impl<const N: usize> Double for Lanes<N> {
    #[inline(always)]
    fn bits(self, f: impl Fn(u64) -> u64) -> Self {
        self.map(
            #[inline(always)]
            |x| f64::from_bits(f(x.to_bits())),
        )
    }
    #[inline(always)]
    fn bits_with(self, other: Self, f: impl Fn(u64, u64) -> u64) -> Self {
        Self(from_fn(
            #[inline(always)]
            |i| f64::from_bits(f(self.0[i].to_bits(), other.0[i].to_bits())),
        ))
    }
}
