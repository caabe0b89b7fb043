//! Sensor faults that act on samples over time, not on a reading: frozen and jumping encoders, clocks that disagree.

use recordings::{Channel, Recording, RecordingError, Signal};
use robot_model::effect::export::Way;
use verdict::EffectAt;

/// Length of a burst in which an encoder stands still, s: a guess. The catalogue says which share of the rows is frozen, not
/// in how long bursts.
const BURST: f64 = 0.1;

const ANGLES: [Signal; 2] = [Signal::WheelAngleLeft, Signal::WheelAngleRight];
const IMU: [Signal; 3] = [Signal::GyroZ, Signal::AccelX, Signal::AccelY];
const POSE: [Signal; 3] = [Signal::PoseX, Signal::PoseY, Signal::PoseYaw];

/// Whether an effect is one of these faults: no plant knows them.
pub(crate) fn is_one(effect: &EffectAt) -> bool {
    let spec = catalogue::find(&effect.effect).and_then(|entry| entry.effect);
    spec.is_some_and(|spec| spec.export.robot_file == Way::ON_SAMPLES)
}

/// What sensors with these faults show of a drive; other effects are the plant's.
pub(crate) fn shown(effects: &[EffectAt], ideal: Recording) -> Result<Recording, RecordingError> {
    if !effects.iter().any(is_one) {
        return Ok(ideal);
    }
    let drive = ideal.name().to_owned();
    let channels = ideal.channels().iter().map(|channel| {
        let mut values = channel.values().to_vec();
        let seconds = seconds(channel.t_ns());
        for effect in effects {
            apply(effect, &drive, channel.signal(), &seconds, &mut values);
        }
        Channel::new(channel.signal(), channel.clock(), channel.t_ns().to_vec(), values)
    });
    let channels = channels.collect::<Result<Vec<_>, _>>()?;
    Recording::new(drive, ideal.clocks().to_vec(), channels)
}

/// Applies a fault to what a signal shows.
fn apply(effect: &EffectAt, drive: &str, signal: Signal, seconds: &[f64], values: &mut Vec<f64>) {
    let value = |name: &str| effect.values.get(name).copied().unwrap_or(0.0);
    let is_on_this_side = effect.side.is_none_or(|side| ANGLES[side as usize] == signal);
    let is_angle = ANGLES.contains(&signal) && is_on_this_side;
    // Of each clock its error, where it stamps this signal.
    let of_clock = || match (IMU.contains(&signal), POSE.contains(&signal)) {
        (true, _) => value("IMU"),
        (_, true) => value("pose"),
        _ => 0.0,
    };
    match effect.effect.as_str() {
        "encoder_dropout" if is_angle => freeze(values, seconds, value("share of rows")),
        "encoder_slipped_index" if is_angle && !effect.absent.iter().any(|name| name == drive) => {
            let end = seconds.last().copied().unwrap_or(0.0);
            let from = effect.from.get(drive).copied().unwrap_or(0.5 * end);
            let slipped = values.iter_mut().zip(seconds).filter(|(_, t)| **t >= from);
            slipped.for_each(|(angle, _)| *angle += value("jump"));
        }
        "clock_offset" if of_clock() != 0.0 => *values = seen(values, seconds, |t| t - of_clock()),
        "clock_drift" if of_clock() != 0.0 => *values = seen(values, seconds, |t| t - of_clock() * t),
        _ => {}
    }
}

/// Instants after the first, s.
fn seconds(t_ns: &[i64]) -> Vec<f64> {
    t_ns.iter().map(|t| (t - t_ns[0]) as f64 * 1e-9).collect()
}

/// Holds values in bursts at equal distances that together take this share of the rows.
fn freeze(values: &mut [f64], seconds: &[f64], share: f64) {
    let rows = values.len();
    let Some(end) = seconds.last().filter(|end| **end > 0.0 && share > 0.0) else { return };
    let burst = (BURST * (rows - 1) as f64 / end).round().max(1.0);
    let apart = burst / share.min(1.0);
    for k in 1..rows {
        if (k as f64) % apart >= apart - burst {
            values[k] = values[k - 1];
        }
    }
}

/// What a signal was at `taken(t)`, at each instant; between samples on the line through them, beyond the ends as there.
fn seen(values: &[f64], seconds: &[f64], taken: impl Fn(f64) -> f64) -> Vec<f64> {
    let at = |t: f64| {
        let after = seconds.partition_point(|s| *s <= t);
        if after == 0 {
            return values[0];
        }
        let before = after - 1;
        let Some(end) = seconds.get(after) else { return values[before] };
        let share = (t - seconds[before]) / (end - seconds[before]);
        values[before] + share * (values[after] - values[before])
    };
    seconds.iter().map(|t| at(taken(*t))).collect()
}

#[cfg(test)]
mod tests {
    use recordings::Clock;
    use verdict::Side;

    use super::*;

    /// 10 s of a ramp of one unit per second in every signal.
    fn ramp() -> Recording {
        let t_ns: Vec<i64> = (0..1001).map(|k| k * 10_000_000).collect();
        let values: Vec<f64> = t_ns.iter().map(|t| *t as f64 * 1e-9).collect();
        let of = |signal| Channel::new(signal, 0, t_ns.clone(), values.clone()).expect("a channel");
        let signals = [ANGLES.as_slice(), &IMU, &POSE].concat();
        let clock = Clock { name: "simulation".to_owned(), nominal_rate_hz: None };
        Recording::new("d", vec![clock], signals.into_iter().map(of).collect()).expect("a drive")
    }

    fn with(effect: &str, value: (&str, f64), side: Option<Side>) -> Recording {
        let values = [(value.0.to_owned(), value.1)].into();
        let effect = EffectAt { effect: effect.to_owned(), values, side, ..EffectAt::default() };
        shown(&[effect], ramp()).expect("a drive")
    }

    /// What a signal shows less what it is, at each row.
    fn error(recording: &Recording, signal: Signal) -> Vec<f64> {
        let (shown, ideal) = (recording.get(signal).expect("there"), ramp());
        let ideal = ideal.get(signal).expect("there");
        shown.values().iter().zip(ideal.values()).map(|(a, b)| a - b).collect()
    }

    fn is_untouched(recording: &Recording, signals: &[Signal]) -> bool {
        signals.iter().all(|signal| error(recording, *signal).iter().all(|e| *e == 0.0))
    }

    #[test]
    fn a_late_clock_shows_what_was_and_the_others_stay() {
        let late = with("clock_offset", ("IMU", 0.033), None);
        let gyro = error(&late, Signal::GyroZ);
        assert!(gyro[10..].iter().all(|e| (e + 0.033).abs() < 1e-9), "{gyro:?}");
        assert!(is_untouched(&late, &POSE) && is_untouched(&late, &ANGLES));
        let early = with("clock_offset", ("pose", -0.02), None);
        assert!((error(&early, Signal::PoseYaw)[500] - 0.02).abs() < 1e-9);
    }

    #[test]
    fn a_clock_that_drifts_is_the_later_the_longer_it_runs() {
        let drift = error(&with("clock_drift", ("pose", 0.01), None), Signal::PoseX);
        assert!(drift[0] == 0.0 && (drift[500] + 0.05).abs() < 1e-9 && (drift[1000] + 0.1).abs() < 1e-9);
    }

    #[test]
    fn an_encoder_freezes_for_its_share_of_rows_and_is_right_again() {
        let frozen = with("encoder_dropout", ("share of rows", 0.1), Some(Side::Left));
        let left = error(&frozen, ANGLES[0]);
        let share = left.iter().filter(|e| **e < 0.0).count() as f64 / left.len() as f64;
        assert!((share - 0.1).abs() < 0.01, "{share}");
        assert!(left.iter().all(|e| *e > -1.01 * BURST), "bursts are short");
        assert!(is_untouched(&frozen, &ANGLES[1..]));
    }

    #[test]
    fn an_index_slips_once_and_stays() {
        let slipped = error(&with("encoder_slipped_index", ("jump", -0.3), Some(Side::Right)), ANGLES[1]);
        assert!(slipped[..500].iter().all(|e| *e == 0.0));
        assert!(slipped[500..].iter().all(|e| (e + 0.3).abs() < 1e-12));
    }
}
