//! Double precision.

use crate::Scalar;
use crate::elementary::{self, Double, LARGEST_ANGLE};

impl Double for f64 {
    #[inline(always)]
    fn bits(self, f: impl Fn(u64) -> u64) -> Self {
        Self::from_bits(f(self.to_bits()))
    }
    #[inline(always)]
    fn bits_with(self, other: Self, f: impl Fn(u64, u64) -> u64) -> Self {
        Self::from_bits(f(self.to_bits(), other.to_bits()))
    }
}

impl Scalar for f64 {
    #[inline(always)]
    fn real(x: f64) -> Self {
        x
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        // Correctly rounded either way.
        #[cfg(feature = "std")]
        return f64::sqrt(self);
        #[cfg(not(feature = "std"))]
        return libm::sqrt(self);
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
        if self.abs() <= LARGEST_ANGLE { elementary::sin_cos(self) } else { elementary::sin_cos_of_huge(self) }
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if self > other { self } else { other }
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        if self < other { self } else { other }
    }
    #[inline(always)]
    fn if_less(self, than: Self, then: Self, otherwise: Self) -> Self {
        if self < than { then } else { otherwise }
    }
    #[inline(always)]
    fn is_finite(self) -> bool {
        f64::is_finite(self)
    }
    #[inline(always)]
    fn is_less(self, than: Self) -> bool {
        self < than
    }
    #[inline(always)]
    fn is_at_most(self, bound: Self) -> bool {
        self <= bound
    }
    #[inline(always)]
    fn abs(self) -> Self {
        f64::abs(self)
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
