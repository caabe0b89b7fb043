//! What the stamps of a channel say: rate, jitter, gaps, jumps of the clock, order.

use super::continuity::Continuity;
use super::robust::{median, quantile};
use super::tally::{At, Tally};
use super::thresholds::{
    BUNCHED_PERIOD, COMPUTED_JITTER, GAP_PERIODS, MADE_UP_SAMPLES, MIN_SAMPLES, REORDER_SAMPLES, SET_CLOCK_NS,
    SHORT_PERIOD, USUAL_QUANTILE,
};

/// Seconds in a nanosecond.
pub(crate) const S_PER_NS: f64 = 1e-9;

/// Pauses: periods longer than 2.5 usual ones over which the signal did not simply go on.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Gaps {
    /// How many, and the samples that end the first of them.
    pub tally: Tally,
    /// Duration of the longest, s.
    pub longest_s: f64,
    /// The sample that ends the longest.
    pub longest_at: Option<At>,
    /// Duration of all together, s.
    pub total_s: f64,
}

/// What the stamps say, in the order in which they came.
#[derive(Debug, Clone, PartialEq)]
pub struct Timing {
    /// Number of samples.
    pub samples: usize,
    /// Smallest and largest stamp, ns; `None` without samples.
    pub span_ns: Option<(i64, i64)>,
    /// Usual period, s: the median of the steps between stamps that rise; where most samples come in bursts, the mean
    /// of those that are no gaps. `None` with fewer than two stamps that rise.
    pub period_s: Option<f64>,
    /// Median absolute deviation of the periods that are no gaps from the usual one, s.
    pub jitter_mad_s: f64,
    /// What 99 % of these deviations stay below, s.
    pub jitter_99_s: f64,
    /// Share of periods shorter than a tenth of the usual one: samples that arrived together.
    pub bunched_share: f64,
    /// True for stamps so even that they must be computed or rounded, not measured.
    pub computed: bool,
    /// Pauses.
    pub gaps: Gaps,
    /// Steps ahead by a day or more, or over which the signal goes on as between neighbours: the clock was set.
    pub jumps_ahead: Tally,
    /// Steps back that the stamps do not recover from within eight samples: the clock was set, or it wrapped.
    pub jumps_back: Tally,
    /// The largest jump ahead or back, s, signed; 0 without one.
    pub largest_jump_s: f64,
    /// Pauses of the stamps only: the samples that waited follow at once, so that none is missing.
    pub late: Tally,
    /// Samples with the stamp of the one before.
    pub duplicates: Tally,
    /// Samples stamped before one that came earlier, by reordering.
    pub out_of_order: Tally,
}

/// One step from a stamp to the next that counts.
#[derive(Debug, Clone, Copy)]
struct Step {
    from: usize,
    to: usize,
    ns: i64,
    /// True when reordered samples fill it.
    filled: bool,
}

impl Timing {
    /// Samples per second: one over the usual period.
    pub fn rate_hz(&self) -> Option<f64> {
        self.period_s.map(|period| 1.0 / period)
    }

    /// Largest stamp less smallest, s.
    pub fn duration_s(&self) -> f64 {
        self.span_ns.map_or(0.0, |(first, last)| last.saturating_sub(first) as f64 * S_PER_NS)
    }

    /// Measures stamps; the values tell pauses from clocks that were set.
    pub(crate) fn measure(t_ns: &[i64], values: &[f64]) -> Self {
        let at = |sample: usize| At { sample, t_ns: t_ns[sample] };
        let span_ns = t_ns.iter().min().copied().zip(t_ns.iter().max().copied());
        let (mut duplicates, mut out_of_order) = (Tally::default(), Tally::default());
        let steps = steps(t_ns, |i| duplicates.add(at(i)), |i| out_of_order.add(at(i)));

        let mut periods: Vec<f64> = steps.iter().filter(|s| s.ns > 0).map(|s| s.ns as f64 * S_PER_NS).collect();
        let middle = median(&mut periods);
        let usual = quantile(&mut periods, USUAL_QUANTILE);
        let limit_s = GAP_PERIODS * middle.unwrap_or(0.0).max(usual.unwrap_or(0.0));
        periods.retain(|&period| period <= limit_s);
        let mean = periods.iter().sum::<f64>() / periods.len().max(1) as f64;
        let period_s = middle.map(|middle| if 2.0 * middle < mean { mean } else { middle });

        let period = period_s.unwrap_or(0.0);
        let bunched = periods.iter().filter(|&&p| p < BUNCHED_PERIOD * period).count();
        let bunched_share = bunched as f64 / periods.len().max(1) as f64;
        let mut deviations: Vec<f64> = periods.iter().map(|p| (p - period).abs()).collect();
        let jitter_99_s = quantile(&mut deviations, 0.99).unwrap_or(0.0);
        let jitter_mad_s = median(&mut deviations).unwrap_or(0.0);
        let computed = t_ns.len() >= MIN_SAMPLES && jitter_99_s <= COMPUTED_JITTER * period + S_PER_NS;

        let mut timing = Self {
            samples: t_ns.len(),
            span_ns,
            period_s,
            jitter_mad_s,
            jitter_99_s,
            bunched_share,
            computed,
            gaps: Gaps::default(),
            jumps_ahead: Tally::default(),
            jumps_back: Tally::default(),
            largest_jump_s: 0.0,
            late: Tally::default(),
            duplicates,
            out_of_order,
        };
        let continuity = Continuity::new(values, period);
        for (index, step) in steps.iter().enumerate() {
            let seconds = step.ns as f64 * S_PER_NS;
            if step.ns < 0 {
                timing.jumps_back.add(at(step.to));
            } else if seconds <= limit_s || step.filled {
                continue;
            } else if is_made_up(&steps[index..], period) {
                timing.late.add(at(step.to));
                continue;
            } else if step.ns >= SET_CLOCK_NS
                || is_taken_back(&steps[index..], limit_s)
                || continuity.goes_on(step.from, step.to, seconds)
            {
                timing.jumps_ahead.add(at(step.to));
            } else {
                timing.gaps.add(at(step.to), seconds);
                continue;
            }
            if seconds.abs() > timing.largest_jump_s.abs() {
                timing.largest_jump_s = seconds;
            }
        }
        timing
    }
}

impl Gaps {
    fn add(&mut self, at: At, seconds: f64) {
        self.tally.add(at);
        self.total_s += seconds;
        if seconds > self.longest_s {
            (self.longest_s, self.longest_at) = (seconds, Some(at));
        }
    }
}

/// The steps between stamps that are neither repeated nor reordered; these are told one by one.
fn steps(t_ns: &[i64], mut duplicate: impl FnMut(usize), mut out_of_order: impl FnMut(usize)) -> Vec<Step> {
    let mut steps: Vec<Step> = Vec::with_capacity(t_ns.len().saturating_sub(1));
    let mut from = 0;
    for to in 1..t_ns.len() {
        let ns = t_ns[to].saturating_sub(t_ns[from]);
        if ns == 0 {
            duplicate(to);
            continue;
        }
        if ns < 0 {
            let soon = &t_ns[to + 1..t_ns.len().min(to + 1 + REORDER_SAMPLES)];
            if soon.len() < REORDER_SAMPLES || soon.iter().any(|&t| t > t_ns[from]) {
                out_of_order(to);
                let holds = |step: &&mut Step| t_ns[step.from] < t_ns[to] && t_ns[to] < t_ns[step.to];
                if let Some(step) = steps.iter_mut().rev().take(2 * REORDER_SAMPLES).find(holds) {
                    step.filled = true;
                }
                continue;
            }
        }
        steps.push(Step { from, to, ns, filled: false });
        from = to;
    }
    steps
}

/// True when the long first step is made up for by short ones right after it: half as many as it swallowed, or of the
/// few that are looked at.
fn is_made_up(steps: &[Step], period_s: f64) -> bool {
    let Some((long, after)) = steps.split_first() else { return false };
    let swallowed = (long.ns as f64 * S_PER_NS / period_s).round() as usize;
    let looked = swallowed.saturating_sub(1).min(MADE_UP_SAMPLES);
    let short = |step: &&Step| step.ns > 0 && (step.ns as f64) * S_PER_NS < SHORT_PERIOD * period_s;
    2 * after.iter().take(looked).filter(short).count() >= looked.max(1)
}

/// True when the long first step is undone by a step back within a few samples: a wrong stamp, not a pause.
fn is_taken_back(steps: &[Step], limit_s: f64) -> bool {
    let mut sum_s = 0.0;
    for step in steps.iter().take(1 + REORDER_SAMPLES) {
        sum_s += step.ns as f64 * S_PER_NS;
        if step.ns < 0 {
            return sum_s > -limit_s && sum_s < limit_s * REORDER_SAMPLES as f64;
        }
    }
    false
}
