//! The fault-free distribution of a logarithmic level: its mean, its scatter within runs and between runs.

use crate::settings::locate::{Nulls, SETTINGS};

const NULLS: Nulls = SETTINGS.nulls;

/// The fault-free distribution of a level.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Null {
    pub(crate) mean: f64,
    /// Standard deviation within a run.
    pub(crate) within: f64,
    /// Standard deviation of run means.
    pub(crate) between: f64,
    /// Independent values per value, from the autocorrelation within runs.
    pub(crate) share: f64,
    /// Values and runs behind it.
    pub(crate) values: f64,
    pub(crate) runs: f64,
}

/// Mean and sum of squares about it of what is finite, with the count.
fn moments(values: &[f64]) -> (f64, f64, f64) {
    let finite = || values.iter().filter(|v| v.is_finite());
    let n = finite().count() as f64;
    let mean = finite().sum::<f64>() / n.max(1.0);
    (n, mean, finite().map(|v| (v - mean).powi(2)).sum())
}

impl Null {
    /// From the series of fault-free runs; `prior` is the usual scatter between runs, `least` the
    /// least scatter within. `None` when there are hardly any values.
    pub(crate) fn new(runs: &[Vec<f64>], prior: f64, least: f64) -> Option<Self> {
        let parts: Vec<(f64, f64, f64)> = runs.iter().map(|r| moments(r)).filter(|m| m.0 > 0.0).collect();
        let (count, values) = (parts.len() as f64, parts.iter().map(|m| m.0).sum::<f64>());
        if values - count < NULLS.least_values {
            return None;
        }
        let mean = parts.iter().map(|m| m.0 * m.1).sum::<f64>() / values;
        let within = (parts.iter().map(|m| m.2).sum::<f64>() / (values - count)).sqrt().max(least);
        let spread: f64 = parts.iter().map(|m| (m.1 - mean).powi(2)).sum();
        let between = ((NULLS.prior_runs * prior * prior + spread) / (NULLS.prior_runs + count - 1.0)).sqrt();
        let share = share(runs);
        Some(Self { mean, within, between, share, values, runs: count })
    }

    /// Standard deviation of a new run's mean about [`Null::mean`], which is itself an estimate.
    pub(crate) fn apart(&self) -> f64 {
        self.between * (1.0 + 1.0 / self.runs).sqrt()
    }

    /// Degrees of freedom of [`Null::between`].
    pub(crate) fn freedom(&self) -> f64 {
        NULLS.prior_runs + self.runs - 1.0
    }
}

/// `1 / (1 + 2 Σ ρ)` over the autocorrelation of the runs about their own means, up to its first zero.
fn share(runs: &[Vec<f64>]) -> f64 {
    let lagged = |lag: usize| {
        let mut sum = (0.0, 0.0);
        for run in runs {
            let (_, mean, squares) = moments(run);
            sum.1 += squares;
            for (a, b) in run.iter().zip(run.iter().skip(lag)) {
                if a.is_finite() && b.is_finite() {
                    sum.0 += (a - mean) * (b - mean);
                }
            }
        }
        if sum.1 > 0.0 { sum.0 / sum.1 } else { 0.0 }
    };
    let longest = runs.iter().map(Vec::len).max().unwrap_or(0) / NULLS.lags;
    let sum: f64 = (1..=longest).map(lagged).take_while(|r| *r > 0.0).sum();
    1.0 / (1.0 + 2.0 * sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::locate::change::Draws;

    #[test]
    fn autocorrelation_lowers_the_share_of_independent_values() {
        let mut draws = Draws::new(1);
        let white: Vec<Vec<f64>> = (0..4).map(|_| (0..200).map(|_| draws.normal()).collect()).collect();
        let coloured: Vec<Vec<f64>> =
            white.iter().map(|r| r.windows(5).map(|w| w.iter().sum::<f64>()).collect()).collect();
        assert!(share(&white) > 0.7, "{}", share(&white));
        // Means of five: one value in five is new.
        assert!((share(&coloured) - 0.2).abs() < 0.08, "{}", share(&coloured));
        let null = Null::new(&white, 0.2, 0.1).expect("values");
        assert!(null.mean.abs() < 0.15 && (null.within - 1.0).abs() < 0.1 && null.between < 0.2, "{null:?}");
        assert!(Null::new(&[vec![f64::NAN; 50]], 0.2, 0.1).is_none());
    }
}
