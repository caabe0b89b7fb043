//! Every threshold of the measurements, with its reason. Shares are of 1.

/// A gap is longer than this many usual periods: one lost sample (2) is jitter of a busy bus, two (3) are a hole.
pub(crate) const GAP_PERIODS: f64 = 2.5;
/// The usual period is the longer of the median and this quantile, so that stamps in bursts are not full of gaps.
pub(crate) const USUAL_QUANTILE: f64 = 0.9;
/// A stamp that comes late but within this many samples is out of order; else the clock was set back. Message queues
/// of loggers reorder neighbours, not more.
pub(crate) const REORDER_SAMPLES: usize = 8;
/// Samples after a long step among which those that waited are looked for: a buffer that is emptied comes at once.
pub(crate) const MADE_UP_SAMPLES: usize = 8;
/// Periods shorter than this part of the usual one are of samples that waited.
pub(crate) const SHORT_PERIOD: f64 = 0.5;
/// A step ahead by a day or more is a clock that was set: no run pauses that long (a computer without a battery-backed
/// clock starts years ago and is set when it finds a network).
pub(crate) const SET_CLOCK_NS: i64 = 86_400_000_000_000;
/// A step ahead is a clock jump when fewer than this share of true pauses of its length change the value so little.
pub(crate) const CONTINUITY: f64 = 0.02;
/// Pairs of samples at a step's distance that are needed to say so ...
pub(crate) const CONTINUITY_MIN_PAIRS: usize = 200;
/// ... and about how many are looked at, so that many gaps cost no more than a few.
pub(crate) const CONTINUITY_MAX_PAIRS: usize = 2000;
/// Deviation of periods, relative to the period, below which stamps are computed: no oscillator and no operating
/// system together are that even.
pub(crate) const COMPUTED_JITTER: f64 = 1e-6;
/// Samples from which statements on shares and shapes are made at all.
pub(crate) const MIN_SAMPLES: usize = 100;
/// Periods shorter than this part of the usual one come from a buffer that was emptied at once.
pub(crate) const BUNCHED_PERIOD: f64 = 0.1;
/// Share of such periods from which stamps are called bunched: rarer ones are single hiccups.
pub(crate) const BUNCHED_SHARE: f64 = 0.005;
/// Deviation of 99 % of the periods, relative to the period, from which jitter is worth a warning: half a sample.
pub(crate) const LARGE_JITTER: f64 = 0.5;
/// A run of one value is stuck from this many samples on, in a signal of which every sample differs ...
pub(crate) const STUCK_SAMPLES: usize = 10;
/// ... and from this many times its usual run, in one that holds values or is coarse.
pub(crate) const STUCK_RUNS: usize = 10;
/// Share of samples that repeat the one before from which a signal is called held.
pub(crate) const HELD_SHARE: f64 = 0.3;
/// The same, from which it is called stepwise, as set-points are.
pub(crate) const STEPWISE_SHARE: f64 = 0.8;
/// Samples at an extreme from which it can be called saturated ...
pub(crate) const SATURATED_SAMPLES: usize = 10;
/// ... when they are this many times those in the band next to it (a quantised sine has 2.4 times) ...
pub(crate) const SATURATED_CONTRAST: usize = 5;
/// ... which is this part of the whole range wide ...
pub(crate) const SATURATED_BAND: f64 = 0.01;
/// ... and the signal has at least this many values: fewer make a switch, not a measurement ...
pub(crate) const SATURATED_VALUES: usize = 16;
/// ... and rests there at least once for this many times what it rests elsewhere (nine in ten stretches): a clipped wave
/// does, a lone peak and a set-point do not.
pub(crate) const SATURATED_RUNS: usize = 3;
/// Distance from the grid, in steps, within which a value lies on it: half of it is left to the rounding of the text.
pub(crate) const ON_GRID: f64 = 0.1;
/// Share of distinct values on the grid from which it is one; chance alone gives 0.2.
pub(crate) const GRID_SHARE: f64 = 0.9;
/// Distance from the grid, in steps, within which a value lies on it exactly: more than single precision needs.
pub(crate) const EXACT_GRID: f64 = 1e-3;
/// Share of distinct values exactly on the grid from which nothing finer is behind it.
pub(crate) const EXACT_SHARE: f64 = 0.99;
/// Root mean square misfit of a grid, in steps of the exact one that it was rounded to: 1/√12 by the rounding alone,
/// with room for the same again.
pub(crate) const ROUNDING: f64 = 0.58;
/// Distinct values from which a grid is looked for: chance finds one in fewer.
pub(crate) const GRID_VALUES: usize = 5;
/// Steps below this many units in the last place are the rounding of the arithmetic.
pub(crate) const GRID_ULPS: f64 = 64.0;
/// Visits to zero from which a dead band is told: a machine that starts and stops a few times has none.
pub(crate) const DEAD_BAND_VISITS: usize = 10;
/// Empty steps above zero from which a dead band is told.
pub(crate) const DEAD_BAND_STEPS: f64 = 3.0;
/// Part of the range of values that a dead band has at least: a narrower one is the resolution near zero.
pub(crate) const DEAD_BAND_RANGE: f64 = 0.01;
/// Second differences up to this many medians are noise: four standard deviations, which one in 16 000 exceeds.
pub(crate) const BEND_MEDIANS: f64 = 6.0;
