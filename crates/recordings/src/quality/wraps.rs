//! Counters and angles that start anew when they are full.

/// A signal that wraps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wrap {
    /// What is lost at each wrap, in the channel's unit: 256, 65 536, 2^32, 2π or 360.
    pub modulus: f64,
    /// How often it wrapped.
    pub count: usize,
}

/// What counters and angles wrap at.
const MODULI: [f64; 5] = [std::f64::consts::TAU, 256.0, 360.0, 65_536.0, 4_294_967_296.0];
/// A change above this part of the modulus may be a wrap: nothing turns so far from one sample to the next.
const WRAPPED: f64 = 0.8;
/// It is one when the way around is at most this many times the largest other change (a lost sample doubles it).
const LIKE_OTHERS: f64 = 2.0;
/// Other changes may not be larger than this part of the modulus: noise and jumps fill the middle, wraps leave it empty.
const MOVED: f64 = 0.2;

/// The wrap of values (not finite where missing) between `low` and `high`; `None` for a signal without.
pub(crate) fn wrap(values: &[f64], low: f64, high: f64) -> Option<Wrap> {
    let range = high - low;
    let fits = |modulus: &&f64| range <= **modulus * (1.0 + 1e-6) && range > WRAPPED * **modulus;
    let modulus = *MODULI.iter().find(fits)?;
    let (mut count, mut other, mut around) = (0, 0.0_f64, 0.0_f64);
    for change in values.windows(2).map(|pair| (pair[1] - pair[0]).abs()) {
        if change > WRAPPED * modulus {
            count += 1;
            around = around.max((modulus - change).abs());
        } else {
            // A change from or to a missing value is NaN, which `max` passes over.
            other = other.max(change);
        }
    }
    (count > 0 && other <= MOVED * modulus && around <= LIKE_OTHERS * other).then_some(Wrap { modulus, count })
}
