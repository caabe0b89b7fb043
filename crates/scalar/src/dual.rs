//! Dual numbers: every operation carries derivatives along. Comparisons are those of the real parts.

use nalgebra::{ComplexField, RealField};
use num_dual::{Dual2_32, Dual2_64, Dual3_64, Dual32, Dual64, DualSVec32, DualSVec64, HyperDual32, HyperDual64};

use crate::Scalar;

macro_rules! by_field {
    ($([$($parameter:tt)*] $type:ty;)*) => {$(
        impl<$($parameter)*> Scalar for $type {
            #[inline]
            fn real(x: f64) -> Self {
                nalgebra::convert(x)
            }
            #[inline]
            fn sqrt(self) -> Self {
                ComplexField::sqrt(self)
            }
            #[inline]
            fn exp(self) -> Self {
                ComplexField::exp(self)
            }
            #[inline]
            fn exp_m1(self) -> Self {
                ComplexField::exp_m1(self)
            }
            #[inline]
            fn tanh(self) -> Self {
                ComplexField::tanh(self)
            }
            #[inline]
            fn sin_cos(self) -> (Self, Self) {
                ComplexField::sin_cos(self)
            }
            #[inline]
            fn max(self, other: Self) -> Self {
                RealField::max(self, other)
            }
            #[inline]
            fn min(self, other: Self) -> Self {
                RealField::min(self, other)
            }
            #[inline]
            fn if_less(self, than: Self, then: Self, otherwise: Self) -> Self {
                if self < than { then } else { otherwise }
            }
            #[inline]
            fn is_finite(self) -> bool {
                ComplexField::is_finite(&self)
            }
            #[inline]
            fn is_less(self, than: Self) -> bool {
                self < than
            }
            #[inline]
            fn is_at_most(self, bound: Self) -> bool {
                self <= bound
            }
        }
    )*};
}

by_field! {
    [] Dual32;
    [] Dual64;
    [] Dual2_32;
    [] Dual2_64;
    [] Dual3_64;
    [] HyperDual32;
    [] HyperDual64;
    [const N: usize] DualSVec32<N>;
    [const N: usize] DualSVec64<N>;
}
