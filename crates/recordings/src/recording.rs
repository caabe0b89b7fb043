//! A run of a robot: channels on clocks, what every reader produces and every writer takes.

use crate::channel::Channel;
use crate::error::RecordingError;
use crate::signal::Signal;

/// What stamped the samples of one or more channels. Two clocks need not agree.
#[derive(Debug, Clone, PartialEq)]
pub struct Clock {
    /// Where the stamps come from, for messages: the file's name.
    pub name: String,
    /// Samples per second as the mapping declares them, where it does.
    pub nominal_rate_hz: Option<f64>,
}

/// One run of one robot: channels in SI, at most one per signal.
#[derive(Debug, Clone, PartialEq)]
pub struct Recording {
    name: String,
    clocks: Vec<Clock>,
    channels: Vec<Channel>,
}

impl Recording {
    /// A recording of these channels, put into the order of [`Signal::ALL`].
    ///
    /// # Errors
    /// When two channels carry the same signal or a channel names a clock that is not there.
    pub fn new(
        name: impl Into<String>,
        clocks: Vec<Clock>,
        mut channels: Vec<Channel>,
    ) -> Result<Self, RecordingError> {
        let name = name.into();
        channels.sort_by_key(Channel::signal);
        refuse_twice(&name, channels.iter().map(Channel::signal))?;
        if let Some(lost) = channels.iter().find(|channel| channel.clock() >= clocks.len()) {
            return Err(RecordingError::NoSuchClock {
                recording: name,
                channel: lost.name().to_owned(),
                clock: lost.clock(),
                clocks: clocks.len(),
            });
        }
        Ok(Self { name, clocks, channels })
    }

    /// The run's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The clocks that [`Channel::clock`] counts.
    pub fn clocks(&self) -> &[Clock] {
        &self.clocks
    }

    /// All channels, in the order of [`Signal::ALL`].
    pub fn channels(&self) -> &[Channel] {
        &self.channels
    }

    /// The channel of a signal, where there is one.
    pub fn get(&self, signal: Signal) -> Option<&Channel> {
        self.channels.iter().find(|channel| channel.signal() == signal)
    }

    /// The channel of a signal by its id.
    pub fn by_name(&self, name: &str) -> Option<&Channel> {
        Signal::from_name(name).and_then(|signal| self.get(signal))
    }

    /// The channel of a signal that the caller cannot do without.
    ///
    /// # Errors
    /// When the recording has no such channel; the message lists what it has.
    pub fn require(&self, signal: Signal) -> Result<&Channel, RecordingError> {
        self.get(signal).ok_or_else(|| RecordingError::MissingSignal {
            recording: self.name.clone(),
            signal,
            mapped: self.channels.iter().map(Channel::name).collect::<Vec<_>>().join(", "),
        })
    }

    /// The same recording under another name.
    #[must_use]
    pub fn renamed(self, name: impl Into<String>) -> Self {
        Self { name: name.into(), ..self }
    }

    /// The recording in pieces of `length_ns`, counted from its first stamp, each under the same name; those without a
    /// sample are left out.
    pub fn pieces(&self, length_ns: i64) -> Vec<Self> {
        let spans = self.channels.iter().filter_map(Channel::span_ns);
        let Some((mut from_ns, last_ns)) = spans.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1))) else {
            return Vec::new();
        };
        let length_ns = length_ns.max(1);
        let mut out = Vec::new();
        let mut rest: Vec<usize> = vec![0; self.channels.len()];
        loop {
            let end_ns = from_ns.saturating_add(length_ns);
            let channels: Vec<Channel> =
                self.channels.iter().zip(&mut rest).filter_map(|(c, at)| c.until(at, end_ns)).collect();
            if !channels.is_empty() {
                out.push(Self { name: self.name.clone(), clocks: self.clocks.clone(), channels });
            }
            if end_ns > last_ns {
                return out;
            }
            // Nothing may have been recorded for hours.
            let next_ns = self.channels.iter().zip(&rest).filter_map(|(c, &at)| c.t_ns().get(at)).min();
            let ahead = next_ns.map_or(0, |next_ns| next_ns.saturating_sub(end_ns).div_euclid(length_ns));
            from_ns = end_ns.saturating_add(ahead.saturating_mul(length_ns));
        }
    }

    /// First and last instant over all channels of one clock, in ns.
    pub fn span_ns(&self, clock: usize) -> Option<(i64, i64)> {
        let spans = self.channels.iter().filter(|channel| channel.clock() == clock).filter_map(Channel::span_ns);
        spans.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
    }
}

/// Refuses channels, in order, of which two carry the same signal.
pub(crate) fn refuse_twice(recording: &str, signals: impl Iterator<Item = Signal>) -> Result<(), RecordingError> {
    let mut before = None;
    for signal in signals {
        if before.replace(signal) == Some(signal) {
            let (recording, channel) = (recording.to_owned(), signal.name().to_owned());
            return Err(RecordingError::ChannelTwice { recording, channel });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn clocks() -> Vec<Clock> {
        vec![Clock { name: "a.csv".to_owned(), nominal_rate_hz: None }]
    }

    #[test]
    fn constructors_refuse_what_breaks_the_promises() {
        let new = |t: &[i64], v: &[f64]| Channel::new(Signal::GyroZ, 0, t.to_vec(), v.to_vec());
        assert!(matches!(new(&[0, 1], &[0.0]), Err(RecordingError::UnequalLengths { stamps: 2, values: 1, .. })));
        assert!(matches!(new(&[1, 1], &[0.0, 0.0]), Err(RecordingError::StampsNotRising { index: 1, .. })));
        assert!(matches!(new(&[0, 1], &[0.0, f64::NAN]), Err(RecordingError::ValueNotFinite { index: 1, .. })));
        let good = new(&[0, 1], &[0.0, 1.0]).unwrap();
        let twice = Recording::new("r", clocks(), vec![good.clone(), good.clone()]);
        assert_eq!(
            twice.unwrap_err().to_string(),
            "recording r: two channels are called gyro_z; give each signal once"
        );
        assert!(matches!(Recording::new("r", vec![], vec![good]), Err(RecordingError::NoSuchClock { .. })));
    }

    #[test]
    fn pieces_follow_each_other_without_a_gap() {
        let gyro = Channel::new(Signal::GyroZ, 0, vec![5, 9, 10, 24, 9000], vec![1.0, 2.0, 3.0, 4.0, 5.0]).unwrap();
        let speed = Channel::new(Signal::CommandSpeedLeft, 0, vec![8, 15], vec![1.0, 2.0]).unwrap();
        let whole = Recording::new("r", clocks(), vec![gyro, speed]).unwrap();
        let stamps = |signal: Signal| {
            let of = |piece: &Recording| piece.get(signal).map(|c| c.t_ns().to_vec()).unwrap_or_default();
            whole.pieces(10).iter().map(of).collect::<Vec<_>>()
        };
        assert_eq!(stamps(Signal::GyroZ), [vec![5, 9, 10], vec![24], vec![9000]]);
        assert_eq!(stamps(Signal::CommandSpeedLeft), [vec![8], vec![15], vec![]]);
        assert_eq!(whole.pieces(i64::MAX), [whole]);
    }

    #[test]
    fn lookup_is_by_signal_and_by_name() {
        let gyro = Channel::new(Signal::GyroZ, 0, vec![5, 9], vec![1.0, 2.0]).unwrap();
        let speed = Channel::new(Signal::CommandSpeedLeft, 0, vec![1], vec![1.0]).unwrap();
        let recording = Recording::new("r", clocks(), vec![gyro.clone(), speed]).unwrap();
        assert_eq!(recording.get(Signal::GyroZ), Some(&gyro));
        assert_eq!(recording.by_name("gyro_z"), Some(&gyro));
        assert!(recording.channels()[0].attributes().set_point);
        assert_eq!(recording.span_ns(0), Some((1, 9)));
        let message = recording.require(Signal::PoseX).unwrap_err().to_string();
        assert_eq!(
            message,
            "recording r: no signal pose_x (m); map a column to it; mapped are: command_speed_left, gyro_z"
        );
    }
}
