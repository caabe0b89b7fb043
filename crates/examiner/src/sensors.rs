//! What the sensors of the robot say about its motion.

use crate::random::Stream;
use crate::{RobotClass, Settings};

/// Data sheet of the sensors.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sheet {
    pub counts: f64,
    pub gyro: f64,
    pub gyro_bias: f64,
    pub accel: f64,
    pub accel_bias: f64,
    pub torque: f64,
    pub torque_step: f64,
    pub place: f64,
    pub yaw: f64,
    pub imu_rate: f64,
    pub pose_rate: f64,
    pub heavy_tails: bool,
}

/// Share of samples that err more than usual where tails are heavy, and how many times more.
const OUTLIERS: (f64, f64) = (0.03, 5.0);

impl Sheet {
    /// The sensors of a robot of this size.
    pub(crate) fn new(settings: &Settings) -> Self {
        let k = settings.noise;
        let class = match settings.mass_kg {
            None => settings.class,
            Some(mass) if mass < 10.0 => RobotClass::Small,
            Some(mass) if mass < 40.0 => RobotClass::Medium,
            Some(_) => RobotClass::Large,
        };
        let torque_step = match class {
            RobotClass::Small => 0.002,
            RobotClass::Medium => 0.01,
            RobotClass::Large => 0.05,
        };
        Self {
            counts: 16384.0,
            gyro: 0.006 * k,
            gyro_bias: 0.0015 * k,
            accel: 0.08 * k,
            accel_bias: 0.03 * k,
            torque: 1.5 * torque_step * k,
            torque_step,
            place: 0.004 * k,
            yaw: 0.004 * k,
            imu_rate: 97.0,
            pose_rate: 9.7,
            heavy_tails: settings.heavy_tails,
        }
    }

    /// Angle as the encoder counts it.
    pub(crate) fn angle(&self, angle: f64) -> f64 {
        let turn = std::f64::consts::TAU / self.counts;
        (angle / turn).floor() * turn
    }
}

/// Inertial unit and pose of one run, on their own clocks.
#[derive(Debug, Clone)]
pub(crate) struct Sampler {
    sheet: Sheet,
    stream: Stream,
    gyro_bias: f64,
    accel_bias: [f64; 2],
    next_imu: f64,
    next_pose: f64,
    /// Samples that no row holds yet: gyro and accelerometer, pose.
    pub imu: Option<[f64; 3]>,
    pub pose: Option<[f64; 3]>,
}

impl Sampler {
    /// Sensors that start at a phase of their own.
    pub(crate) fn new(sheet: Sheet, mut stream: Stream) -> Self {
        Self {
            gyro_bias: stream.normal(sheet.gyro_bias),
            accel_bias: [0, 1].map(|_| stream.normal(sheet.accel_bias)),
            next_imu: stream.uniform(0.0, 1.0 / sheet.imu_rate),
            next_pose: 0.0,
            imu: None,
            pose: None,
            sheet,
            stream,
        }
    }

    /// Takes the samples due before `end`, from the gyro rate, specific force and pose then.
    pub(crate) fn sample(&mut self, end: f64, rate: f64, felt: [f64; 2], pose: [f64; 3]) {
        let (h, s) = (&self.sheet, &mut self.stream);
        if self.next_imu < end {
            self.next_imu += 1.0 / h.imu_rate;
            let wild = wild(h, s);
            let gyro = rate + self.gyro_bias + wild * s.normal(h.gyro);
            let accel = [0, 1].map(|i| felt[i] + self.accel_bias[i] + wild * s.normal(h.accel));
            self.imu = Some([gyro, accel[0], accel[1]]);
        }
        if self.next_pose < end {
            self.next_pose += 1.0 / h.pose_rate;
            let wild = wild(h, s);
            self.pose = Some([
                pose[0] + wild * s.normal(h.place),
                pose[1] + wild * s.normal(h.place),
                pose[2] + wild * s.normal(h.yaw),
            ]);
        }
    }
}

/// How many times its usual error a sample has. Nothing is drawn where tails are not heavy.
fn wild(sheet: &Sheet, s: &mut Stream) -> f64 {
    let (share, times) = OUTLIERS;
    if sheet.heavy_tails && s.unit() < share { times } else { 1.0 }
}

/// Rows at which an encoder is frozen: bursts that cover about the fraction.
pub(crate) fn frozen_rows(s: &mut Stream, fraction: f64, rows: usize, row: f64) -> Vec<bool> {
    let mut frozen = vec![false; rows];
    if fraction <= 0.0 {
        return frozen;
    }
    let wanted = (fraction * rows as f64).round() as usize;
    let longest = (0.12 / row).max(4.0);
    let mut count = 0;
    for _ in 0..100_000 {
        if count >= wanted {
            break;
        }
        let length = (s.uniform(3.0, longest) as usize).min(wanted - count).max(3);
        let start = 20 + s.index(rows.saturating_sub(40));
        let end = (start + length).min(rows - 1);
        let free = frozen[start.saturating_sub(3)..(end + 3).min(rows)].iter().all(|f| !f);
        if free {
            frozen[start..end].fill(true);
            count += end - start;
        }
    }
    frozen
}
