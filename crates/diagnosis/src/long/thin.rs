//! A recording with fewer rows: what a diagnosis needs of one that was taken very often.

use recordings::{Channel, Recording, RecordingError, Signal};

use crate::settings::{SETTINGS, Thinning};

const THINNING: Thinning = SETTINGS.thinning;
/// Time between the rows that are left, ns.
const STEP_NS: i64 = THINNING.step_ns;

/// What stands for the samples of a step.
enum Stands {
    /// Their mean, at the start of the step: it is held from there on.
    HeldMean,
    /// Their mean, at the end of the step: it was measured until there.
    MeasuredMean,
    /// The first of them.
    First,
}

/// The same recording with one sample in 10 ms of every channel that has two or more.
pub(super) fn thinned(piece: &Recording) -> Result<Recording, RecordingError> {
    let channels = piece.channels().iter().map(|channel| {
        let (from, until) = channel.span_ns().unwrap_or_default();
        let few = THINNING.complete * THINNING.worth_it;
        if channel.len() as f64 * STEP_NS as f64 <= few * (until - from) as f64 {
            return Ok(channel.clone());
        }
        let (t_ns, values) = thin(channel, &stands(channel));
        let thin = Channel::new(channel.signal(), channel.clock(), t_ns, values)?;
        Ok(thin.with_attributes(channel.attributes()).with_column(channel.column()))
    });
    Recording::new(piece.name(), piece.clocks().to_vec(), channels.collect::<Result<_, RecordingError>>()?)
}

fn stands(channel: &Channel) -> Stands {
    match channel.signal() {
        Signal::TorqueLeft | Signal::TorqueRight => Stands::HeldMean,
        Signal::WheelAngleLeft | Signal::WheelAngleRight | Signal::PoseX | Signal::PoseY | Signal::PoseYaw => {
            Stands::First
        }
        _ if channel.attributes().set_point => Stands::HeldMean,
        _ => Stands::MeasuredMean,
    }
}

fn thin(channel: &Channel, stands: &Stands) -> (Vec<i64>, Vec<f64>) {
    let (mut stamps, mut values) = (Vec::new(), Vec::new());
    let mut samples = channel.samples().peekable();
    while let Some((first_ns, first)) = samples.next() {
        let step = first_ns.div_euclid(STEP_NS);
        let (mut sum, mut count) = (first, 1.0);
        while let Some((_, value)) = samples.next_if(|(t_ns, _)| t_ns.div_euclid(STEP_NS) == step) {
            sum += value;
            count += 1.0;
        }
        let (stamp, value) = match stands {
            Stands::HeldMean => (step * STEP_NS, sum / count),
            Stands::MeasuredMean => ((step + 1) * STEP_NS, sum / count),
            Stands::First => (first_ns, first),
        };
        stamps.push(stamp);
        values.push(value);
    }
    (stamps, values)
}

#[cfg(test)]
mod tests {
    use super::*;
    use testing::recording;

    #[test]
    fn ten_rows_become_one_each_at_its_instant() {
        let samples = |rate: f64| (0..1000).map(|k| (f64::from(k) / rate, f64::from(k))).collect::<Vec<_>>();
        let fast = [Signal::TorqueLeft, Signal::GyroZ, Signal::WheelAngleLeft].map(|s| (s, samples(1000.0)));
        let slow = (Signal::AccelX, samples(100.0));
        let all: Vec<_> = fast.into_iter().chain([slow]).collect();
        let whole = recording(&all);
        let thin = thinned(&whole).expect("a recording");
        let first = |s: Signal| {
            let c = thin.get(s).expect("there");
            (c.len(), c.t_ns()[1], c.values()[1])
        };
        assert_eq!(first(Signal::TorqueLeft), (100, 10_000_000, 14.5));
        assert_eq!(first(Signal::GyroZ), (100, 20_000_000, 14.5));
        assert_eq!(first(Signal::WheelAngleLeft), (100, 10_000_000, 10.0));
        assert_eq!(thin.get(Signal::AccelX), whole.get(Signal::AccelX));
    }
}
