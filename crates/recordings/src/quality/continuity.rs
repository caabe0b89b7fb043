//! Whether a signal went on over a step of the clock, or time passed.

use super::robust::quantile;
use super::thresholds::{CONTINUITY, CONTINUITY_MAX_PAIRS, CONTINUITY_MIN_PAIRS};

/// A signal's usual change from sample to sample, against that over a longer time.
pub(crate) struct Continuity<'a> {
    values: &'a [f64],
    period_s: f64,
    /// What changes between neighbours stay below: three times what nine in ten of them do.
    neighbours: f64,
}

impl<'a> Continuity<'a> {
    /// For values (not finite where missing) at a usual period.
    pub(crate) fn new(values: &'a [f64], period_s: f64) -> Self {
        let mut changes = changes(values, 1).collect::<Vec<_>>();
        Self { values, period_s, neighbours: 3.0 * quantile(&mut changes, 0.9).unwrap_or(0.0) }
    }

    /// True when the change over the step fits neighbours, while of the changes over as many samples as the step
    /// lasts hardly one is as small. A calm or coarse signal cannot tell: then false.
    pub(crate) fn goes_on(&self, from: usize, to: usize, seconds: f64) -> bool {
        let change = (self.values[to] - self.values[from]).abs();
        // A longer lag than a quarter leaves too few independent pairs; changes hardly grow with it any more.
        let lag = ((seconds / self.period_s).round() as usize).min(self.values.len() / 4);
        if !change.is_finite() || change > self.neighbours || lag < 2 {
            return false;
        }
        let (mut all, mut as_small) = (0, 0);
        let apart = (self.values.len() / CONTINUITY_MAX_PAIRS).max(1);
        for other in changes(self.values, lag).step_by(apart) {
            all += 1;
            as_small += usize::from(other <= self.neighbours);
        }
        all >= CONTINUITY_MIN_PAIRS && (as_small as f64) < CONTINUITY * all as f64
    }
}

/// Changes over `lag` samples, in size.
fn changes(values: &[f64], lag: usize) -> impl Iterator<Item = f64> + '_ {
    let later = values.get(lag..).unwrap_or_default();
    values.iter().zip(later).map(|(a, b)| (b - a).abs()).filter(|change| change.is_finite())
}
