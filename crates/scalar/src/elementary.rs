//! Elementary functions of `f64` and of lanes of it, in basic operations only.
//!
//! Polynomials are near-minimax (interpolated at Chebyshev nodes in sixty digits), evaluated by Estrin's scheme. Products
//! are never contracted with sums, so the bits are the same on every machine.

use crate::Scalar;

/// A number whose 64 bits can be worked on: `f64`, or lanes of it.
pub(crate) trait Double: Scalar {
    /// `f` of the bits.
    fn bits(self, f: impl Fn(u64) -> u64) -> Self;
    /// `f` of the bits of two numbers.
    fn bits_with(self, other: Self, f: impl Fn(u64, u64) -> u64) -> Self;
}

/// 1.5 · 2⁵²: a number of which the last bit counts one. Adding it rounds to an integer, which then stands in the low bits.
const ROUND: f64 = 6_755_399_441_055_744.0;
const SIGN: u64 = 1 << 63;

/// `x`, at most `high`; not a number stays not a number.
#[inline(always)]
fn at_most<T: Double>(x: T, high: f64) -> T {
    let high = T::real(high);
    high.if_less(x, high, x)
}

/// `x`, at least `low`; not a number stays not a number.
#[inline(always)]
fn at_least<T: Double>(x: T, low: f64) -> T {
    let low = T::real(low);
    x.if_less(low, low, x)
}

/// `x = n ln 2 + r` with |r| at most half of ln 2: `eʳ − 1`, and n + [`ROUND`]. For |n| up to 2¹¹.
#[inline(always)]
fn reduced<T: Double>(x: T) -> (T, T) {
    let c = T::real;
    // ln 2 in two parts, the first with 42 bits, so that its product with n is exact.
    let shifted = x * c(core::f64::consts::LOG2_E) + c(ROUND);
    let n = shifted - c(ROUND);
    let r = (x - n * c(0.693_147_180_559_890_3)) - n * c(5.497_923_018_708_371e-14);
    let r2 = r * r;
    let r4 = r2 * r2;
    let low = (c(0.5) + c(0.166_666_666_666_666_69) * r)
        + (c(0.041_666_666_666_624_13) + c(0.008_333_333_333_330_062) * r) * r2;
    let high = (c(0.001_388_888_891_721_371_7) + c(0.000_198_412_698_630_536_18) * r)
        + (c(2.480_152_129_595_437_6e-5) + c(2.755_726_845_999_706_4e-6) * r) * r2;
    let top = c(2.762_008_844_540_974_6e-7) + c(2.510_038_549_551_032e-8) * r;
    (r + r2 * (low + r4 * (high + r4 * top)), shifted)
}

/// 2ⁿ of n + [`ROUND`], −1023 < n ≤ 1024; infinite for 1024.
#[inline(always)]
fn power<T: Double>(shifted: T) -> T {
    shifted.bits(
        #[inline(always)]
        |b| b.wrapping_add(1023) << 52,
    )
}

/// `eˣ`, subnormal results included.
#[inline(always)]
pub(crate) fn exp<T: Double>(x: T) -> T {
    let c = T::real;
    let (less_one, shifted) = reduced(at_least(at_most(x, 710.0), -746.0));
    // In two factors, because 2ⁿ alone may be subnormal.
    let n = shifted - c(ROUND);
    let half = n * c(0.5) + c(ROUND);
    let rest = (n - (half - c(ROUND))) + c(ROUND);
    (c(1.0) + less_one) * power(half) * power(rest)
}

/// `eˣ − 1`.
#[inline(always)]
pub(crate) fn exp_m1<T: Double>(x: T) -> T {
    let c = T::real;
    let (less_one, shifted) = reduced(at_least(at_most(x, 45.0), -45.0));
    let power = power(shifted);
    let small = less_one * power + (power - c(1.0));
    c(44.0).if_less(x, exp(x), small)
}

/// `1/(1 + e^(−x))`.
#[inline(always)]
pub(crate) fn logistic<T: Double>(x: T) -> T {
    let c = T::real;
    // Infinite where x is below −709.4, whose inverse is the right limit.
    let (less_one, shifted) = reduced(at_least(at_most(-x, 710.0), -708.0));
    c(1.0) / (c(1.0) + (c(1.0) + less_one) * power(shifted))
}

/// `e^(2|x|) − 1`, for |x| beyond 22 as for 22, where the hyperbolic tangent is one.
#[inline(always)]
fn twice_m1<T: Double>(x: T) -> T {
    let size = x.bits(
        #[inline(always)]
        |b| b & !SIGN,
    );
    let (less_one, shifted) = reduced(at_most(size + size, 44.0));
    let power = power(shifted);
    less_one * power + (power - T::real(1.0))
}

/// The size of one number with the sign of another.
#[inline(always)]
fn signed<T: Double>(size: T, sign: T) -> T {
    size.bits_with(
        sign,
        #[inline(always)]
        |a, b| a | (b & SIGN),
    )
}

/// `tanh x`.
#[inline(always)]
pub(crate) fn tanh<T: Double>(x: T) -> T {
    let e = twice_m1(x);
    signed(e / (e + T::real(2.0)), x)
}

/// `tanh` of two numbers with one division.
#[inline(always)]
pub(crate) fn tanh_of_both<T: Double>([x, y]: [T; 2]) -> [T; 2] {
    let (e, f) = (twice_m1(x), twice_m1(y));
    let (p, q) = (e + T::real(2.0), f + T::real(2.0));
    let inverse = T::real(1.0) / (p * q);
    [signed(e * (q * inverse), x), signed(f * (p * inverse), y)]
}

/// Up to this size the reduction by three parts of π/2 is exact enough.
pub(crate) const LARGEST_ANGLE: f64 = 1e6;

/// Sine and cosine of an angle up to [`LARGEST_ANGLE`].
#[inline(always)]
pub(crate) fn sin_cos<T: Double>(x: T) -> (T, T) {
    let c = T::real;
    let shifted = x * c(core::f64::consts::FRAC_2_PI) + c(ROUND);
    let n = shifted - c(ROUND);
    // π/2 in parts of 33, 33 and 53 bits: the products of n with the first two are exact.
    let r =
        ((x - n * c(1.570_796_326_734_125_6)) - n * c(6.077_100_506_303_966e-11)) - n * c(2.022_266_248_795_950_6e-21);
    let z = r * r;
    let z2 = z * z;
    let s = ((c(-0.166_666_666_666_666_66) + c(0.008_333_333_333_330_946) * z)
        + (c(-0.000_198_412_698_367_549_7) + c(2.755_731_610_068_312e-6) * z) * z2)
        + (c(-2.505_113_145_544_742_8e-8) + c(1.591_810_123_167_728e-10) * z) * (z2 * z2);
    let k = ((c(0.041_666_666_666_666_664) + c(-0.001_388_888_888_888_739_5) * z)
        + (c(2.480_158_729_876_343_3e-5) + c(-2.755_731_727_056_038_5e-7) * z) * z2)
        + (c(2.087_614_602_470_193e-9) + c(-1.138_261_486_943_412_8e-11) * z) * (z2 * z2);
    let sine = r + r * z * s;
    let cosine = c(1.0) - (c(0.5) * z - z2 * k);
    // Quadrant n: odd swaps the two; the second bit of n, or of n + 1, is the sign.
    let pick = |a: T, b: T| {
        let mixed = a.bits_with(
            b,
            #[inline(always)]
            |a, b| a ^ b,
        );
        let mixed = mixed.bits_with(
            shifted,
            #[inline(always)]
            |m, n| m & 0_u64.wrapping_sub(n & 1),
        );
        a.bits_with(
            mixed,
            #[inline(always)]
            |a, m| a ^ m,
        )
    };
    let sine_out = pick(sine, cosine).bits_with(
        shifted,
        #[inline(always)]
        |s, n| s ^ ((n & 2) << 62),
    );
    let cosine_out = pick(cosine, sine).bits_with(
        shifted,
        #[inline(always)]
        |k, n| k ^ ((n.wrapping_add(1) & 2) << 62),
    );
    (sine_out, cosine_out)
}

/// Sine and cosine of an angle that is huge, infinite or not a number.
#[cold]
#[inline(never)]
pub(crate) fn sin_cos_of_huge(x: f64) -> (f64, f64) {
    libm::sincos(x)
}
