//! Statistics that a few wild samples do not move, and the constants of the normal distribution.
//!
//! One rule for all quantiles: type 7 of Hyndman and Fan (1996), linear between the order statistics
//! at `(n − 1) p`, as in R, NumPy and Julia by default. statrs' `OrderStatistics` follows type 8, which
//! has no value at the ends of small samples, so it is not used for quantiles.

use statrs::distribution::{ContinuousCDF, Normal};

/// Sigmas within which 90 % of a normal distribution lie: `Φ⁻¹(0.95)`, as tables print it.
pub const NINETY: f64 = 1.645;
/// Sigmas within which 80 % of a normal distribution lie: `Φ⁻¹(0.9)`, as tables print it.
pub const EIGHTY: f64 = 1.282;
/// Sigmas within which 95 % of a normal distribution lie: `Φ⁻¹(0.975)`, as tables print it.
pub const NINETY_FIVE: f64 = 1.96;
/// Fall of a log-likelihood, nats, within which the 90 % profile interval of one number lies:
/// `½ χ²₁(0.90) = ½ · 1.645²`.
pub const NINETY_FALL: f64 = 1.353;
/// Standard deviation of a normal distribution over its median absolute deviation: `1/Φ⁻¹(0.75)`.
pub const MAD_TO_SIGMA: f64 = 1.4826;

/// The values in rising order, NaN of positive sign last.
pub fn sorted(values: impl IntoIterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.into_iter().collect();
    values.sort_unstable_by(f64::total_cmp);
    values
}

/// The quantile `p` in 0..=1 of sorted values, linear between neighbours (type 7); `None` of nothing.
pub fn quantile(sorted: &[f64], p: f64) -> Option<f64> {
    let last = sorted.len().checked_sub(1)?;
    let place = p.clamp(0.0, 1.0) * last as f64;
    let (low, high) = (place.floor() as usize, place.ceil() as usize);
    if low == high { Some(sorted[low]) } else { Some(between(sorted[low], sorted[high], place.fract())) }
}

/// [`quantile`] of values in any order, which it reorders, without sorting all of them.
pub fn select_quantile(values: &mut [f64], p: f64) -> Option<f64> {
    let last = values.len().checked_sub(1)?;
    let place = p.clamp(0.0, 1.0) * last as f64;
    let (_, &mut low, above) = values.select_nth_unstable_by(place.floor() as usize, f64::total_cmp);
    let next = above.iter().copied().min_by(f64::total_cmp);
    Some(next.filter(|_| place.fract() > 0.0).map_or(low, |high| between(low, high, place.fract())))
}

/// Without rounding of equal neighbours, and of the middle of two as `(a + b)/2` has it.
fn between(low: f64, high: f64, share: f64) -> f64 {
    if share == 0.5 { f64::midpoint(low, high) } else { low + share * (high - low) }
}

/// The median, of an even number the mean of the two in the middle; `None` of nothing.
pub fn median(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    select_quantile(&mut values.into_iter().collect::<Vec<_>>(), 0.5)
}

/// Median absolute deviation from the median, not scaled; `None` of nothing. See [`MAD_TO_SIGMA`].
pub fn median_absolute_deviation(values: &[f64]) -> Option<f64> {
    let middle = median(values.iter().copied())?;
    median(values.iter().map(|v| (v - middle).abs()))
}

/// Mean; `None` of nothing.
pub fn mean(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    let (sum, count) = values.into_iter().fold((0.0, 0_usize), |(sum, n), v| (sum + v, n + 1));
    (count > 0).then(|| sum / count as f64)
}

/// Mean and its standard error `√(Σ(x − x̄)² / (n (n − 1)))`: 0 and 0 of nothing, error 0 of one.
pub fn mean_with_error(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n.max(1.0);
    let square = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>();
    (mean, (square / (n * (n - 1.0)).max(1.0)).sqrt())
}

/// Root mean square; `None` of nothing.
pub fn rms(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    mean(values.into_iter().map(|v| v * v)).map(f64::sqrt)
}

/// Geometric mean of positive values; `None` of nothing.
pub fn geometric_mean(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    mean(values.into_iter().map(f64::ln)).map(f64::exp)
}

/// Effective number of weighted samples, `(Σw)²/Σw²` (Kish 1965); 0 of nothing.
pub fn effective_number(weights: impl IntoIterator<Item = f64>) -> f64 {
    let (sum, squares) = weights.into_iter().fold((0.0, 0.0), |(s, q), w| (s + w, q + w * w));
    if squares > 0.0 { sum * sum / squares } else { 0.0 }
}

/// Distribution function of the standard normal distribution: `Φ(z)`.
pub fn normal_cdf(z: f64) -> f64 {
    Normal::standard().cdf(z)
}

/// Quantile of the standard normal distribution: `Φ⁻¹(p)`, infinite at 0 and 1.
pub fn normal_quantile(p: f64) -> f64 {
    Normal::standard().inverse_cdf(p)
}

/// Which of these p-values are discoveries when at most the share `rate` of all that are reported may
/// be false, whatever their dependence (Benjamini and Yekutieli 2001).
pub fn discoveries(p: &[f64], rate: f64) -> Vec<bool> {
    let m = p.len() as f64;
    let harmonic: f64 = (1..=p.len()).map(|i| 1.0 / i as f64).sum();
    let limit = sorted(p.iter().copied())
        .into_iter()
        .enumerate()
        .filter(|(i, p)| *p <= rate * (i + 1) as f64 / (m * harmonic))
        .map(|(_, p)| p)
        .next_back();
    p.iter().map(|p| limit.is_some_and(|l| *p <= l)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_follow_type_seven() {
        // R: quantile(c(1, 2, 3, 4), c(0, .25, .5, .9, 1)).
        let v = sorted([3.0, 1.0, 2.0, 4.0]);
        let of = |p| quantile(&v, p).expect("values");
        assert_eq!([of(0.0), of(0.25), of(0.5), of(1.0)], [1.0, 1.75, 2.5, 4.0]);
        approx::assert_relative_eq!(of(0.9), 3.7, epsilon = 1e-15);
        assert_eq!((quantile(&[], 0.5), median([])), (None, None));
    }

    #[test]
    fn selection_agrees_with_sorting() {
        let values: Vec<f64> = (0..37).map(|k| f64::from(k * 17 % 37).sqrt()).collect();
        let ordered = sorted(values.iter().copied());
        for p in [0.0, 0.1, 0.25, 0.5, 0.77, 0.99, 1.0] {
            assert_eq!(select_quantile(&mut values.clone(), p), quantile(&ordered, p), "{p}");
        }
        assert_eq!((median([3.0, 1.0, 2.0]), median([4.0, 1.0, 2.0, 3.0])), (Some(2.0), Some(2.5)));
    }

    #[test]
    fn constants_are_those_of_the_distribution() {
        for (constant, exact) in [
            (NINETY, normal_quantile(0.95)),
            (NINETY_FIVE, normal_quantile(0.975)),
            (NINETY_FALL, 0.5 * normal_quantile(0.95).powi(2)),
            (MAD_TO_SIGMA, 1.0 / normal_quantile(0.75)),
        ] {
            approx::assert_abs_diff_eq!(constant, exact, epsilon = 5e-4);
        }
    }

    #[test]
    fn spreads_and_effective_numbers() {
        assert_eq!(median_absolute_deviation(&[1.0, 2.0, 3.0, 4.0, 100.0]), Some(1.0));
        assert_eq!((rms([3.0, -4.0, 0.0, 0.0]), rms([])), (Some(2.5), None));
        assert_eq!(mean_with_error(&[1.0, 3.0]), (2.0, 1.0));
        assert_eq!((mean_with_error(&[]), mean_with_error(&[4.0])), ((0.0, 0.0), (4.0, 0.0)));
        assert_eq!((effective_number([2.0; 5]), effective_number([1.0, 0.0])), (5.0, 1.0));
        assert_eq!(effective_number([]), 0.0);
    }

    #[test]
    fn discoveries_follow_benjamini_and_yekutieli() {
        // m = 4, harmonic sum 25/12: limits 0.006, 0.012, 0.018, 0.024.
        assert_eq!(discoveries(&[0.5, 0.001, 0.011, 0.03], 0.05), [false, true, true, false]);
        assert_eq!(discoveries(&[0.007, 0.5, 0.5, 0.5], 0.05), [false; 4]);
        assert!(discoveries(&[], 0.05).is_empty());
    }
}
