//! Channels between their samples.

use recordings::Channel;

/// An interval longer than this many periods is a gap: a lost sample or two is bridged, more is not.
pub(super) const GAP_PERIODS: f64 = 3.0;

/// The middle one of the intervals between stamps, ns; at least 1.
pub(super) fn period_ns(t_ns: &[i64]) -> i64 {
    let mut intervals: Vec<i64> = t_ns.windows(2).map(|w| w[1] - w[0]).collect();
    intervals.sort_unstable();
    intervals.get(intervals.len() / 2).copied().unwrap_or(1).max(1)
}

/// The longest interval that is no gap, ns.
pub(super) fn longest_ns(t_ns: &[i64]) -> i64 {
    (GAP_PERIODS * period_ns(t_ns) as f64) as i64
}

/// A channel with what is a gap in it.
pub(super) struct Line<'a> {
    t_ns: &'a [i64],
    values: &'a [f64],
    longest: i64,
}

impl<'a> Line<'a> {
    pub(super) fn new(channel: &'a Channel) -> Self {
        Self { t_ns: channel.t_ns(), values: channel.values(), longest: longest_ns(channel.t_ns()) }
    }

    /// The sample at an instant, or on the straight line between its neighbours; `None` in a gap.
    pub(super) fn at(&self, t: i64) -> Option<f64> {
        match self.t_ns.binary_search(&t) {
            Ok(i) => Some(self.values[i]),
            Err(i) => {
                let (a, b) = (i.checked_sub(1)?, i);
                let (from, until) = (self.t_ns[a], *self.t_ns.get(b)?);
                if until - from > self.longest {
                    return None;
                }
                let share = (t - from) as f64 / (until - from) as f64;
                Some(self.values[a] + share * (self.values[b] - self.values[a]))
            }
        }
    }

    /// The last sample at or before an instant; `None` in a gap.
    pub(super) fn held(&self, t: i64) -> Option<f64> {
        let i = self.t_ns.partition_point(|s| *s <= t).checked_sub(1)?;
        (t - self.t_ns[i] <= self.longest).then(|| self.values[i])
    }
}

#[cfg(test)]
mod tests {
    use recordings::Signal;

    use super::*;

    #[test]
    fn a_line_bridges_one_sample_but_no_gap() {
        let t: Vec<i64> = vec![0, 10, 20, 40, 50, 60, 200, 210];
        let v = vec![0.0, 1.0, 2.0, 4.0, 5.0, 6.0, 20.0, 21.0];
        let channel = Channel::new(Signal::WheelSpeedLeft, 0, t, v).unwrap();
        let line = Line::new(&channel);
        assert_eq!(line.at(10), Some(1.0));
        assert_eq!(line.at(30), Some(3.0));
        assert_eq!(line.at(100), None);
        assert_eq!(line.held(49), Some(4.0));
        assert_eq!(line.held(100), None);
        assert_eq!((line.at(-1), line.held(-1), line.at(211)), (None, None, None));
        assert_eq!(line.held(230), Some(21.0));
    }
}
