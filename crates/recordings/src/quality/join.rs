//! The quality of two stretches of one channel becomes that of both.

use super::thresholds::{GRID_VALUES, MIN_SAMPLES};
use super::{Extreme, Gaps, Grid, Quality, Tally, Timing, Values, Wrap};

/// Two stretches by their numbers of samples.
#[derive(Clone, Copy)]
struct Weights {
    earlier: f64,
    later: f64,
}

impl Weights {
    fn mean(self, earlier: f64, later: f64) -> f64 {
        // So written, the mean of equal numbers is that number to the last digit.
        earlier + (later - earlier) * (self.later / (self.earlier + self.later))
    }

    fn mean_of_known(self, earlier: Option<f64>, later: Option<f64>) -> Option<f64> {
        match (earlier, later) {
            (Some(earlier), Some(later)) => Some(self.mean(earlier, later)),
            (one, other) => one.or(other),
        }
    }
}

impl Quality {
    /// Whether there are values enough to show a grid, and there is none.
    pub(super) fn shows_no_grid(&self) -> bool {
        self.grid.is_none() && self.values.distinct >= GRID_VALUES
    }

    /// Both stretches together; `later` begins with the last sample of `self`, whose value is `shared`.
    pub(super) fn joined(self, later: Self, shared: f64) -> Self {
        let by = Weights { earlier: self.timing.samples as f64, later: later.timing.samples as f64 };
        let offset = self.timing.samples.saturating_sub(1);
        let grid = joined_grid(&self, &later);
        Self {
            grid,
            noise: by.mean_of_known(self.noise, later.noise),
            wrap: joined_wrap(self.wrap, later.wrap),
            values: self.values.joined(later.values, shared, offset, by),
            timing: self.timing.joined(later.timing, offset, by),
        }
    }
}

impl Timing {
    fn joined(self, later: Self, offset: usize, by: Weights) -> Self {
        let tally = |earlier: Tally, later: Tally| earlier.joined(later, offset);
        let jump = if later.largest_jump_s.abs() > self.largest_jump_s.abs() { &later } else { &self };
        Self {
            largest_jump_s: jump.largest_jump_s,
            samples: offset + later.samples,
            span_ns: match (self.span_ns, later.span_ns) {
                (Some(a), Some(b)) => Some((a.0.min(b.0), a.1.max(b.1))),
                (one, other) => one.or(other),
            },
            computed: self.computed
                && (later.computed && is_near(self.period_s, later.period_s) || later.samples < MIN_SAMPLES),
            period_s: by.mean_of_known(self.period_s, later.period_s),
            jitter_mad_s: by.mean(self.jitter_mad_s, later.jitter_mad_s),
            jitter_99_s: by.mean(self.jitter_99_s, later.jitter_99_s),
            bunched_share: by.mean(self.bunched_share, later.bunched_share),
            gaps: self.gaps.joined(later.gaps, offset),
            jumps_ahead: tally(self.jumps_ahead, later.jumps_ahead),
            jumps_back: tally(self.jumps_back, later.jumps_back),
            late: tally(self.late, later.late),
            duplicates: tally(self.duplicates, later.duplicates),
            out_of_order: tally(self.out_of_order, later.out_of_order),
        }
    }
}

impl Gaps {
    fn joined(self, later: Self, offset: usize) -> Self {
        let longer = later.longest_s > self.longest_s;
        Self {
            longest_s: self.longest_s.max(later.longest_s),
            longest_at: if longer { later.longest_at.map(|at| at.moved(offset)) } else { self.longest_at },
            total_s: self.total_s + later.total_s,
            tally: self.tally.joined(later.tally, offset),
        }
    }
}

impl Values {
    fn joined(self, mut later: Self, shared: f64, offset: usize, by: Weights) -> Self {
        later.longest_missing = later.longest_missing.map(|stretch| stretch.moved(offset));
        later.longest_stuck = later.longest_stuck.map(|(stretch, value)| (stretch.moved(offset), value));
        for extreme in later.low.iter_mut().chain(&mut later.high) {
            extreme.longest = extreme.longest.moved(offset);
            extreme.samples -= usize::from(extreme.value == shared);
        }
        if !shared.is_finite() {
            later.missing.forget_first();
        }
        let low = farther(self.low, later.low, |a, b| a < b);
        let high = farther(self.high, later.high, |a, b| a > b);
        let constant = low.zip(high).is_some_and(|(low, high)| low.value == high.value);
        let most = self.distinct.max(later.distinct);
        let run = by.mean(self.usual_run as f64, later.usual_run as f64);
        let longer_missing = later.longest_missing.map(|stretch| stretch.samples);
        let longer_stuck = later.longest_stuck.map(|(stretch, _)| stretch.samples);
        Self {
            missing: self.missing.joined(later.missing, offset),
            longest_missing: if longer_missing > self.longest_missing.map(|stretch| stretch.samples) {
                later.longest_missing
            } else {
                self.longest_missing
            },
            distinct: if constant { most } else { most.max(2) },
            median: by.mean_of_known(self.median, later.median),
            low,
            high,
            held_share: by.mean(self.held_share, later.held_share),
            usual_run: run.round() as usize,
            stuck: self.stuck.joined(later.stuck, offset),
            longest_stuck: if longer_stuck > self.longest_stuck.map(|(stretch, _)| stretch.samples) {
                later.longest_stuck
            } else {
                self.longest_stuck
            },
        }
    }
}

/// The extreme that is farther out; both together where they are the same value.
fn farther(a: Option<Extreme>, b: Option<Extreme>, is_farther: impl Fn(f64, f64) -> bool) -> Option<Extreme> {
    let (Some(a), Some(b)) = (a, b) else { return a.or(b) };
    if a.value == b.value {
        let longest = if b.longest.samples > a.longest.samples { b.longest } else { a.longest };
        return Some(Extreme { samples: a.samples + b.samples, longest, saturated: a.saturated || b.saturated, ..a });
    }
    Some(if is_farther(b.value, a.value) { b } else { a })
}

/// The finer grid; none where one stretch has values enough to show one and does not.
fn joined_grid(earlier: &Quality, later: &Quality) -> Option<Grid> {
    if earlier.shows_no_grid() || later.shows_no_grid() {
        return None;
    }
    let finer = |a: Grid, b: Grid| if b.step < a.step { b } else { a };
    let both = earlier.grid.into_iter().chain(later.grid);
    let width = both.clone().filter_map(|grid| grid.dead_band).reduce(f64::min);
    let grid = both.reduce(finer)?;
    Some(Grid { dead_band: width, ..grid })
}

/// The wraps of both; what wraps in one stretch need not be full in the other.
fn joined_wrap(earlier: Option<Wrap>, later: Option<Wrap>) -> Option<Wrap> {
    match (earlier, later) {
        (Some(a), Some(b)) if a.modulus == b.modulus => Some(Wrap { count: a.count + b.count, ..a }),
        (Some(_), Some(_)) => None,
        (one, other) => one.or(other),
    }
}

/// Equal to a millionth.
fn is_near(a: Option<f64>, b: Option<f64>) -> bool {
    a.zip(b).is_some_and(|(a, b)| (a - b).abs() <= 1e-6 * a.abs())
}
