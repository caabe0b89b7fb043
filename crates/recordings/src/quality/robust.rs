//! Medians and quantiles, which a few wild samples do not move.

/// The `share` quantile (nearest rank) of numbers that are finite; `None` without any. Reorders them.
pub(crate) fn quantile(numbers: &mut [f64], share: f64) -> Option<f64> {
    let rank = (share * numbers.len().checked_sub(1)? as f64).round() as usize;
    Some(*numbers.select_nth_unstable_by(rank, f64::total_cmp).1)
}

/// The upper median of numbers that are finite; `None` without any. Reorders them.
pub(crate) fn median(numbers: &mut [f64]) -> Option<f64> {
    let middle = numbers.len() / 2;
    (!numbers.is_empty()).then(|| *numbers.select_nth_unstable_by(middle, f64::total_cmp).1)
}

/// Numbers in rising order, as `f64::total_cmp` has it.
pub(crate) fn sort(numbers: &mut Vec<f64>) {
    /// Below, counting digits takes longer than comparing.
    const MANY: usize = 2048;
    if numbers.len() < MANY {
        return numbers.sort_unstable_by(f64::total_cmp);
    }
    let keys: Vec<u64> = numbers.iter().map(|number| key(number.to_bits())).collect();
    numbers.clear();
    numbers.extend(sorted_by_digits(keys).into_iter().map(|key| f64::from_bits(unkey(key))));
}

/// A number that rises with the value that has these bits.
const fn key(bits: u64) -> u64 {
    if bits >> 63 == 0 { bits | 1 << 63 } else { !bits }
}

/// The bits that have this key.
const fn unkey(key: u64) -> u64 {
    if key >> 63 == 1 { key & !(1 << 63) } else { !key }
}

/// Sorts by one digit after the other, the last one first: some three times as fast as by comparing.
fn sorted_by_digits(mut keys: Vec<u64>) -> Vec<u64> {
    const BITS: u32 = 11;
    const DIGITS: usize = u64::BITS.div_ceil(BITS) as usize;
    let digit = |key: u64, place: usize| (key >> (place as u32 * BITS)) as usize & ((1 << BITS) - 1);
    let mut counts = vec![[0_usize; 1 << BITS]; DIGITS];
    for &key in &keys {
        for (place, counts) in counts.iter_mut().enumerate() {
            counts[digit(key, place)] += 1;
        }
    }
    let mut other = vec![0; keys.len()];
    for (place, counts) in counts.iter_mut().enumerate() {
        // A digit that all have in common moves nothing.
        if counts.contains(&keys.len()) {
            continue;
        }
        let mut next = 0;
        for count in counts.iter_mut() {
            next += std::mem::replace(count, next);
        }
        for &key in &keys {
            let at = &mut counts[digit(key, place)];
            other[*at] = key;
            *at += 1;
        }
        std::mem::swap(&mut keys, &mut other);
    }
    keys
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_numbers_are_sorted_as_a_few_are() {
        let odd = [0.0, -0.0, 1.0, -1.0, f64::MAX, f64::MIN, f64::MIN_POSITIVE, -5e-324, 5e-324, 1.0 + f64::EPSILON];
        for count in [10, 2047, 2048, 5000] {
            let mixed = |i: u64| f64::from_bits(i.wrapping_mul(0x9e37_79b9_7f4a_7c15));
            let mut numbers: Vec<f64> = (0..count).map(mixed).filter(|x| x.is_finite()).collect();
            numbers.extend(odd);
            numbers.extend((0..count).map(|i| (i % 7) as f64));
            let mut expected = numbers.clone();
            expected.sort_by(f64::total_cmp);
            sort(&mut numbers);
            let bits = |numbers: &[f64]| numbers.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(&numbers), bits(&expected), "{count}");
        }
    }

    #[test]
    fn quantiles_of_a_handful() {
        assert_eq!(median(&mut []), None);
        assert_eq!(median(&mut [3.0, 1.0, 2.0]), Some(2.0));
        assert_eq!(median(&mut [4.0, 1.0, 2.0, 3.0]), Some(3.0));
        let mut numbers: Vec<f64> = (0..101).rev().map(f64::from).collect();
        assert_eq!(quantile(&mut numbers, 0.99), Some(99.0));
        assert_eq!(quantile(&mut numbers, 0.0), Some(0.0));
        assert_eq!(quantile(&mut [], 0.5), None);
    }
}
