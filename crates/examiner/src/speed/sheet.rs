//! What sensors write of a drive.

use std::fmt::Write as _;

use super::Sight;
use super::drive::{Robot, Row, STEP};
use crate::random::Stream;

/// Rows of currents per second.
const RATE: f64 = 6.5;
/// Least current that is shown, and its step, A.
const DEAD_BAND: f64 = 0.59;
const CURRENT_STEP: f64 = 0.13;
/// Step of set speeds, m/s.
const SPEED_STEP: f64 = 1.0 / 127.0;

/// Sensors of one robot: the same in all its drives.
pub(super) struct Sensors {
    /// Factor and offset, A, of the current of each side.
    factor: [f64; 2],
    offset: [f64; 2],
    /// Offsets of the gyro, rad/s.
    bias: [f64; 3],
    /// The accelerometer's nose, rad.
    mounted: f64,
    /// Vibration, m/s² rms at full speed.
    vibration: f64,
}

impl Sensors {
    pub(super) fn draw(s: &mut Stream) -> Self {
        Self {
            factor: [0, 1].map(|_| 1.0 + s.normal(0.04)),
            offset: [0, 1].map(|_| s.uniform(0.0, 0.25)),
            bias: [0, 1, 2].map(|_| s.normal(0.002)),
            mounted: s.normal(0.015),
            vibration: s.uniform(0.8, 3.0),
        }
    }

    /// Speeds and currents: `pro_*.csv`.
    pub(super) fn drives(&self, robot: &Robot, rows: &[Row], s: &mut Stream) -> String {
        let mut out = String::from("time,curL,curR,velL,velR\n");
        let count = (rows.len() as f64 * STEP * RATE) as usize;
        for k in 0..count {
            // The mean since the reading before.
            let until = (((k + 1) as f64 / RATE / STEP) as usize).min(rows.len());
            let from = ((k as f64 / RATE / STEP) as usize).min(until.saturating_sub(1));
            let span = &rows[from..until];
            let n = span.len().max(1) as f64;
            let current: [f64; 2] = std::array::from_fn(|j| {
                let torque = span.iter().map(|r| r.torque[j]).sum::<f64>() / n;
                let set = span[0].set[j];
                // A side that brakes feeds back and shows next to nothing.
                let drives = if set == 0.0 || torque * set < 0.0 { 0.1 * torque.abs() } else { torque.abs() };
                let shown = self.factor[j] * drives / robot.per_current + self.offset[j] + s.normal(0.15);
                let shown = (shown / CURRENT_STEP).round() * CURRENT_STEP;
                if shown < DEAD_BAND { 0.0 } else { shown }
            });
            let set = rows[from].set.map(|v| (v / SPEED_STEP).round() * SPEED_STEP);
            let _ =
                writeln!(out, "{:.4},{:.2},{:.2},{:.5},{:.5}", k as f64 / RATE, current[0], current[1], set[0], set[1]);
        }
        out
    }

    /// Turning rates and specific force: `imu_*.csv`, on a clock that starts and runs otherwise.
    pub(super) fn inertial(&self, sight: Sight, rows: &[Row], s: &mut Stream) -> String {
        let mut out = String::from(match sight {
            Sight::Accelerometer => "time,wx,wy,wz,ax,ay,az\n",
            Sight::ThreeRates => "time,wx,wy,wz\n",
            Sight::YawRate => "time,wz\n",
        });
        let (start, runs) = (s.uniform(-0.4, 0.4), 1.0 + s.normal(0.002));
        let (mut k, mut shake) = (0_usize, [0.0_f64; 3]);
        loop {
            let instant = start + k as f64 * STEP * runs;
            let row = (instant / STEP).round().max(0.0) as usize;
            let Some(r) = rows.get(row) else { break };
            let moving = (r.set[0].abs() + r.set[1].abs()).min(1.0);
            let _ = write!(out, "{:.3}", k as f64 * STEP);
            let rate = |i: usize, s: &mut Stream| r.rates[i] + self.bias[i] + s.normal(0.006 + 0.02 * moving);
            let wz = rate(2, s);
            if sight == Sight::YawRate {
                let _ = writeln!(out, ",{wz:.5}");
            } else {
                let (wx, wy) = (rate(0, s), rate(1, s));
                let _ = write!(out, ",{wx:.5},{wy:.5},{wz:.5}");
                if sight == Sight::Accelerometer {
                    let (sin, cos) = self.mounted.sin_cos();
                    let [x, y, z] = r.force;
                    for (axis, truth) in [x * cos + z * sin, y, z * cos - x * sin].into_iter().enumerate() {
                        // Vibration is coloured: neighbouring samples share half of it.
                        let fresh = s.normal(0.02 + self.vibration * moving);
                        shake[axis] = 0.5 * shake[axis] + 0.87 * fresh;
                        let _ = write!(out, ",{:.4}", truth + shake[axis]);
                    }
                }
                out.push('\n');
            }
            k += 1;
        }
        out
    }
}

/// The mapping of such files, for wheels of this radius, m.
pub(super) fn mapping(sight: Sight, radius: f64) -> String {
    let scale = 1.0 / radius;
    let rates = match sight {
        Sight::YawRate => "",
        _ => "gyro_x = { column = \"wx\", unit = \"rad/s\" }\ngyro_y = { column = \"wy\", unit = \"rad/s\" }\n",
    };
    let force = match sight {
        Sight::Accelerometer => {
            "accel_x = { column = \"ax\", unit = \"m/s^2\" }\naccel_y = { column = \"ay\", unit = \"m/s^2\" }\n\
             accel_z = { column = \"az\", unit = \"m/s^2\" }\n"
        }
        _ => "",
    };
    format!(
        "name = \"drawn\"\n\n[[files]]\npattern = \"pro_*.csv\"\ntime = {{ column = \"time\", unit = \"s\", rate_hz = 6.5 }}\n\n\
         [files.signals]\n\
         current_left = {{ column = \"curL\", unit = \"A\", magnitude_only = true, dead_band = {DEAD_BAND} }}\n\
         current_right = {{ column = \"curR\", unit = \"A\", magnitude_only = true, dead_band = {DEAD_BAND} }}\n\
         command_speed_left = {{ column = \"velL\", unit = \"m/s\", scale = {scale}, kind = \"set-point\" }}\n\
         command_speed_right = {{ column = \"velR\", unit = \"m/s\", scale = {scale}, kind = \"set-point\" }}\n\n\
         [[files]]\npattern = \"imu_*.csv\"\ntime = {{ column = \"time\", unit = \"s\", rate_hz = 100.0 }}\n\n[files.signals]\n\
         {rates}gyro_z = {{ column = \"wz\", unit = \"rad/s\" }}\n{force}"
    )
}
