#![doc = include_str!("../README.md")]

use std::io::Cursor;

use hierarchical_fit::{Column, Table};
use recordings::{Channel, Clock, NamedColumn, Recording, Signal, named_columns};
use robot_model::robot::Drive;
use robot_model::{Chassis, Robot};

/// Time between rows, s.
pub const PERIOD: f64 = 0.01;

/// A robot of 20 kg.
pub fn robot() -> Robot<f64> {
    Robot {
        mass: 20.0,
        yaw_inertia: 0.9,
        com: [0.0, 0.0, 0.12],
        half_wheelbase: 0.18,
        half_track: 0.2,
        wheel_radius: 0.1,
        wheel_inertia: 0.006,
        motor_inertia: 0.02,
        adhesion: 0.7,
        slip_at_peak: 0.15,
        sliding_share: 1.0,
        rest_speed: 0.3,
        lateral_factor: 1.0,
        rolling_resistance: 0.03,
        coulomb: [0.3; 2],
        viscous: [0.05; 2],
        stribeck: 0.0,
        chassis: Chassis::SkidSteer,
        casters: [[0.0; 2]; 2],
        caster_trail: 0.0,
        caster_rolling: 0.0,
        hitch_x: -0.18,
        drive: Drive { gain: 1.0, lag: 0.02, extra_lag: 0.0, delay: 0.0, limit: 20.0, dead_band: 0.0 },
        gravity: 9.81,
    }
}

/// A robot of 12 kg on two driven wheels, a caster behind and one ahead.
///
/// # Panics
/// Never: these constants make a robot.
pub fn on_casters() -> Robot<f64> {
    let given = [
        ("mass", 12.0),
        ("yaw_inertia", 0.3),
        ("com_x", -0.03),
        ("com_height", 0.1),
        ("track", 0.32),
        ("caster_x", -0.18),
        ("caster_y", 0.05),
        ("second_caster_x", 0.15),
        ("wheel_radius", 0.07),
        ("wheel_inertia", 0.002),
        ("motor_inertia", 0.01),
        ("adhesion", 0.8),
        ("rolling_resistance", 0.02),
        ("coulomb", 0.2),
        ("viscous", 0.02),
        ("motor_lag", 0.01),
        ("torque_limit", 6.0),
    ];
    Robot::on_chassis(Chassis::Differential, &given).unwrap_or_else(|error| panic!("{error}"))
}

/// A recording of these channels on one clock; samples `(time in s, value)`.
///
/// # Panics
/// When times do not increase.
pub fn recording(channels: &[(Signal, Vec<(f64, f64)>)]) -> Recording {
    let channels = channels
        .iter()
        .map(|(signal, samples)| {
            let (t, v) = samples.iter().map(|(t, v)| ((t * 1e9).round() as i64, *v)).unzip();
            Channel::new(*signal, 0, t, v).expect("a channel")
        })
        .collect();
    let clock = Clock { name: "test".to_owned(), nominal_rate_hz: None };
    Recording::new("r", vec![clock], channels).expect("a recording")
}

/// The columns of a comma-separated table.
///
/// # Panics
/// When it is no table.
pub fn table(drive: &str, text: &str) -> Table {
    let header: Vec<&str> = text.lines().next().unwrap_or_default().split(',').collect();
    let read = named_columns(drive, &mut Cursor::new(text), &header).unwrap_or_else(|error| panic!("{error}"));
    let columns = read.columns.into_iter();
    let columns = columns.map(|NamedColumn { name, cells, unread, .. }| (name, Column { cells, unread })).collect();
    Table { drive: drive.to_owned(), names: read.names, columns }
}

/// `n` samples of `f` at 100 Hz.
pub fn samples(n: usize, f: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
    (0..n).map(|k| k as f64 * PERIOD).map(|t| (t, f(t))).collect()
}
