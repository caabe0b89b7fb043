//! One cell of a table: bytes become a number, an instant, a gap or a complaint.

use std::borrow::Cow;

/// Why a cell holds no number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum CellError {
    /// Text.
    NotANumber,
    /// NaN, infinity or out of range.
    NotFinite,
}

/// The cell without blanks and enclosing quotes.
pub(crate) fn bare(cell: &[u8]) -> &[u8] {
    let cell = cell.trim_ascii();
    let inner = cell.strip_prefix(b"\"").and_then(|rest| rest.strip_suffix(b"\""));
    inner.map_or(cell, <[u8]>::trim_ascii)
}

/// The cell with a decimal point where it is written with a decimal comma; a point is then no number.
pub(crate) fn with_point(cell: &[u8], comma: bool) -> Result<Cow<'_, [u8]>, CellError> {
    if !comma {
        return Ok(Cow::Borrowed(cell));
    }
    if cell.contains(&b'.') {
        return Err(CellError::NotANumber);
    }
    Ok(Cow::Owned(cell.iter().map(|&byte| if byte == b',' { b'.' } else { byte }).collect()))
}

/// The number in a cell; `None` for an empty one.
pub(crate) fn number(cell: &[u8]) -> Result<Option<f64>, CellError> {
    if let Some(value) = plain(cell) {
        return Ok(Some(value));
    }
    let cell = bare(cell);
    if cell.is_empty() {
        return Ok(None);
    }
    let value: f64 = fast_float2::parse(cell).map_err(|_| CellError::NotANumber)?;
    if value.is_finite() { Ok(Some(value)) } else { Err(CellError::NotFinite) }
}

/// The number in a cell that holds nothing but `[-] digits [. digits]`, few enough for one exact division, which is nearly
/// every cell: a mantissa below 2^53 and a power of ten below 10^23 are exact, so that their quotient is rounded once.
#[inline]
fn plain(cell: &[u8]) -> Option<f64> {
    /// Digits that always fit.
    const DIGITS: usize = 15;
    const POWERS: [f64; DIGITS + 1] =
        [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15];
    let digits = cell.strip_prefix(b"-").unwrap_or(cell);
    if digits.len() > DIGITS + 1 || !digits.last()?.is_ascii_digit() {
        return None;
    }
    let (mut mantissa, mut point) = (0_u64, digits.len());
    for (at, &byte) in digits.iter().enumerate() {
        match byte.wrapping_sub(b'0') {
            digit @ 0..=9 => mantissa = 10 * mantissa + u64::from(digit),
            _ if byte == b'.' && point == digits.len() && at > 0 => point = at,
            _ => return None,
        }
    }
    let behind = (digits.len() - point).saturating_sub(1);
    // Sixteen digits without a point may be too many.
    let value = (mantissa < 1 << 53).then(|| mantissa as f64 / POWERS[behind])?;
    Some(if digits.len() < cell.len() { -value } else { value })
}

/// The instant in a cell whose unit is `ns_per_unit` nanoseconds, rounded to the nearest nanosecond; `None` for an
/// empty cell. Plain decimals are converted exactly, so that stamps since 1970 keep their nanoseconds.
pub(crate) fn instant_ns(cell: &[u8], ns_per_unit: i64) -> Result<Option<i64>, CellError> {
    let Some(value) = number(cell)? else {
        return Ok(None);
    };
    if let Some(exact) = decimal_ns(bare(cell), ns_per_unit) {
        return i64::try_from(exact).map(Some).map_err(|_| CellError::NotFinite);
    }
    rounded_ns(value * ns_per_unit as f64).map(Some).ok_or(CellError::NotFinite)
}

/// A number of nanoseconds rounded to i64, when it fits.
pub(crate) fn rounded_ns(ns: f64) -> Option<i64> {
    /// 2^63: the first number that does not fit.
    const LIMIT: f64 = 9_223_372_036_854_775_808.0;
    let ns = ns.round();
    (ns > -LIMIT && ns < LIMIT).then_some(ns as i64)
}

/// `sign digits [. digits]` times `ns_per_unit`, rounded half away from zero; `None` when written otherwise or too long.
fn decimal_ns(cell: &[u8], ns_per_unit: i64) -> Option<i128> {
    let negative = cell.first() == Some(&b'-');
    let digits = cell.strip_prefix(b"-").or_else(|| cell.strip_prefix(b"+")).unwrap_or(cell);
    // Few digits, as stamps mostly have, need no long arithmetic.
    let ns = if digits.len() <= 19 {
        let (mantissa, divisor) = decimal::<u64>(digits)?;
        let unit = ns_per_unit.unsigned_abs();
        if unit.is_multiple_of(divisor) {
            i128::from(mantissa) * i128::from(unit / divisor)
        } else {
            (i128::from(mantissa) * i128::from(unit) + i128::from(divisor / 2)) / i128::from(divisor)
        }
    } else {
        let (mantissa, divisor) = decimal::<i128>(digits)?;
        mantissa.checked_mul(i128::from(ns_per_unit))?.checked_add(divisor / 2)? / divisor
    };
    Some(if negative { -ns } else { ns })
}

/// `digits [. digits]` as a mantissa and the power of ten that divides it.
fn decimal<T: From<u8> + CheckedMulAdd>(digits: &[u8]) -> Option<(T, T)> {
    let (mut mantissa, mut divisor, mut after_point) = (T::from(0), T::from(1), false);
    for &byte in digits {
        match byte {
            b'0'..=b'9' => {
                mantissa = mantissa.ten_times_plus(byte - b'0')?;
                if after_point {
                    divisor = divisor.ten_times_plus(0)?;
                }
            }
            b'.' if !after_point => after_point = true,
            _ => return None,
        }
    }
    Some((mantissa, divisor))
}

/// The one operation that reading decimals needs.
trait CheckedMulAdd: Sized {
    /// `10 self + digit`, when it fits.
    fn ten_times_plus(self, digit: u8) -> Option<Self>;
}

impl CheckedMulAdd for u64 {
    fn ten_times_plus(self, digit: u8) -> Option<Self> {
        self.checked_mul(10)?.checked_add(digit.into())
    }
}

impl CheckedMulAdd for i128 {
    fn ten_times_plus(self, digit: u8) -> Option<Self> {
        self.checked_mul(10)?.checked_add(digit.into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_gaps_and_complaints() {
        assert_eq!(number(b" 1.5 "), Ok(Some(1.5)));
        assert_eq!(number(b"\"2\""), Ok(Some(2.0)));
        assert_eq!(number(b"-1e-3"), Ok(Some(-0.001)));
        assert_eq!(number(b""), Ok(None));
        assert_eq!(number(b"  "), Ok(None));
        assert_eq!(number(b"abc"), Err(CellError::NotANumber));
        assert_eq!(number(b"1,5"), Err(CellError::NotANumber));
        assert_eq!(number(b"\xff"), Err(CellError::NotANumber));
        for bad in ["nan", "NaN", "inf", "-infinity", "1e999"] {
            assert_eq!(number(bad.as_bytes()), Err(CellError::NotFinite), "{bad}");
        }
    }

    #[test]
    fn plain_decimals_are_rounded_as_the_standard_library_does() {
        let mut state = 1_u64;
        let mut next = |below: u64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) % below
        };
        let mut short = 0;
        for _ in 0..200_000 {
            let length = 1 + next(17) as usize;
            let mut text: String = (0..length).map(|_| char::from(b'0' + next(10) as u8)).collect();
            let point = next(length as u64 + 3) as usize;
            if point < length {
                text.insert(point, '.');
            }
            let text = if next(2) == 0 { format!("-{text}") } else { text };
            let expected: f64 = text.parse().unwrap();
            assert_eq!(number(text.as_bytes()).unwrap().unwrap().to_bits(), expected.to_bits(), "{text}");
            short += usize::from(plain(text.as_bytes()).is_some());
        }
        assert!(short > 100_000, "{short} were plain");
        for odd in ["-", "", ".", ".5", "5.", "1..2", "1.2.3", "+1", "1e3", " 1", "--1"] {
            assert_eq!(plain(odd.as_bytes()), None, "{odd}");
        }
    }

    #[test]
    fn instants_are_exact_where_the_text_is() {
        let s = 1_000_000_000;
        assert_eq!(instant_ns(b"1700000000.123456789", s), Ok(Some(1_700_000_000_123_456_789)));
        assert_eq!(instant_ns(b"0.15384615384615385", s), Ok(Some(153_846_154)));
        assert_eq!(instant_ns(b"-0.0000000005", s), Ok(Some(-1)));
        assert_eq!(instant_ns(b"1e-3", s), Ok(Some(1_000_000)));
        assert_eq!(instant_ns(b"12", 1_000_000), Ok(Some(12_000_000)));
        assert_eq!(instant_ns(b"1e30", s), Err(CellError::NotFinite));
        assert_eq!(instant_ns(b"99999999999999999999", s), Err(CellError::NotFinite));
        assert_eq!(instant_ns(b"", s), Ok(None));
        assert_eq!(instant_ns(b"-.", s), Err(CellError::NotANumber));
    }
}
