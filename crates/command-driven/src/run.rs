//! A recording of command, wheel speed and body motion on one uniform grid.

use recordings::{Channel, Recording, Signal};

use inference::gyro_beside_pose::{GyroShare, gyro_share};
use inference::{DiagnosisError, interpolate};

use crate::controller::{H, SUBSTEPS};
use crate::settings::SETTINGS;

/// Grid on which commands, wheels and pose are compared, s.
pub const STEP: f64 = SETTINGS.recording.step;
/// Rows of a window.
pub(crate) const WINDOW: usize = SETTINGS.windows.rows;
/// A sample this much later than a row still counts as of that row, s.
const STAMP: f64 = SETTINGS.recording.stamp;
const NS: f64 = 1e-9;

/// One recording of a command-driven robot. Sides: 0 left, 1 right.
#[derive(Debug, Clone)]
pub struct ResponseRun {
    /// Name of the recording.
    pub name: String,
    /// Stretches without a gap.
    pub(crate) pieces: Vec<Piece>,
    /// What share of the turning that a pose shows a gyro shows; `None` without both.
    pub gyro_share: Option<GyroShare>,
    /// For how long wheel speeds repeat one value while they change, s: they are sample-held.
    pub hold: f64,
}

/// A stretch without a gap, every [`STEP`].
#[derive(Debug, Clone)]
pub(crate) struct Piece {
    /// When it begins, s after the recording's first row.
    pub(crate) start: f64,
    /// Commanded wheel speed, rad/s.
    pub(crate) command: Vec<[f64; 2]>,
    /// Mean command of each integration step, rad/s, where commands change between rows.
    pub(crate) within: Option<Vec<[f64; 2]>>,
    /// Measured wheel speed, rad/s.
    pub(crate) wheel: Vec<[f64; 2]>,
    /// Heading, unwrapped, rad.
    pub(crate) heading: Option<Vec<f64>>,
    /// The heading is the sum of a gyro's yaw rates: its noise adds up.
    pub(crate) integrated: bool,
    /// Position, m; only beside a heading of the same sensor.
    pub(crate) position: Option<Vec<[f64; 2]>>,
}

impl ResponseRun {
    /// Takes command, wheel speed, and pose or gyro from a recording.
    ///
    /// # Errors
    /// When a signal is missing, no window of 2 s is whole, or nothing moves.
    pub fn new(recording: &Recording) -> Result<Self, DiagnosisError> {
        let name = recording.name().to_owned();
        let need = |signal, what| {
            let channel = recording.get(signal).filter(|c| !c.is_empty());
            channel.ok_or(DiagnosisError::MissingSignal { recording: name.clone(), what })
        };
        let command = [
            need(Signal::CommandSpeedLeft, "command_speed of both sides")?,
            need(Signal::CommandSpeedRight, "command_speed of both sides")?,
        ];
        let wheel = [
            need(Signal::WheelSpeedLeft, "wheel_speed of both sides")?,
            need(Signal::WheelSpeedRight, "wheel_speed of both sides")?,
        ];

        // Turning and position are of one sensor; a gyro gives the turning alone.
        let yaw = recording.get(Signal::PoseYaw);
        let gyro = recording.get(Signal::GyroZ);
        let turning = yaw
            .or(gyro)
            .ok_or(DiagnosisError::MissingSignal { recording: name.clone(), what: "pose_yaw or gyro_z" })?;
        let place = match (yaw, recording.get(Signal::PoseX), recording.get(Signal::PoseY)) {
            (Some(_), Some(x), Some(y)) => Some([x, y]),
            _ => None,
        };

        // Pieces are what all of them cover without a gap.
        let mut used: Vec<&Channel> = command.into_iter().chain(wheel).chain([turning]).collect();
        used.extend(place.into_iter().flatten());
        let headings = if yaw.is_some() { turning.unwrapped() } else { integral(turning) };
        let mut pieces = Vec::new();
        let stretches = stretches(&used);
        let first = stretches.first().map_or(0.0, |s| s[0]);
        for [from, until] in stretches {
            let rows = ((until - from + STAMP) / STEP).floor() as usize + 1;
            let time = |i: usize| from + i as f64 * STEP;
            let pair = |c: [&Channel; 2], at: fn(&Channel, &[f64], f64) -> f64| -> Vec<[f64; 2]> {
                (0..rows).map(|i| c.map(|c| at(c, c.values(), time(i)))).collect()
            };
            let piece = Piece {
                start: from - first,
                command: pair(command, held),
                within: between_rows(command, from, rows),
                wheel: pair(wheel, linear),
                heading: Some((0..rows).map(|i| linear(turning, &headings, time(i))).collect()),
                integrated: yaw.is_none(),
                position: place.map(|p| pair(p, linear)),
            };
            if rows >= WINDOW {
                pieces.push(piece);
            }
        }

        let rows: usize = wheel[0].len();
        if pieces.is_empty() {
            return Err(DiagnosisError::TooShort { recording: name, rows, needed: WINDOW });
        }
        if pieces.iter().all(|p| p.wheel.iter().flatten().all(|w| w.abs() < 1e-9)) {
            return Err(DiagnosisError::NoMotion { recording: name });
        }
        let gyro_share = yaw.zip(gyro).and_then(|(yaw, gyro)| {
            let times = |c: &Channel| seconds(c).collect::<Vec<_>>();
            let (instants, [left, right]) = (times(wheel[0]), wheel.map(|side| (times(side), side.values())));
            let at = |side: &(Vec<f64>, &[f64]), t: f64| interpolate(&side.0, side.1, t);
            let difference: Vec<f64> = instants.iter().map(|t| at(&right, *t) - at(&left, *t)).collect();
            gyro_share((&times(gyro), gyro.values()), (&times(yaw), &headings), (&instants, &difference))
        });
        Ok(Self { name, pieces, gyro_share, hold: hold(wheel[0]).max(hold(wheel[1])) })
    }

    /// Whole windows of 2 s.
    pub fn windows(&self) -> usize {
        self.pieces.iter().map(Piece::windows).sum()
    }

    /// Whether positions were recorded.
    pub fn has_position(&self) -> bool {
        self.pieces.iter().any(|p| p.position.is_some())
    }
}

/// Commanded wheel speeds from the first command on.
pub(crate) fn commands(recording: &Recording) -> Result<Commands, DiagnosisError> {
    let both = recording.get(Signal::CommandSpeedLeft).zip(recording.get(Signal::CommandSpeedRight));
    let missing = || DiagnosisError::MissingSignal {
        recording: recording.name().to_owned(),
        what: "command_speed of both sides",
    };
    let (l, r) = both.filter(|(l, r)| !l.is_empty() && !r.is_empty()).ok_or_else(missing)?;
    let first = l.t_ns()[0].max(r.t_ns()[0]);
    let last = seconds(l).last().zip(seconds(r).last()).map_or(0.0, |(a, b)| a.max(b));
    let from = first as f64 * NS;
    let rows = ((last - from + STAMP) / STEP).floor().max(0.0) as usize + 1;
    let at = |c: &Channel, i: usize| held(c, c.values(), from + i as f64 * STEP);
    let command = (0..rows).map(|i| [at(l, i), at(r, i)]).collect();
    Ok(Commands { first, command, within: between_rows([l, r], from, rows) })
}

/// What is commanded, without what was measured.
pub(crate) struct Commands {
    /// Time of the first command, ns.
    pub(crate) first: i64,
    /// Commanded wheel speeds every [`STEP`], rad/s.
    pub(crate) command: Vec<[f64; 2]>,
    /// As in a [`Piece`].
    pub(crate) within: Option<Vec<[f64; 2]>>,
}

impl Piece {
    pub(crate) fn windows(&self) -> usize {
        self.wheel.len() / WINDOW
    }
}

fn seconds(c: &Channel) -> impl Iterator<Item = f64> + '_ {
    c.t_ns().iter().map(|t| *t as f64 * NS)
}

/// Where all channels speak: cut at every gap of one of them.
fn stretches(channels: &[&Channel]) -> Vec<[f64; 2]> {
    let first = channels.iter().filter_map(|c| seconds(c).next()).fold(f64::MIN, f64::max);
    let last = channels.iter().filter_map(|c| seconds(c).last()).fold(f64::MAX, f64::min);
    let mut gaps: Vec<[f64; 2]> = channels
        .iter()
        .flat_map(|c| c.t_ns().windows(2).map(|w| [w[0] as f64 * NS, w[1] as f64 * NS]))
        .filter(|[a, b]| b - a > SETTINGS.recording.gap)
        .collect();
    gaps.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut out = Vec::new();
    let mut from = first;
    for [a, b] in gaps {
        if a >= from && a <= last {
            out.push([from, a]);
        }
        from = from.max(b);
    }
    if from <= last {
        out.push([from, last]);
    }
    out
}

/// Index of the last sample at or before `t`.
fn before(c: &Channel, t: f64) -> usize {
    c.t_ns().partition_point(|s| *s as f64 * NS <= t + STAMP).saturating_sub(1)
}

/// A command holds until the next one.
fn held(c: &Channel, values: &[f64], t: f64) -> f64 {
    values[before(c, t)]
}

/// Mean of a command over the time from `t` to `t + length`.
fn mean_held(c: &Channel, t: f64, length: f64) -> f64 {
    let values = c.values();
    let mut k = before(c, t);
    let (mut from, mut sum) = (t, 0.0);
    while k + 1 < values.len() {
        // A stamp beside a row counts as of that row, as in `before`.
        let next = c.t_ns()[k + 1] as f64 * NS;
        if next >= t + length - STAMP {
            break;
        }
        sum += values[k] * (next - from).max(0.0);
        from = next.max(t);
        k += 1;
    }
    // Where nothing changes it is the command itself, without rounding.
    if from > t { (sum + values[k] * (t + length - from)) / length } else { values[k] }
}

/// Mean commands of each integration step; `None` where every command comes with a row.
fn between_rows(command: [&Channel; 2], from: f64, rows: usize) -> Option<Vec<[f64; 2]>> {
    let at = |k: usize| from + k as f64 * H;
    let means: Vec<[f64; 2]> = (0..rows * SUBSTEPS).map(|k| command.map(|c| mean_held(c, at(k), H))).collect();
    let differs = |(k, m): (usize, &[f64; 2])| {
        let row = command.map(|c| held(c, c.values(), at(k - k % SUBSTEPS)));
        (0..2).any(|s| m[s] != row[s])
    };
    means.iter().enumerate().any(differs).then_some(means)
}

fn linear(c: &Channel, values: &[f64], t: f64) -> f64 {
    let i = before(c, t);
    if i + 1 >= values.len() {
        return values[i];
    }
    let [a, b] = [c.t_ns()[i], c.t_ns()[i + 1]].map(|s| s as f64 * NS);
    let share = ((t - a) / (b - a)).clamp(0.0, 1.0);
    // A row on a sample takes the sample itself.
    if t - a < STAMP { values[i] } else { values[i] + share * (values[i + 1] - values[i]) }
}

/// Heading from the yaw rate, by the trapezoidal rule.
fn integral(gyro: &Channel) -> Vec<f64> {
    let time: Vec<f64> = seconds(gyro).collect();
    let mut sum = 0.0;
    let mut out = vec![0.0; time.len()];
    for i in 1..time.len() {
        sum += 0.5 * (gyro.values()[i] + gyro.values()[i - 1]) * (time[i] - time[i - 1]);
        out[i] = sum;
    }
    out
}

/// Median time for which a wheel speed repeats its last value, s; longer runs are standstill, not a hold.
fn hold(wheel: &Channel) -> f64 {
    let time: Vec<f64> = seconds(wheel).collect();
    let mut runs = Vec::new();
    let mut start = 0;
    for i in 1..time.len() {
        if wheel.values()[i] != wheel.values()[i - 1] {
            runs.push(time[i - 1] - time[start]);
            start = i;
        }
    }
    runs.retain(|r| *r < SETTINGS.recording.standstill);
    runs.sort_by(f64::total_cmp);
    runs.get(runs.len() / 2).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use recordings::Clock;

    use super::*;

    fn channel(signal: Signal, t: &[f64], v: &[f64]) -> Channel {
        Channel::new(signal, 0, t.iter().map(|t| (t * 1e9).round() as i64).collect(), v.to_vec()).expect("a channel")
    }

    fn recording(t: &[f64], leave_out: Option<Signal>) -> Recording {
        let speed: Vec<f64> = (0..t.len()).map(|i| (i / 2) as f64).collect();
        let signals = [
            Signal::CommandSpeedLeft,
            Signal::CommandSpeedRight,
            Signal::WheelSpeedLeft,
            Signal::WheelSpeedRight,
            Signal::GyroZ,
        ];
        let channels = signals.into_iter().filter(|s| Some(*s) != leave_out).map(|s| channel(s, t, &speed)).collect();
        Recording::new("run", vec![Clock { name: "one".to_owned(), nominal_rate_hz: None }], channels).expect("built")
    }

    #[test]
    fn cuts_at_gaps_and_takes_samples_as_they_are() {
        // 100 rows, a hole of two seconds, 60 rows.
        let t: Vec<f64> = (0..160).map(|i| f64::from(i) * 0.05 + if i < 100 { 0.0 } else { 2.0 }).collect();
        let run = ResponseRun::new(&recording(&t, None)).expect("a run");
        let rows: Vec<usize> = run.pieces.iter().map(|p| p.wheel.len()).collect();
        assert_eq!(rows, [100, 60]);
        assert_eq!(run.windows(), 3);
        assert_eq!(run.pieces[0].wheel[7], [3.0, 3.0]);
        assert_eq!(run.pieces[1].command[0], [50.0, 50.0]);
        approx::assert_abs_diff_eq!(run.hold, 0.05, epsilon = 1e-9);
        assert!(!run.has_position());
    }

    #[test]
    fn what_is_missing_is_named() {
        let t: Vec<f64> = (0..100).map(|i| f64::from(i) * 0.05).collect();
        for (signal, part) in [
            (Signal::CommandSpeedLeft, "command_speed"),
            (Signal::WheelSpeedRight, "wheel_speed"),
            (Signal::GyroZ, "gyro_z"),
        ] {
            let error = ResponseRun::new(&recording(&t, Some(signal))).expect_err("refused").to_string();
            assert!(error.contains(part), "{error}");
        }
        let error = ResponseRun::new(&recording(&t[..30], None)).expect_err("refused");
        assert!(matches!(error, DiagnosisError::TooShort { rows: 30, needed: WINDOW, .. }));
    }

    #[test]
    fn commands_between_rows_act_when_they_come() {
        // Rows every 50 ms, commands from 0.110 s on every 50 ms: 10 ms behind a row.
        let t: Vec<f64> = (0..100).map(|i| f64::from(i) * 0.05).collect();
        let late: Vec<f64> = t.iter().map(|t| t + 0.01).collect();
        let channel_at = |t: &[f64]| channel(Signal::CommandSpeedLeft, t, &(0..100).map(f64::from).collect::<Vec<_>>());
        let (on_rows, between) = (channel_at(&t), channel_at(&late));
        assert_eq!(between_rows([&on_rows, &on_rows], 0.0, 90), None);
        let means = between_rows([&between, &between], 0.05, 90).expect("between rows");
        // From 50 to 60 ms the first command still holds, from 60 to 75 ms and beyond the second.
        approx::assert_relative_eq!(means[0][0], 1.0 * 0.6, epsilon = 1e-9);
        approx::assert_relative_eq!(means[1][0], 1.0, epsilon = 1e-9);
    }
}
