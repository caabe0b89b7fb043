//! One signal over time.

use crate::error::RecordingError;
use crate::signal::Signal;
use crate::units::Unit;

/// What a mapping says about a channel beyond its numbers.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Attributes {
    /// The source gives no sign: values are magnitudes.
    pub magnitude_only: bool,
    /// Smallest reading other than zero, in the channel's SI unit; below it the source shows zero.
    pub dead_band: Option<f64>,
    /// What was asked for, not what was measured.
    pub set_point: bool,
}

/// One signal over time. Stamps rise strictly, values are finite; a gap is a missing sample.
#[derive(Debug, Clone, PartialEq)]
pub struct Channel {
    signal: Signal,
    column: String,
    clock: usize,
    attributes: Attributes,
    t_ns: Vec<i64>,
    values: Vec<f64>,
}

impl Channel {
    /// A channel on clock `clock` of its recording, with `t_ns[i]` (ns) the instant of `values[i]` (SI).
    ///
    /// # Errors
    /// When lengths differ, stamps do not rise strictly or a value is not finite.
    pub fn new(signal: Signal, clock: usize, t_ns: Vec<i64>, values: Vec<f64>) -> Result<Self, RecordingError> {
        let channel = || signal.name().to_owned();
        if t_ns.len() != values.len() {
            return Err(RecordingError::UnequalLengths {
                channel: channel(),
                stamps: t_ns.len(),
                values: values.len(),
            });
        }
        if let Some(index) = (1..t_ns.len()).find(|&i| t_ns[i] <= t_ns[i - 1]) {
            let (before_ns, now_ns) = (t_ns[index - 1], t_ns[index]);
            return Err(RecordingError::StampsNotRising { channel: channel(), index, before_ns, now_ns });
        }
        if let Some(index) = values.iter().position(|value| !value.is_finite()) {
            return Err(RecordingError::ValueNotFinite { channel: channel(), index });
        }
        let attributes = Attributes { set_point: signal.is_set_point(), ..Attributes::default() };
        Ok(Self { signal, column: signal.column_name(), clock, attributes, t_ns, values })
    }

    /// The same channel with other attributes.
    #[must_use]
    pub fn with_attributes(mut self, attributes: Attributes) -> Self {
        self.attributes = attributes;
        self
    }

    /// The same channel with the name of the column that it came from.
    #[must_use]
    pub fn with_column(mut self, column: impl Into<String>) -> Self {
        self.column = column.into();
        self
    }

    /// What is measured.
    pub const fn signal(&self) -> Signal {
        self.signal
    }

    /// The signal's id: `wheel_speed_left`.
    pub const fn name(&self) -> &'static str {
        self.signal.name()
    }

    /// The SI unit of the values.
    pub const fn unit(&self) -> Unit {
        self.signal.unit()
    }

    /// The column (field, topic) that it came from.
    pub fn column(&self) -> &str {
        &self.column
    }

    /// Index into [`Recording::clocks`](crate::Recording::clocks) of the clock that stamped the samples.
    pub const fn clock(&self) -> usize {
        self.clock
    }

    /// What the mapping says beyond the numbers.
    pub const fn attributes(&self) -> Attributes {
        self.attributes
    }

    /// Instants of the samples in ns, strictly rising.
    pub fn t_ns(&self) -> &[i64] {
        &self.t_ns
    }

    /// Values of the samples in SI, finite.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Number of samples.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// True without any sample.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// Instants and values in pairs.
    pub fn samples(&self) -> impl ExactSizeIterator<Item = (i64, f64)> + '_ {
        self.t_ns.iter().copied().zip(self.values.iter().copied())
    }

    /// The values as angles, rad, without jumps by a turn: each lies within half a turn of the one before.
    pub fn unwrapped(&self) -> Vec<f64> {
        use std::f64::consts::{PI, TAU};
        let mut out: Vec<f64> = Vec::with_capacity(self.len());
        for angle in &self.values {
            let next = out.last().map_or(*angle, |last| last + ((angle - last + PI).rem_euclid(TAU) - PI));
            out.push(next);
        }
        out
    }

    /// The samples from index `at` on that lie before an instant, as a channel, when there are any; `at` moves behind them.
    pub(crate) fn until(&self, at: &mut usize, end_ns: i64) -> Option<Self> {
        let end = *at + self.t_ns[*at..].partition_point(|&t_ns| t_ns < end_ns);
        let range = std::mem::replace(at, end)..end;
        let (t_ns, values) = (self.t_ns[range.clone()].to_vec(), self.values[range].to_vec());
        (!t_ns.is_empty()).then(|| Self { t_ns, values, column: self.column.clone(), ..*self })
    }

    /// First and last instant in ns; `None` without samples.
    pub fn span_ns(&self) -> Option<(i64, i64)> {
        Some((*self.t_ns.first()?, *self.t_ns.last()?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_lose_their_jumps() {
        let channel = Channel::new(Signal::PoseYaw, 0, vec![0, 1, 2], vec![3.0, -3.0, -2.9]).expect("a channel");
        let turned = channel.unwrapped();
        assert!((turned[2] - turned[0] - (std::f64::consts::TAU - 5.9)).abs() < 1e-12, "{turned:?}");
    }
}
