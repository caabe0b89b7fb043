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

#[cfg(test)]
mod tests {
    use super::*;

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
