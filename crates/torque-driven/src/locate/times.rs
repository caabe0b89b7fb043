//! When the mismatch begins and ends, signal by signal.

use crate::channel::{Channel, Channels};
use crate::fit::Problem;
use crate::locate::change::{Change, Reference, Sense, find};
use crate::locate::compare::level;
use crate::locate::fault_free::{Energy, FaultFree};
use crate::locate::null::Null;
use crate::settings::locate::{Levels, SETTINGS, Spans};
use crate::windows::Cut;
use verdict::Span;

const SPANS: Spans = SETTINGS.spans;
const LEVELS: Levels = SETTINGS.levels;

/// ln(energy) of one channel in bins of `width` windows.
fn series(run: &[Vec<Channels<f64>>], c: Channel, width: usize) -> Vec<f64> {
    let windows: Vec<f64> = run.iter().flatten().map(|w| w[c]).collect();
    windows
        .chunks(width)
        .map(|bin| {
            let (n, sum) = bin.iter().filter(|e| e.is_finite()).fold((0.0, 0.0), |(n, s), e| (n + 1.0, s + e));
            level(if n > 0.0 { sum / n } else { f64::NAN })
        })
        .collect()
}

/// A change in seconds of its recording; `bin` is the length of a bin, s.
pub(crate) fn span(cut: &Cut, signal: &str, side: Option<usize>, change: &Change, bins: usize, bin: f64) -> Span {
    let end = bins as f64 * bin;
    // A bin that holds a border belongs half to each side of it, and a free run takes a moment to drift off.
    let around = |k: usize, ends: [usize; 2]| {
        let limits = [(ends[0] as f64 - 1.0) * bin, (ends[1] as f64 + 0.5) * bin];
        // The first and the last bin tell little: a robot at rest mismatches nothing.
        (k > 1 && k + 1 < bins).then(|| limits.map(|t| cut.from + t.clamp(0.0, end)))
    };
    Span {
        recording: cut.name.clone(),
        signal: signal.to_owned(),
        side: side.map(|s| inference::words::side(s).into()),
        interval: [change.from, change.until].map(|k| cut.from + k as f64 * bin),
        onset: around(change.from, change.onset),
        end: around(change.until, change.end),
        gain: change.gain,
    }
}

/// Stretches in which each signal of each recording mismatches the calibrated simulation.
pub(crate) fn spans(problem: &Problem<'_>, energy: &Energy, fault_free: &FaultFree) -> Vec<Span> {
    let longest = energy.iter().map(|run| run.iter().map(Vec::len).sum::<usize>()).max().unwrap_or(0);
    let width = SPANS.windows * longest.div_ceil(SPANS.windows * SPANS.most_bins).max(1);
    let known: Vec<Vec<Vec<f64>>> =
        Channel::ALL.map(|c| fault_free.energy.iter().map(|run| series(run, c, width)).collect()).into();
    let nulls = known.iter().map(|k| Null::new(k, LEVELS.between, LEVELS.least_within)).collect();
    let reference = Reference { series: known, nulls, sense: Sense::Rise };
    let segment = fault_free.energy.iter().flatten().map(Vec::len).max().unwrap_or(0);
    let threshold = reference.threshold(longest.div_ceil(width), (segment / width).max(1));
    let mut out = Vec::new();
    for (cut, run) in problem.cuts.iter().zip(energy) {
        let bin = (width * cut.rows_per_window) as f64 * cut.period;
        for (c, null) in Channel::ALL.into_iter().zip(&reference.nulls) {
            let Some(null) = null else { continue };
            let y = series(run, c, width);
            let found = find(&y, null, reference.sense, threshold);
            out.extend(found.iter().map(|f| span(cut, c.name(), c.side(), f, y.len(), bin)));
        }
    }
    out
}
