//! Fewer points that look the same: of each group the least and the greatest.

/// So many points of a line are kept in a page. The page's script thins them further to what the screen shows, and
/// again on every zoom.
pub const POINTS: usize = 20_000;

/// Groups of neighbouring points, such that two points of each make at most [`POINTS`]; one point each where all fit.
pub fn group(count: usize, points: usize) -> usize {
    if count <= points { 1 } else { count.div_ceil(points / 2) }
}

/// Places that stand for groups of a size: the first and the last of each.
pub fn places(count: usize, size: usize) -> Vec<usize> {
    if size == 1 {
        return (0..count).collect();
    }
    (0..count).step_by(size).flat_map(|from| [from, (from + size).min(count) - 1]).collect()
}

/// The least and the greatest value of each group, in the order in which they come: values for [`places`].
pub fn extremes(y: &[Option<f64>], size: usize) -> Vec<Option<f64>> {
    if size == 1 {
        return y.to_vec();
    }
    let pair = |part: &[Option<f64>]| {
        let known = || part.iter().enumerate().filter_map(|(i, v)| Some((i, (*v)?)));
        let low = known().min_by(|a, b| a.1.total_cmp(&b.1));
        let high = known().max_by(|a, b| a.1.total_cmp(&b.1));
        match (low, high) {
            (Some(low), Some(high)) if low.0 <= high.0 => [Some(low.1), Some(high.1)],
            (Some(low), Some(high)) => [Some(high.1), Some(low.1)],
            _ => [None, None],
        }
    };
    y.chunks(size).flat_map(pair).collect()
}

/// Six significant digits: more are not seen in a figure. What is not finite cannot be drawn.
pub fn six_digits(v: f64) -> Option<f64> {
    if v.is_finite() { format!("{v:.5e}").parse().ok() } else { None }
}

#[cfg(test)]
mod tests {
    use super::{POINTS, extremes, group, places, six_digits};

    #[test]
    fn thinning_keeps_peaks_order_and_gaps() {
        let mut y: Vec<Option<f64>> = (0..36_000).map(|i| Some((f64::from(i) * 1e-3).sin() * 0.1)).collect();
        y[12_345] = Some(5.0);
        y[20_000..20_100].fill(None);
        let size = group(y.len(), POINTS);
        let (at, kept) = (places(y.len(), size), extremes(&y, size));
        assert!(kept.len() <= POINTS && at.len() == kept.len());
        assert!(kept.contains(&Some(5.0)) && kept.iter().filter(|v| v.is_none()).count() >= 46);
        assert!(at.windows(2).all(|p| p[0] < p[1]));
        assert_eq!((at[0], at[at.len() - 1]), (0, 35_999));
        assert_eq!(extremes(&[Some(2.0), Some(1.0)], group(2, POINTS)), [Some(2.0), Some(1.0)]);
        assert_eq!(extremes(&[Some(3.0), Some(1.0), None], 3), [Some(3.0), Some(1.0)]);
    }

    #[test]
    fn digits_are_limited() {
        assert_eq!(six_digits(1.0 / 3.0), Some(0.333_333));
        assert_eq!(six_digits(f64::NAN), None);
    }
}
