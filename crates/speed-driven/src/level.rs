//! A load that is constant but for jumps: the cheapest such course through readings of which some are only bounds.

use inference::robust::{MAD_TO_SIGMA, median};
use statrs::distribution::{ContinuousCDF, Normal};

use crate::settings::{CHANGES, changes::Levels};
use crate::straight::Reading;

const LEVELS: Levels = CHANGES.levels;

/// Scatter of single exact readings about their neighbours, from the median difference.
fn scatter(readings: &[Option<Reading>], usual: f64) -> f64 {
    let exact: Vec<f64> = readings.iter().flatten().filter(|r| r.is_exact()).map(|r| r.value()).collect();
    if exact.len() <= LEVELS.few {
        return LEVELS.usual_scatter * usual;
    }
    let step = median(exact.windows(2).map(|w| (w[1] - w[0]).abs())).unwrap_or(0.0);
    (MAD_TO_SIGMA / std::f64::consts::SQRT_2 * step).max(LEVELS.least_scatter * usual)
}

/// The level at each row: piecewise constant, penalised by its jumps (a Potts functional, solved exactly on a grid of
/// levels by dynamic programming). `usual` is the load to expect, `period` the time between rows, s.
pub(crate) fn levels(readings: &[Option<Reading>], usual: f64, period: f64) -> Vec<f64> {
    let [low, high] = LEVELS.range;
    let grid: Vec<f64> =
        (0..=LEVELS.steps).map(|k| usual * (low + (high - low) * k as f64 / LEVELS.steps as f64)).collect();
    let sigma = scatter(readings, usual);
    let weight = LEVELS.per_second * period;
    let normal = Normal::standard();
    let plausible = |r: Reading, level: f64| match r {
        Reading::Exact(x) => -0.5 * LEVELS.freedom * (1.0 + ((x - level) / sigma).powi(2) / LEVELS.freedom).ln(),
        // A side winds up for a while, so that a bound says less than a reading.
        Reading::AtMost(x) => LEVELS.bound * normal.cdf((x - level) / sigma).max(1e-300).ln(),
    };
    let likely = |r: &Option<Reading>| -> Vec<f64> {
        grid.iter().map(|&level| r.map_or(0.0, |r| weight * plausible(r, level))).collect()
    };
    let Some((first, rest)) = readings.split_first() else { return Vec::new() };
    // Where nothing else is known the usual load is.
    let mut best: Vec<f64> =
        likely(first).iter().zip(&grid).map(|(l, level)| l - (level - usual).abs() / usual).collect();
    // Where a jump into each level would come from, and whether it was taken.
    let mut jumped: Vec<(usize, Vec<bool>)> = Vec::with_capacity(rest.len());
    for r in rest {
        let top = (0..best.len()).max_by(|&a, &b| best[a].total_cmp(&best[b])).unwrap_or(0);
        let jump = best[top] - LEVELS.jump;
        jumped.push((top, best.iter().map(|&stay| stay < jump).collect()));
        best = best.iter().zip(likely(r)).map(|(&stay, l)| stay.max(jump) + l).collect();
    }
    let mut at = (0..best.len()).max_by(|&a, &b| best[a].total_cmp(&best[b])).unwrap_or(0);
    let mut out = vec![grid[at]; readings.len()];
    for i in (0..jumped.len()).rev() {
        let (from, taken) = &jumped[i];
        at = if taken[at] { *from } else { at };
        out[i] = grid[at];
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    const PERIOD: f64 = 1.0 / 6.5;

    /// Readings that scatter evenly about a course.
    fn course(of: impl Fn(usize) -> Option<f64>, rows: usize) -> Vec<Option<Reading>> {
        (0..rows).map(|i| of(i).map(|x| Reading::Exact(x + [1.0, -1.5, 0.5, 0.0][i % 4]))).collect()
    }

    #[test]
    fn a_jump_is_found_where_it_is() {
        let found = levels(&course(|i| Some(if i < 120 { 11.0 } else { 20.0 }), 240), 11.0, PERIOD);
        let first = found.iter().position(|l| *l > 15.0).expect("a jump");
        assert!(first.abs_diff(120) <= 3, "{first}");
        approx::assert_abs_diff_eq!(found[0], 11.0, epsilon = 1.0);
        approx::assert_abs_diff_eq!(found[239], 20.0, epsilon = 1.0);
        assert_eq!(found.windows(2).filter(|w| (w[0] - w[1]).abs() > 1e-9).count(), 1);
    }

    #[test]
    fn single_readings_that_are_off_are_no_jump() {
        let found = levels(&course(|i| Some(if i % 29 == 7 { 40.0 } else { 11.0 }), 240), 11.0, PERIOD);
        assert!(found.iter().all(|l| (l - 11.0).abs() < 1.5), "{found:?}");
    }

    #[test]
    fn bounds_pull_down_only() {
        let low = |i: usize| (60..120).contains(&i);
        let mut readings = course(|_| Some(11.0), 180);
        for (i, r) in readings.iter_mut().enumerate() {
            if low(i) {
                *r = Some(Reading::AtMost(3.4));
            }
        }
        let found = levels(&readings, 11.0, PERIOD);
        assert!(found[90] < 3.4 && found[30] > 10.0 && found[150] > 10.0, "{found:?}");
        // A bound above the level says nothing.
        for r in readings.iter_mut().flatten().filter(|r| !r.is_exact()) {
            *r = Reading::AtMost(14.0);
        }
        assert!(levels(&readings, 11.0, PERIOD).iter().all(|l| (l - 11.0).abs() < 1.5));
    }

    #[test]
    fn rows_without_a_reading_keep_the_level() {
        let found = levels(&course(|i| (!(50..=150).contains(&i)).then_some(11.0), 200), 11.0, PERIOD);
        assert!(found.iter().all(|l| (l - 11.0).abs() < 1.5));
        assert!(levels(&[], 11.0, PERIOD).is_empty());
    }
}
