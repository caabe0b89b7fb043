//! Order statistics of small samples, by the rule of `inference::robust` (type 7). They stay here because the paper's
//! experiments build with what they need and nothing else.

/// The sorted values, NaN last.
pub fn sorted(values: impl IntoIterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.into_iter().collect();
    values.sort_by(f64::total_cmp);
    values
}

/// The quantile `p` in 0..=1 of sorted values, linear between neighbours; `None` if there are none.
pub fn quantile(sorted: &[f64], p: f64) -> Option<f64> {
    let last = sorted.len().checked_sub(1)?;
    let place = p.clamp(0.0, 1.0) * last as f64;
    let (low, high) = (place.floor() as usize, (place.ceil() as usize).min(last));
    Some(sorted[low] + (place - low as f64) * (sorted[high] - sorted[low]))
}

/// The median; not a number if there are no values.
pub fn median(values: impl IntoIterator<Item = f64>) -> f64 {
    quantile(&sorted(values), 0.5).unwrap_or(f64::NAN)
}

/// Share of sorted values below `value`, in percent; 0 if there are none.
pub fn percentile_of(sorted: &[f64], value: f64) -> f64 {
    100.0 * sorted.partition_point(|v| *v < value) as f64 / sorted.len().max(1) as f64
}

/// Share of items for which `test` is true, in percent; 0 if there are none.
pub fn share<T>(items: &[T], test: impl Fn(&T) -> bool) -> f64 {
    100.0 * items.iter().filter(|item| test(item)).count() as f64 / items.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::{median, percentile_of, quantile, share, sorted};

    #[test]
    fn known_order_statistics() {
        let v = sorted([3.0, 1.0, 2.0, 4.0]);
        assert_eq!(quantile(&v, 0.5), Some(2.5));
        assert_eq!((quantile(&v, 0.0), quantile(&v, 1.0)), (Some(1.0), Some(4.0)));
        assert_eq!(percentile_of(&v, 2.5), 50.0);
        assert_eq!(share(&v, |x| *x > 1.0), 75.0);
        assert_eq!(quantile(&[], 0.5), None);
        assert_eq!(median([3.0, 1.0, 2.0, 4.0]), 2.5);
        assert!(median([]).is_nan());
    }
}
