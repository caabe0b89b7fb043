//! What the values of a channel say: range, missing ones, held and stuck ones, saturation.

use super::robust::{median, quantile};
use super::runs::{Run, runs};
use super::tally::{At, Tally};
use super::thresholds::{
    MIN_SAMPLES, SATURATED_BAND, SATURATED_CONTRAST, SATURATED_RUNS, SATURATED_SAMPLES, SATURATED_VALUES, STUCK_RUNS,
    STUCK_SAMPLES,
};

/// A stretch of equal values, or of none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stretch {
    /// Its first sample.
    pub at: At,
    /// Number of samples.
    pub samples: usize,
    /// From its first to its last stamp, s.
    pub seconds: f64,
}

impl Stretch {
    /// The same stretch, counted from `offset` samples earlier.
    pub(super) const fn moved(self, offset: usize) -> Self {
        Self { at: self.at.moved(offset), ..self }
    }
}

/// The samples at the smallest or the largest value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extreme {
    /// The value.
    pub value: f64,
    /// How many samples are exactly there.
    pub samples: usize,
    /// The longest stretch of them.
    pub longest: Stretch,
    /// True when the samples pile up there as in a clipped signal: at least five times as many as in the next hundredth
    /// of the range, and at least once three times as long as the signal rests elsewhere.
    pub saturated: bool,
}

/// What the values say.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Values {
    /// Samples whose value is missing (not a finite number).
    pub missing: Tally,
    /// The longest stretch of missing values.
    pub longest_missing: Option<Stretch>,
    /// Number of different values.
    pub distinct: usize,
    /// Median of the values; `None` without any.
    pub median: Option<f64>,
    /// The smallest value and the samples there.
    pub low: Option<Extreme>,
    /// The largest value and the samples there.
    pub high: Option<Extreme>,
    /// Share of samples that repeat the one before.
    pub held_share: f64,
    /// Median length of the stretches of equal values, in samples.
    pub usual_run: usize,
    /// Stretches of one value that are much longer than usual in this signal.
    pub stuck: Tally,
    /// The longest of them, and its value.
    pub longest_stuck: Option<(Stretch, f64)>,
}

impl Values {
    /// True when every value is the same.
    pub const fn constant(&self) -> bool {
        self.distinct == 1
    }

    /// Measures values; those that are not finite are missing. `sorted` are the finite ones in order.
    pub(crate) fn measure(t_ns: &[i64], values: &[f64], sorted: &[f64]) -> Self {
        let at = |sample: usize| At { sample, t_ns: t_ns[sample] };
        let stretch = |run: &Run| {
            let (first, last) = (t_ns[run.start], t_ns[run.start + run.len - 1]);
            let seconds = last.saturating_sub(first) as f64 * super::timing::S_PER_NS;
            Stretch { at: at(run.start), samples: run.len, seconds }
        };
        let mut measured = Self {
            distinct: usize::from(!sorted.is_empty()) + sorted.windows(2).filter(|pair| pair[0] != pair[1]).count(),
            ..Self::default()
        };
        let mut held: Vec<Run> = Vec::new();
        for run in runs(values) {
            if run.value.is_some() {
                held.push(run);
                continue;
            }
            (run.start..run.start + run.len).for_each(|sample| measured.missing.add(at(sample)));
            if measured.longest_missing.is_none_or(|longest| longest.samples < run.len) {
                measured.longest_missing = Some(stretch(&run));
            }
        }
        let (Some(&low), Some(&high)) = (sorted.first(), sorted.last()) else { return measured };
        measured.median = sorted.get(sorted.len() / 2).copied();
        measured.held_share = 1.0 - held.len() as f64 / sorted.len() as f64;
        let mut lengths: Vec<f64> = held.iter().map(|run| run.len as f64).collect();
        measured.usual_run = median(&mut lengths).unwrap_or(0.0) as usize;
        let long = quantile(&mut lengths, 0.75).unwrap_or(0.0) as usize;

        let at_value = |value: f64| held.iter().filter(move |run| run.value == Some(value));
        let inside = |run: &&Run| run.value != Some(low) && run.value != Some(high);
        let mut lengths: Vec<f64> = held.iter().filter(inside).map(|run| run.len as f64).collect();
        let plateau = quantile(&mut lengths, 0.9).unwrap_or(1.0) as usize;
        let extreme = |value: f64, next: usize| {
            let samples = at_value(value).map(|run| run.len).sum();
            let longest = at_value(value).reduce(|a, b| if b.len > a.len { b } else { a }).map(stretch)?;
            let saturated = measured.distinct >= SATURATED_VALUES
                && samples >= SATURATED_SAMPLES.max(SATURATED_CONTRAST * next)
                && longest.samples >= SATURATED_RUNS * plateau;
            Some(Extreme { value, samples, longest, saturated })
        };
        let (low, high) = (extreme(low, next_above(sorted)), extreme(high, next_below(sorted)));
        (measured.low, measured.high) = (low, high);

        let limit = STUCK_SAMPLES.max(STUCK_RUNS * long);
        let clipped = |value| [low, high].iter().flatten().any(|e| e.saturated && Some(e.value) == value);
        if measured.distinct > 1 && sorted.len() >= MIN_SAMPLES {
            for run in held.iter().filter(|run| run.len >= limit && !clipped(run.value)) {
                measured.stuck.add(at(run.start));
                if measured.longest_stuck.is_none_or(|(longest, _)| longest.samples < run.len) {
                    measured.longest_stuck = run.value.map(|value| (stretch(run), value));
                }
            }
        }
        measured
    }
}

/// How many samples lie in the band next to the smallest value: a hundredth of the range, or up to the next value.
fn next_above(sorted: &[f64]) -> usize {
    let (low, high) = (sorted[0], sorted[sorted.len() - 1]);
    let above = sorted.partition_point(|&value| value <= low);
    let Some(&next) = sorted.get(above) else { return 0 };
    let edge = next.max(low + SATURATED_BAND * (high - low));
    sorted.partition_point(|&value| value <= edge) - above
}

/// The same below the largest value.
fn next_below(sorted: &[f64]) -> usize {
    let (low, high) = (sorted[0], sorted[sorted.len() - 1]);
    let below = sorted.partition_point(|&value| value < high);
    let Some(&next) = below.checked_sub(1).and_then(|index| sorted.get(index)) else { return 0 };
    let edge = next.min(high - SATURATED_BAND * (high - low));
    below - sorted.partition_point(|&value| value < edge)
}
