//! A torque-driven recording on its regular grid of rows.

use recordings::{Recording, Signal};

use crate::DiagnosisError;

/// One recording of a torque-driven robot: what was commanded and what the sensors showed, row by row.
///
/// A missing sample is `None`. Sides: 0 left, 1 right.
#[derive(Debug, Clone)]
pub struct Run {
    /// Name of the recording.
    pub name: String,
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
        let left = get(Signal::TorqueLeft).ok_or_else(|| missing("torque_left"))?;
        let right = get(Signal::TorqueRight).ok_or_else(|| missing("torque_right"))?;
        let mut gaps: Vec<i64> = left.t_ns().windows(2).map(|w| w[1] - w[0]).collect();
        if gaps.len() < 200 {
            return Err(DiagnosisError::TooShort { recording: name, rows: gaps.len() + 1, needed: 201 });
        }
        gaps.sort_unstable();
        let period_ns = gaps[gaps.len() / 2].max(1);
        let (start, end) = (left.t_ns()[0], left.t_ns()[left.len() - 1]);
        let rows = ((end - start + period_ns / 2) / period_ns) as usize + 1;
        if rows > 100 * left.len() {
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
            let mut last = 0.0;
            for (row, v) in torque.iter_mut().zip(grid(c.signal())) {
                if v.is_none() {
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
                let mut sum = 0.0;
                Ok(grid(speed)
                    .into_iter()
                    .map(|v| {
                        v.map(|w| {
                            sum += w * period;
                            sum
                        })
                    })
                    .collect())
            } else {
                Err(missing(what))
            }
        };
        let angle = [
            wheel(Signal::WheelAngleLeft, Signal::WheelSpeedLeft, "wheel_angle_left or wheel_speed_left")?,
            wheel(Signal::WheelAngleRight, Signal::WheelSpeedRight, "wheel_angle_right or wheel_speed_right")?,
        ];
        if angle.iter().all(|a| a.iter().flatten().all(|&x| Some(x) == a[0])) {
            return Err(DiagnosisError::NoMotion { recording: name });
        }
        Ok(Self {
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
