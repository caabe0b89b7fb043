//! A torque-driven recording on its regular grid of rows.

use std::f64::consts::{PI, TAU};

use recordings::{Recording, Signal};

use crate::settings::preparation::{Runs, SETTINGS};
use crate::visit::Visit;
use inference::DiagnosisError;

const RUNS: Runs = SETTINGS.runs;

/// One recording of a torque-driven robot: what was commanded and what the sensors showed, row by row.
///
/// A missing sample is `None`. Sides: 0 left, 1 right.
#[derive(Debug, Clone)]
pub struct Run {
    /// Name of the recording.
    pub name: String,
    /// Time of the first row, s: zero unless the run is a later stretch of a longer recording. Time counts from its start.
    pub from: f64,
    /// The visit that it is of; without one, that of all references or of all recordings without one.
    pub visit: Option<Visit>,
    /// Time between rows, s.
    pub period: f64,
    /// Torque command of each side, held for the row that follows, N m.
    pub torque: Vec<[f64; 2]>,
    /// Wheel angle of each side, rad.
    pub angle: [Vec<Option<f64>>; 2],
    /// Yaw rate, rad/s.
    pub gyro: Vec<Option<f64>>,
    /// Specific force (x, y), m/s².
    pub accel: [Vec<Option<f64>>; 2],
    /// Pose (x, y, yaw), m and rad.
    pub pose: [Vec<Option<f64>>; 3],
    /// Torque rows that were missing and took the value before them.
    pub held_torques: usize,
}

impl Run {
    /// Lays a recording on its grid.
    ///
    /// Wheel angles are taken as recorded or, where only wheel speeds are, integrated.
    ///
    /// # Errors
    /// When torque or wheel motion is missing, when there are too few rows, or when nothing moves.
    pub fn new(recording: &Recording) -> Result<Self, DiagnosisError> {
        let name = recording.name().to_owned();
        let missing = |what: &'static str| DiagnosisError::MissingSignal { recording: name.clone(), what };
        let get = |s: Signal| recording.get(s);
        let torque = |of: Signal, current: Signal| {
            let recording = name.clone();
            get(of).ok_or_else(|| match get(current) {
                Some(_) => DiagnosisError::CurrentsForTorque { recording },
                None => missing(of.name()),
            })
        };
        let left = torque(Signal::TorqueLeft, Signal::CurrentLeft)?;
        let right = torque(Signal::TorqueRight, Signal::CurrentRight)?;
        let mut gaps: Vec<i64> = left.t_ns().windows(2).map(|w| w[1] - w[0]).collect();
        if gaps.len() + 1 < RUNS.least_rows {
            let (rows, needed) = (gaps.len() + 1, RUNS.least_rows);
            return Err(DiagnosisError::TooShort { recording: name, rows, needed });
        }

        // The grid: the usual gap between torques, from the first to the last of them.
        gaps.sort_unstable();
        let period_ns = gaps[gaps.len() / 2].max(1);
        let (start, end) = (left.t_ns()[0], left.t_ns()[left.len() - 1]);
        let rows = ((end - start + period_ns / 2) / period_ns) as usize + 1;
        if rows > RUNS.most_rows_per_sample * left.len() {
            return Err(DiagnosisError::Gaps { recording: name, rows, samples: left.len() });
        }
        let grid = |signal: Signal| -> Vec<Option<f64>> {
            let mut out = vec![None; rows];
            if let Some(c) = recording.get(signal) {
                for (t, v) in c.samples() {
                    let k = (t - start + period_ns / 2).div_euclid(period_ns);
                    if let Some(slot) = usize::try_from(k).ok().and_then(|k| out.get_mut(k)) {
                        *slot = Some(v);
                    }
                }
            }
            out
        };

        let mut torque = vec![[0.0; 2]; rows];
        let mut held = 0;
        for (j, c) in [left, right].into_iter().enumerate() {
            let (mut last, mut stamps) = (0.0, c.t_ns().iter().copied().peekable());
            let mut seen = start;
            let instants = (0..).map(|k| start + period_ns * k);
            for (at, (row, v)) in instants.zip(torque.iter_mut().zip(grid(c.signal()))) {
                while let Some(stamp) = stamps.next_if(|stamp| *stamp < at + period_ns / 2) {
                    seen = stamp;
                }
                // A stamp that trembles leaves a row to its neighbour, and nothing is missing.
                let is_gap = stamps.peek().is_some_and(|next| (next - seen) as f64 > RUNS.missing * period_ns as f64);
                if v.is_none() && is_gap {
                    held += 1;
                }
                last = v.unwrap_or(last);
                row[j] = last;
            }
        }

        let period = period_ns as f64 * 1e-9;
        let wheel = |angle: Signal, speed: Signal, what: &'static str| {
            if get(angle).is_some() {
                Ok(grid(angle))
            } else if get(speed).is_some() {
                Ok(integrated(&grid(speed), period))
            } else {
                Err(missing(what))
            }
        };
        let angle = [
            wheel(Signal::WheelAngleLeft, Signal::WheelSpeedLeft, "wheel_angle_left or wheel_speed_left")?,
            wheel(Signal::WheelAngleRight, Signal::WheelSpeedRight, "wheel_angle_right or wheel_speed_right")?,
        ];

        if angle.iter().all(|a| Self::present(a).all(|(_, x)| Self::present(a).next().is_some_and(|(_, y)| x == y))) {
            return Err(DiagnosisError::NoMotion { recording: name });
        }

        Ok(Self {
            from: 0.0,
            visit: None,
            period,
            torque,
            angle,
            gyro: grid(Signal::GyroZ),
            accel: [grid(Signal::AccelX), grid(Signal::AccelY)],
            pose: [grid(Signal::PoseX), grid(Signal::PoseY), grid(Signal::PoseYaw)],
            held_torques: held,
            name,
        })
    }

    /// A simulator's log, whose samples are all of their row's instant, as a robot would have recorded it: samples of
    /// other clocks than the encoders' are written in the first row after their instant, on average half a row late.
    pub(crate) fn as_recorded(&self) -> Self {
        let plain = |change: f64| change;
        // A heading may be wrapped.
        let angle = |change: f64| (change + PI).rem_euclid(TAU) - PI;
        let mut run = self.clone();
        run.gyro = half_a_row_before(&self.gyro, plain);
        run.accel = [0, 1].map(|axis| half_a_row_before(&self.accel[axis], plain));
        run.pose = [
            half_a_row_before(&self.pose[0], plain),
            half_a_row_before(&self.pose[1], plain),
            half_a_row_before(&self.pose[2], angle),
        ];
        run
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.torque.len()
    }

    /// Length, s.
    pub fn duration(&self) -> f64 {
        self.rows() as f64 * self.period
    }

    /// Samples that are there, with their row.
    pub(crate) fn present(channel: &[Option<f64>]) -> impl Iterator<Item = (usize, f64)> + '_ {
        channel.iter().enumerate().filter_map(|(k, v)| v.map(|v| (k, v)))
    }
}

/// What a channel showed half a row before each of its samples, by a line to the sample before.
fn half_a_row_before(channel: &[Option<f64>], change: impl Fn(f64) -> f64) -> Vec<Option<f64>> {
    let mut before: Option<(usize, f64)> = None;
    let earlier = |(k, sample): (usize, &Option<f64>)| {
        sample.map(|y| {
            let slope = before.map_or(0.0, |(j, x)| change(y - x) / (k - j) as f64);
            before = Some((k, y));
            y - 0.5 * slope
        })
    };
    channel.iter().enumerate().map(earlier).collect()
}

/// Angles from speeds, rad. A sample stands for all rows since the one before it: speeds may come more seldom than torques, or
/// be missing for a while.
fn integrated(speed: &[Option<f64>], period: f64) -> Vec<Option<f64>> {
    let (mut angle, mut before) = (0.0, None);
    let next = |(k, v): (usize, &Option<f64>)| {
        v.map(|v| {
            let rows = before.map_or(1, |before: usize| k - before);
            before = Some(k);
            angle += v * period * rows as f64;
            angle
        })
    };
    speed.iter().enumerate().map(next).collect()
}

/// Largest torque command of any run, N m.
pub(crate) fn largest_torque(runs: &[Run]) -> f64 {
    runs.iter().flat_map(|r| &r.torque).flatten().fold(0.0_f64, |a, t| a.max(t.abs()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use testing::{recording, samples};

    const ROWS: usize = 300;

    fn channels() -> Vec<(Signal, Vec<(f64, f64)>)> {
        vec![
            (Signal::TorqueLeft, samples(ROWS, |t| t)),
            (Signal::TorqueRight, samples(ROWS, |t| -t)),
            (Signal::WheelAngleLeft, samples(ROWS, |t| 2.0 * t)),
            (Signal::WheelSpeedRight, samples(ROWS, |_| 3.0)),
        ]
    }

    fn error(channels: &[(Signal, Vec<(f64, f64)>)]) -> DiagnosisError {
        Run::new(&recording(channels)).expect_err("refused")
    }

    #[test]
    fn lies_on_its_grid_with_angles_as_recorded_or_integrated() {
        let run = Run::new(&recording(&channels())).expect("a run");
        assert_eq!((run.rows(), run.period, run.held_torques), (ROWS, 0.01, 0));
        approx::assert_relative_eq!(run.torque[100][1], -1.0);
        approx::assert_relative_eq!(run.angle[0][100].expect("there"), 2.0);
        let turned = run.angle[1][200].expect("there") - run.angle[1][100].expect("there");
        approx::assert_relative_eq!(turned, 3.0, epsilon = 1e-9);
        assert!(run.gyro.iter().all(Option::is_none));
    }

    #[test]
    fn speeds_that_come_more_seldom_than_torques_turn_the_wheel_as_far() {
        let mut c = channels();
        // Every other speed, and half a second of none.
        let seldom = |(k, sample): (usize, (f64, f64))| (k % 2 == 0 && !(120..170).contains(&k)).then_some(sample);
        c[3].1 = c[3].1.drain(..).enumerate().filter_map(seldom).collect();
        let run = Run::new(&recording(&c)).expect("a run");
        let turned = |from: usize, until: usize| run.angle[1][until].zip(run.angle[1][from]).map(|(b, a)| b - a);
        approx::assert_relative_eq!(turned(20, 100).expect("there"), 3.0 * 0.8, epsilon = 1e-9);
        approx::assert_relative_eq!(turned(100, 200).expect("there"), 3.0, epsilon = 1e-9);
        assert_eq!((run.angle[1][101], run.angle[1][150]), (None, None));
    }

    #[test]
    fn a_gap_stays_a_gap_and_a_missing_torque_holds_the_one_before() {
        let mut c = channels();
        c[0].1.drain(100..105);
        c[2].1.drain(50..60);
        let run = Run::new(&recording(&c)).expect("a run");
        assert_eq!((run.rows(), run.held_torques), (ROWS, 5));
        assert_eq!(run.torque[104][0], run.torque[99][0]);
        assert!(run.angle[0][50..60].iter().all(Option::is_none));
        assert!(run.angle[0][60].is_some());
    }

    #[test]
    fn stamps_that_tremble_miss_nothing() {
        let mut c = channels();
        for (k, sample) in c.iter_mut().flat_map(|(_, samples)| samples.iter_mut().enumerate()) {
            sample.0 += 0.004 * [0.0, 1.0, 1.6, 0.3, -0.9][k % 5];
        }
        assert_eq!(Run::new(&recording(&c)).expect("a run").held_torques, 0);
    }

    #[test]
    fn missing_signals_are_named() {
        for (i, name) in [(0, "torque_left"), (1, "torque_right"), (2, "wheel_angle_left"), (3, "wheel_speed_right")] {
            let mut c = channels();
            c.remove(i);
            let e = error(&c);
            assert!(matches!(e, DiagnosisError::MissingSignal { .. }));
            assert!(e.to_string().contains(name), "{e}");
        }
        // Currents are no torques, but may be mapped as such.
        let mut c = channels();
        (c[0].0, c[1].0) = (Signal::CurrentLeft, Signal::CurrentRight);
        let e = error(&c);
        assert!(matches!(e, DiagnosisError::CurrentsForTorque { .. }), "{e}");
        assert!(e.to_string().contains("torque_left = { column = \"...\", unit = \"N m\", scale = ... }"), "{e}");
    }

    #[test]
    fn too_short_without_motion_or_mostly_holes_is_refused() {
        let short: Vec<_> = channels().into_iter().map(|(s, c)| (s, c[..150].to_vec())).collect();
        assert!(matches!(error(&short), DiagnosisError::TooShort { rows: 150, needed: 201, .. }));
        let mut still = channels();
        still[2].1 = samples(ROWS, |_| 0.7);
        still[3].1 = samples(ROWS, |_| 0.0);
        assert!(matches!(error(&still), DiagnosisError::NoMotion { .. }));
        still[2].1.remove(0);
        assert!(matches!(error(&still), DiagnosisError::NoMotion { .. }), "the first angle is missing");
        let mut holes = channels();
        holes[0].1.push((1e5, 0.0));
        assert!(matches!(error(&holes), DiagnosisError::Gaps { samples: 301, .. }));
    }
}
