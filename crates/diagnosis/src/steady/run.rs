//! A speed-driven recording: what the drive imposed and what it took.

use recordings::{Channel, Recording, Signal};

use crate::DiagnosisError;
use crate::steady::clock;

/// One recording of a speed-driven robot. Sides: 0 left, 1 right.
#[derive(Debug, Clone)]
pub struct SpeedRun {
    /// Name of the recording.
    pub name: String,
    /// Time of each row, s.
    pub time: Vec<f64>,
    /// Speed at the tyre of each side, m/s (set-points, if nothing else was recorded).
    pub speed: [Vec<f64>; 2],
    /// Torque at the wheels of each side, N m; a magnitude if the current has no sign.
    pub torque: [Vec<f64>; 2],
    /// A torque up to this one is in the dead band: only a bound is known, N m.
    pub dead_band: f64,
    /// Speeds are set-points, not measured.
    pub set_points: bool,
    /// Torques carry no sign.
    pub magnitude_only: bool,
    /// Yaw rate at the rows after its clock was aligned, rad/s; `None` without a gyro.
    pub yaw_rate: Option<Vec<f64>>,
    /// Lag of the gyro's clock at the rows, s.
    pub lag: Option<Vec<f64>>,
}

/// Shortest recording that can hold three seconds of steady driving, rows.
const LEAST_ROWS: usize = 20;
/// Yaw rate is averaged over this long, s: wheel vibration is no turning.
const GYRO_MEAN: f64 = 0.31;

impl SpeedRun {
    /// Takes set (or measured) wheel speeds and currents (or torques) from a recording.
    ///
    /// `radius` in m turns wheel speed into tyre speed, `torque_per_current` in N m/A current into torque.
    ///
    /// # Errors
    /// When speeds or currents are missing, the recording is too short, or nothing moves.
    pub fn new(recording: &Recording, radius: f64, torque_per_current: f64) -> Result<Self, DiagnosisError> {
        let name = recording.name().to_owned();
        let pair = |options: [[Signal; 2]; 2], what: &'static str| {
            options
                .iter()
                .enumerate()
                .find_map(|(i, [l, r])| Some((i, recording.get(*l)?, recording.get(*r)?)))
                .ok_or(DiagnosisError::MissingSignal { recording: name.clone(), what })
        };
        let speeds =
            [[Signal::WheelSpeedLeft, Signal::WheelSpeedRight], [Signal::CommandSpeedLeft, Signal::CommandSpeedRight]];
        let loads = [[Signal::TorqueLeft, Signal::TorqueRight], [Signal::CurrentLeft, Signal::CurrentRight]];
        let (kind, left, right) = pair(speeds, "wheel_speed or command_speed of both sides")?;
        let (load, load_left, load_right) = pair(loads, "current or torque of both sides")?;
        let factor = if load == 1 { torque_per_current } else { 1.0 };
        let common: Vec<i64> = left
            .t_ns()
            .iter()
            .copied()
            .filter(|t| has(right, *t) && has(load_left, *t) && has(load_right, *t))
            .collect();
        if common.len() < LEAST_ROWS {
            return Err(DiagnosisError::TooShort { recording: name, rows: common.len(), needed: LEAST_ROWS });
        }
        let take = |c: &Channel, f: f64| common.iter().map(|t| at(c, *t) * f).collect::<Vec<f64>>();
        let speed = [take(left, radius), take(right, radius)];
        if speed.iter().flatten().all(|v| v.abs() < 1e-9) {
            return Err(DiagnosisError::NoMotion { recording: name });
        }
        let time: Vec<f64> = common.iter().map(|t| *t as f64 * 1e-9).collect();
        let attributes = load_left.attributes();
        let mut run = Self {
            torque: [take(load_left, factor), take(load_right, factor)],
            dead_band: attributes.dead_band.map_or(0.0, |d| (d + DEAD_BAND_SLACK) * factor),
            set_points: kind == 1 || left.attributes().set_point,
            magnitude_only: attributes.magnitude_only,
            yaw_rate: None,
            lag: None,
            name,
            time,
            speed,
        };
        if let Some(gyro) = recording.get(Signal::GyroZ) {
            let t: Vec<f64> = gyro.t_ns().iter().map(|t| *t as f64 * 1e-9).collect();
            let smooth = clock::box_mean(&t, gyro.values(), GYRO_MEAN);
            let turning: Vec<f64> = run.speed[1].iter().zip(&run.speed[0]).map(|(r, l)| r - l).collect();
            let lag = if gyro.clock() == left.clock() {
                vec![0.0; run.time.len()]
            } else {
                clock::align(&run.time, &turning, &t, &smooth)
            };
            run.yaw_rate =
                Some(run.time.iter().zip(&lag).map(|(a, b)| clock::interpolate(&t, &smooth, a + b)).collect());
            run.lag = Some(lag);
        }
        Ok(run)
    }

    /// Rows whose both sides read above the dead band.
    pub(crate) fn reads(&self, i: usize, side: usize) -> bool {
        self.torque[side][i].abs() > self.dead_band
    }

    /// Difference of the speeds, right less left, m/s.
    pub(crate) fn difference(&self, i: usize) -> f64 {
        self.speed[1][i] - self.speed[0][i]
    }

    /// For how long before row `i` both speeds have been within `tolerance` of its own, s.
    pub(crate) fn age(&self, i: usize, tolerance: f64) -> f64 {
        let near = |k: usize| (0..2).all(|j| (self.speed[j][k] - self.speed[j][i]).abs() <= tolerance);
        let first = (0..i).rev().take_while(|&k| near(k)).last().unwrap_or(i);
        self.time[i] - self.time[first]
    }

    /// Whether both speeds stay within `tolerance` for `seconds` after row `i`.
    pub(crate) fn holds(&self, i: usize, tolerance: f64, seconds: f64) -> bool {
        let mut k = i;
        while k + 1 < self.time.len() && self.time[k] - self.time[i] < seconds {
            k += 1;
            if (0..2).any(|j| (self.speed[j][k] - self.speed[j][i]).abs() > tolerance) {
                return false;
            }
        }
        self.time[k] - self.time[i] >= seconds - 1e-9
    }
}

/// Readings up to a dead band are given to two decimals: half of the last digit more counts as in it, A.
const DEAD_BAND_SLACK: f64 = 0.01;

fn has(c: &Channel, t: i64) -> bool {
    c.t_ns().binary_search(&t).is_ok()
}

fn at(c: &Channel, t: i64) -> f64 {
    c.t_ns().binary_search(&t).map_or(0.0, |i| c.values()[i])
}
