//! The step in which a signal is quantised, and the band around zero in which it shows nothing.

use super::runs::runs;
use super::thresholds::{
    DEAD_BAND_RANGE, DEAD_BAND_STEPS, DEAD_BAND_VISITS, EXACT_GRID, EXACT_SHARE, GRID_SHARE, GRID_ULPS, GRID_VALUES,
    MIN_SAMPLES, ON_GRID, ROUNDING,
};

/// Values on a grid: `anchor + k step` with whole k.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// The increment, in the channel's unit: the largest one that fits.
    pub step: f64,
    /// Share of the different values that lie on the grid to a tenth of the step; chance gives a fifth.
    pub fit: f64,
    /// Smallest magnitude other than zero, where zero is visited often and the three steps above it are empty.
    pub dead_band: Option<f64>,
}

/// How many candidates for the step are tried.
const CANDIDATES: usize = 32;

/// Values next to the median among which candidates are looked for: all when there are fewer.
const SEARCHED: usize = 1024;

/// How values lie on a grid.
#[derive(Debug, Clone, Copy)]
struct Fit {
    step: f64,
    /// Share of the values on the grid.
    share: f64,
    /// Share of the values exactly on it.
    exact: f64,
    /// Root mean square distance of those on the grid, in the channel's unit.
    off: f64,
}

impl Grid {
    /// The grid of values (not finite where missing; `sorted`: the others, in rising order); `None` without one.
    ///
    /// Candidates are the distances between neighbouring values and the differences of these; each is refined by least
    /// squares over ever longer distances from the median value, so that rounded decimals do not add up. The largest
    /// candidate on which the values lie exactly wins, or a larger one whose misfit is no more than the rounding to
    /// that. Takes time n log n.
    pub(crate) fn measure(values: &[f64], sorted: &[f64]) -> Option<Self> {
        if sorted.len() < MIN_SAMPLES {
            return None;
        }
        let mut distinct = sorted.to_vec();
        distinct.dedup();
        if distinct.len() < GRID_VALUES {
            return None;
        }
        let (low, high) = (distinct[0], distinct[distinct.len() - 1]);
        let smallest = GRID_ULPS * f64::EPSILON * low.abs().max(high.abs());
        let middle = distinct.len() / 2;
        let near = &distinct[middle.saturating_sub(SEARCHED / 2)..distinct.len().min(middle + SEARCHED / 2)];
        let tried = |values: &[f64], steps: Vec<f64>| -> Vec<Fit> {
            let refined = steps.into_iter().filter_map(|step| refine(values, step, smallest));
            refined.map(|step| fit(values, step)).collect()
        };
        let mut fits = tried(near, candidates(near, smallest));
        if near.len() < distinct.len() {
            // What is nowhere near a grid among neighbours is on none; the others are judged on all values.
            fits.retain(|fit| fit.exact >= EXACT_SHARE || fit.share >= GRID_SHARE);
            fits = tried(&distinct, fits.iter().map(|fit| fit.step).collect());
        }
        let exact = fits.iter().find(|fit| fit.exact >= EXACT_SHARE)?;
        let rounded = |fit: &&Fit| fit.share >= GRID_SHARE && fit.off <= ROUNDING * exact.step && fit.step > exact.step;
        let best = fits.iter().find(rounded).unwrap_or(exact);
        Some(Self { step: best.step, fit: best.share, dead_band: dead_band(values, best.step, high - low) })
    }
}

/// Distances that may be the step, largest first.
fn candidates(distinct: &[f64], smallest: f64) -> Vec<f64> {
    let mut gaps: Vec<f64> = distinct.windows(2).map(|pair| pair[1] - pair[0]).collect();
    gaps.sort_unstable_by(f64::total_cmp);
    // Equal to a thousandth: one candidate.
    gaps.dedup_by(|later, kept| *later <= *kept * 1.001 + smallest);
    gaps.truncate(CANDIDATES / 2);
    let mut tried: Vec<f64> = gaps.windows(2).map(|pair| pair[1] - pair[0]).chain(gaps.iter().copied()).collect();
    tried.retain(|&gap| gap > smallest);
    tried.sort_unstable_by(|a, b| b.total_cmp(a));
    tried.dedup_by(|later, kept| *later >= *kept * 0.999);
    tried
}

/// The step refined on all values that are on its grid, from the nearest to the median to the farthest.
fn refine(distinct: &[f64], step: f64, smallest: f64) -> Option<f64> {
    let anchor = distinct[distinct.len() / 2];
    let farthest = (distinct[distinct.len() - 1] - anchor).max(anchor - distinct[0]);
    let (mut step, mut reach) = (step, 8.0 * step);
    // At most as many rounds as there are factors of four between the smallest step and the largest number.
    loop {
        let near = distinct.partition_point(|&value| value < anchor - reach);
        let far = distinct.partition_point(|&value| value <= anchor + reach);
        let (mut above, mut below) = (0.0, 0.0);
        for value in &distinct[near..far] {
            let (k, off) = on(*value, anchor, step);
            if off.abs() < ON_GRID {
                above += k * (value - anchor);
                below += k * k;
            }
        }
        if below > 0.0 {
            step = above / below;
        }
        if !step.is_finite() || step <= smallest {
            return None;
        }
        if reach >= farthest {
            return Some(step);
        }
        reach *= 4.0;
    }
}

/// The nearest grid number of a value and its distance from there in steps.
fn on(value: f64, anchor: f64, step: f64) -> (f64, f64) {
    let steps = (value - anchor) / step;
    (steps.round(), steps - steps.round())
}

/// How values lie on the grid that is laid through the middle of those next to the grid of the median one.
fn fit(distinct: &[f64], step: f64) -> Fit {
    let median = distinct[distinct.len() / 2];
    let offs = |anchor: f64| distinct.iter().map(move |&value| on(value, anchor, step).1);
    let near = || offs(median).filter(|off| off.abs() < 2.0 * ON_GRID);
    let anchor = median + step * near().sum::<f64>() / near().count() as f64;
    let share = |limit: f64| offs(anchor).filter(|off| off.abs() < limit).count() as f64 / distinct.len() as f64;
    let on_grid = || offs(anchor).filter(|off| off.abs() < ON_GRID);
    let mean_square = on_grid().map(|off| off * off).sum::<f64>() / on_grid().count().max(1) as f64;
    Fit { step, share: share(ON_GRID), exact: share(EXACT_GRID), off: step * mean_square.sqrt() }
}

/// The smallest magnitude other than zero, where zero is visited often and empty steps lie above it.
fn dead_band(values: &[f64], step: f64, range: f64) -> Option<f64> {
    let visits = runs(values).filter(|run| run.value == Some(0.0)).count();
    let sizes = values.iter().filter(|value| value.is_finite()).map(|value| value.abs());
    let least = sizes.filter(|&size| size > 0.0).reduce(f64::min)?;
    let wide = least > (DEAD_BAND_STEPS * step).max(DEAD_BAND_RANGE * range);
    (visits >= DEAD_BAND_VISITS && wide).then_some(least)
}
