//! Header stamps of a topic against its log times: how long messages take, and how far the two clocks drift apart.
//!
//! Messages pass once and memory is bounded: extremes are exact, the median is that of evenly spread messages, and the
//! drift is a robust line through the smallest delay of each of some hundred stretches. A network delays messages and
//! never hastens them, so that the smallest delays show the clocks.

use crate::fields::{Cell, FieldReader, HEADER_STAMP};
use crate::topic::{Message, Topic};

/// Delays that the median is taken of, at most.
const MOST_DELAYS: usize = 4096;
/// Stretches of a recording that the drift is taken of, at most; a power of two.
const MOST_STRETCHES: usize = 256;
/// Fewer stretches tell no drift.
const FEWEST_STRETCHES: usize = 16;

/// What the header stamps of a topic are.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct HeaderStamps {
    /// Messages with a stamp.
    pub set: u64,
    /// Messages whose stamp is 0: the driver did not set it.
    pub unset: u64,
    /// Log time minus stamp; `None` where no stamp is set.
    pub delay: Option<Delay>,
}

/// Log time minus header stamp.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Delay {
    /// Its median in ms.
    pub median_ms: f64,
    /// The smallest in ms; below zero where the clocks differ.
    pub smallest_ms: f64,
    /// The largest in ms.
    pub largest_ms: f64,
    /// How it changes; `None` for a handful of messages or instants.
    pub drift: Option<Drift>,
}

/// How much faster the clock of the log runs than that of the stamps.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Drift {
    /// Millionths, equal to µs per second.
    pub ppm: f64,
    /// Where it lies at 95 %, by the slopes that Theil and Sen's line is the median of.
    pub between_ppm: (f64, f64),
}

/// Looks at the messages of a topic and measures their stamps.
pub(crate) struct StampMeter {
    /// `None` for a topic without header stamps.
    reader: Option<FieldReader>,
    set: u64,
    unset: u64,
    extremes_ns: (i64, i64),
    delays: Thinned,
    stretches: Stretches,
}

impl StampMeter {
    /// A meter of a topic.
    pub(crate) fn new(topic: &Topic) -> Self {
        let reader = FieldReader::new(topic, &[HEADER_STAMP]).ok();
        let (delays, stretches) = (Thinned::default(), Stretches::default());
        Self { reader, set: 0, unset: 0, extremes_ns: (i64::MAX, i64::MIN), delays, stretches }
    }

    /// Looks at a message, whose header has this stamp by whoever walked it already; one that does not decode is counted
    /// elsewhere.
    pub(crate) fn look(&mut self, message: &Message<'_>, stamp: Option<i128>) {
        let Some(stamp) = stamp.or_else(|| self.read(message)) else { return };
        if stamp == 0 {
            self.unset += 1;
            return;
        }
        let Ok(stamp) = i64::try_from(stamp) else { return };
        let delay = message.log_time_ns.saturating_sub(stamp);
        self.set += 1;
        self.extremes_ns = (self.extremes_ns.0.min(delay), self.extremes_ns.1.max(delay));
        self.delays.add(delay);
        self.stretches.add(message.log_time_ns, delay);
    }

    /// The stamp of a message that was not walked.
    fn read(&mut self, message: &Message<'_>) -> Option<i128> {
        let cells = self.reader.as_ref()?.read(message.bytes)?;
        let Some(Cell::Whole(stamp)) = cells.first() else {
            // JSON is asked once: its other messages have no stamp either.
            self.reader = self.reader.take().filter(|_| self.set + self.unset > 0);
            return None;
        };
        Some(*stamp)
    }

    /// What was measured; `None` for a topic without header stamps.
    pub(crate) fn finish(self) -> Option<HeaderStamps> {
        let (set, unset) = (self.set, self.unset);
        let ms = |ns: i64| ns as f64 * 1e-6;
        let delay = self.delays.median().map(|median| Delay {
            median_ms: ms(median),
            smallest_ms: ms(self.extremes_ns.0),
            largest_ms: ms(self.extremes_ns.1),
            drift: self.stretches.drift(),
        });
        (set + unset > 0).then_some(HeaderStamps { set, unset, delay })
    }
}

/// Evenly spread ones of a list without end.
struct Thinned {
    kept: Vec<i64>,
    /// One in so many is kept.
    stride: u64,
    met: u64,
}

impl Default for Thinned {
    fn default() -> Self {
        Self { kept: Vec::new(), stride: 1, met: 0 }
    }
}

impl Thinned {
    fn add(&mut self, value: i64) {
        if self.met.is_multiple_of(self.stride) {
            self.kept.push(value);
        }
        self.met += 1;
        if self.kept.len() == MOST_DELAYS {
            let mut index = 0;
            self.kept.retain(|_| {
                index += 1;
                index % 2 == 1
            });
            self.stride *= 2;
        }
    }

    fn median(mut self) -> Option<i64> {
        let middle = self.kept.len() / 2;
        (!self.kept.is_empty()).then(|| *self.kept.select_nth_unstable(middle).1)
    }
}

/// The message with the smallest delay of each stretch: when it was logged, and its delay.
struct Stretches {
    lowest: Vec<(i64, i64)>,
    /// Messages of a stretch.
    length: u64,
    /// Messages in the last one.
    filled: u64,
}

impl Default for Stretches {
    fn default() -> Self {
        Self { lowest: Vec::new(), length: 1, filled: 0 }
    }
}

impl Stretches {
    fn add(&mut self, logged: i64, delay: i64) {
        match self.lowest.last_mut().filter(|_| self.filled > 0) {
            Some(last) if delay < last.1 => *last = (logged, delay),
            Some(_) => {}
            None => self.lowest.push((logged, delay)),
        }
        self.filled += 1;
        if self.filled < self.length {
            return;
        }
        self.filled = 0;
        if self.lowest.len() == MOST_STRETCHES {
            let lower = |pair: &[(i64, i64)]| pair.iter().copied().min_by_key(|&(_, delay)| delay);
            self.lowest = self.lowest.chunks(2).filter_map(lower).collect();
            self.length *= 2;
        }
    }

    /// The median of the slopes of all pairs.
    fn drift(&self) -> Option<Drift> {
        let points = &self.lowest;
        if points.len() < FEWEST_STRETCHES {
            return None;
        }
        let mut slopes: Vec<f64> = Vec::with_capacity(points.len() * points.len() / 2);
        for (index, (t_ns, delay)) in points.iter().enumerate() {
            for (before_ns, before) in &points[..index] {
                let seconds = t_ns.saturating_sub(*before_ns) as f64 * 1e-9;
                let slope = delay.saturating_sub(*before) as f64 * 1e-3 / seconds;
                slopes.extend(slope.is_finite().then_some(slope));
            }
        }
        slopes.sort_unstable_by(f64::total_cmp);
        let ppm = *slopes.get(slopes.len() / 2)?;
        // By the spread of Kendall's rank sum for points without a slope.
        let n = points.len() as f64;
        let spread = 1.96 * (n * (n - 1.0) * (2.0 * n + 5.0) / 18.0).sqrt() / slopes.len() as f64;
        let last = slopes.len() - 1;
        let at = |share: f64| slopes[(share.clamp(0.0, 1.0) * last as f64).round() as usize];
        Some(Drift { ppm, between_ppm: (at(0.5 * (1.0 - spread)), at(0.5 * (1.0 + spread))) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drift_under_a_network_that_delays_at_random_is_found_in_bounded_memory() {
        let (mut stretches, mut delays, mut random) = (Stretches::default(), Thinned::default(), 1_u64);
        for k in 0..100_000_i64 {
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            // 2 ms and up to 8 ms more, one in a hundred 300 ms more; 40 ppm at 100 Hz.
            let late = (random >> 33).cast_signed() % 8_000_000 + if random >> 57 == 0 { 300_000_000 } else { 0 };
            let delay = 2_000_000 + late + k * 400;
            stretches.add(k * 10_000_000, delay);
            delays.add(delay - k * 400);
        }
        assert!(stretches.lowest.len() <= MOST_STRETCHES && delays.kept.len() <= MOST_DELAYS);
        let Drift { ppm, between_ppm: (from, to) } = stretches.drift().unwrap();
        assert!((ppm - 40.0).abs() < 0.2, "{ppm}");
        assert!(from < ppm && ppm < to && to - from < 1.0, "{from} {to}");
        let median = delays.median().unwrap() as f64 * 1e-6;
        assert!((median - 6.0).abs() < 0.3, "{median}");
    }

    #[test]
    fn a_handful_of_messages_or_one_instant_tells_no_drift() {
        let of = |t: &dyn Fn(i64) -> i64, count: i64| {
            let mut stretches = Stretches::default();
            for k in 0..count {
                stretches.add(t(k), k);
            }
            stretches.drift()
        };
        assert_eq!(of(&|k| k, 15), None);
        assert_eq!(of(&|_| 7, 100), None);
        assert_eq!(of(&|k| k * 1_000_000, 100).map(|drift| drift.ppm.round()), Some(1.0));
    }
}
