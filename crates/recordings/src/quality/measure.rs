//! All measures of one channel together.

use super::grid::Grid;
use super::timing::Timing;
use super::values::Values;
use super::wraps::{self, Wrap};
use super::{noise, robust};
use crate::channel::Channel;

/// The quality of one channel's stamps and values.
#[derive(Debug, Clone, PartialEq)]
pub struct Quality {
    /// Rate, jitter, gaps, jumps of the clock, order.
    pub timing: Timing,
    /// Range, missing, held and stuck values, saturation.
    pub values: Values,
    /// The quantisation, where the values lie on a grid.
    pub grid: Option<Grid>,
    /// Standard deviation of the white noise, in the channel's unit; `None` where it is below what can be seen.
    pub noise: Option<f64>,
    /// The wrap of a counter or an angle.
    pub wrap: Option<Wrap>,
}

impl Quality {
    /// Measures samples in the order in which they came: `t_ns[i]` (ns, in any order) is the stamp of `values[i]`; a
    /// value that is not finite is missing. Samples beyond the shorter slice are left out. Takes time n log n.
    ///
    /// ```
    /// use recordings::{FindingKind, Quality};
    /// let mut t_ns: Vec<i64> = (0..500).map(|i| i * 20_000_000 + i * i % 7 * 1000).collect();
    /// t_ns.iter_mut().skip(300).for_each(|t| *t += 3_000_000_000);
    /// let values: Vec<f64> = (0..500).map(|i| f64::from(i % 7)).collect();
    /// let quality = Quality::measure(&t_ns, &values);
    /// assert_eq!(quality.timing.rate_hz().map(f64::round), Some(50.0));
    /// assert_eq!(quality.timing.gaps.tally.count, 1);
    /// let gap = &quality.findings("m")[0];
    /// assert_eq!((gap.kind, gap.at.map(|at| at.sample)), (FindingKind::Gaps, Some(300)));
    /// assert_eq!(gap.to_string(), "1 gap, the longest 3.02 s, 23 % of the time");
    /// ```
    pub fn measure(t_ns: &[i64], values: &[f64]) -> Self {
        Self::measure_part(t_ns, values, true)
    }

    /// The same of a part of a channel; without a grid where others have shown that there is none.
    pub(super) fn measure_part(t_ns: &[i64], values: &[f64], perhaps_on_grid: bool) -> Self {
        let samples = t_ns.len().min(values.len());
        let (t_ns, values) = (&t_ns[..samples], &values[..samples]);
        let mut sorted: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
        robust::sort(&mut sorted);
        let timing = Timing::measure(t_ns, values);
        let grid = if perhaps_on_grid { Grid::measure(values, &sorted) } else { None };
        let noise = noise::noise_floor(t_ns, values, timing.period_s, grid.map(|grid| grid.step));
        let range = sorted.first().zip(sorted.last());
        let wrap = range.and_then(|(&low, &high)| wraps::wrap(values, low, high));
        Self { timing, values: Values::measure(t_ns, values, &sorted), grid, noise, wrap }
    }

    /// Measures a channel.
    pub fn of(channel: &Channel) -> Self {
        Self::measure(channel.t_ns(), channel.values())
    }
}
