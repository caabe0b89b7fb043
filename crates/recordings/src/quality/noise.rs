//! The noise of a signal, told from its motion by second differences.

use super::robust::median;
use super::thresholds::{BEND_MEDIANS, GAP_PERIODS, MIN_SAMPLES};
use super::timing::S_PER_NS;

/// Standard deviation of the white noise on a signal, in its unit:
///
/// ```text
/// σ² = mean (v[i-1] - 2 v[i] + v[i+1])² / 6 - step² / 12      over bends of at most six times their median size
/// ```
///
/// The variance of a second difference is six times that of a sample, and smooth motion drops out of it up to its
/// acceleration over one period; rounding to a step adds step² / 12. Six medians are four standard deviations: jumps
/// and hard turns are beyond, and a mean within tells coarse values finer than a median does. Triples over a gap do
/// not count. `None` with too few samples, and where the median is zero (values are held) or the rounding explains it
/// all: then the noise is below what can be seen.
pub(crate) fn noise_floor(t_ns: &[i64], values: &[f64], period_s: Option<f64>, step: Option<f64>) -> Option<f64> {
    let limit_s = GAP_PERIODS * period_s?;
    let near = |a: i64, b: i64| {
        let seconds = b.saturating_sub(a) as f64 * S_PER_NS;
        seconds > 0.0 && seconds <= limit_s
    };
    let triples = t_ns.windows(3).zip(values.windows(3));
    let together = triples.filter(|(t, _)| near(t[0], t[1]) && near(t[1], t[2]));
    let mut second: Vec<f64> =
        together.map(|(_, v)| (v[0] - 2.0 * v[1] + v[2]).abs()).filter(|bend| bend.is_finite()).collect();
    if second.len() < MIN_SAMPLES {
        return None;
    }
    let limit = BEND_MEDIANS * median(&mut second)?;
    second.retain(|&bend| bend <= limit);
    let variance = second.iter().map(|bend| bend * bend).sum::<f64>() / second.len() as f64 / 6.0
        - step.map_or(0.0, |step| step * step / 12.0);
    (variance > 0.0).then(|| variance.sqrt())
}
