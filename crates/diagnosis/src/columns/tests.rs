//! Columns that contradict each other.

use super::*;
use robot_model::Robot;
use testing::{recording, robot, samples};

type Channels = Vec<(Signal, Vec<(f64, f64)>)>;

/// Rows at 100 Hz: a minute.
const ROWS: usize = 6000;

fn forward(t: f64) -> f64 {
    0.6 + 0.5 * (0.7 * t).sin()
}

fn turn(t: f64) -> f64 {
    0.9 * (0.45 * t + 1.0).sin()
}

/// A winding drive whose channels agree: the body moves as its wheels roll, torques overcome inertia and dry friction.
fn drive(robot: &Robot<f64>) -> Channels {
    let (r, b) = (robot.wheel_radius, robot.half_track);
    let wheel = move |side: f64, t: f64| (forward(t) + side * b * turn(t)) / r;
    let torque = move |side: f64, t: f64| {
        let rate = (wheel(side, t + 0.01) - wheel(side, t - 0.01)) / 0.02;
        0.1 * rate + 0.8 * (wheel(side, t) / 0.3).tanh() + side * 1.5 * (turn(t) / 0.1).tanh()
    };
    let heading = |t: f64| 0.4 - 2.0 * (0.45 * t + 1.0).cos();
    let (mut x, mut y) = (0.0, 0.0);
    let track = samples(ROWS, |t| t).into_iter().map(|(t, _)| {
        x += 0.01 * forward(t) * heading(t).cos();
        y += 0.01 * forward(t) * heading(t).sin();
        (t, x, y)
    });
    let (along, across) = track.map(|(t, x, y)| ((t, x), (t, y))).unzip();
    vec![
        (Signal::WheelSpeedLeft, samples(ROWS, |t| wheel(-1.0, t))),
        (Signal::WheelSpeedRight, samples(ROWS, |t| wheel(1.0, t))),
        (Signal::TorqueLeft, samples(ROWS, |t| torque(-1.0, t))),
        (Signal::TorqueRight, samples(ROWS, |t| torque(1.0, t))),
        (Signal::CommandSpeedLeft, samples(ROWS, |t| wheel(-1.0, t + 0.1))),
        (Signal::CommandSpeedRight, samples(ROWS, |t| wheel(1.0, t + 0.1))),
        (Signal::GyroZ, samples(ROWS, |t| turn(t) + 0.02)),
        (Signal::AccelX, samples(ROWS, |t| 0.35 * (0.7 * t).cos() + 0.1)),
        (Signal::AccelY, samples(ROWS, |t| forward(t) * turn(t) - 0.1)),
        (Signal::PoseX, along),
        (Signal::PoseY, across),
        (Signal::PoseYaw, samples(ROWS, |t| heading(t).sin().atan2(heading(t).cos()))),
    ]
}

/// The drive without these signals.
fn without(signals: &[Signal]) -> Channels {
    drive(&robot()).into_iter().filter(|(signal, _)| !signals.contains(signal)).collect()
}

fn scaled(mut channels: Channels, signals: &[Signal], factor: f64) -> Channels {
    for (_, samples) in channels.iter_mut().filter(|(signal, _)| signals.contains(signal)) {
        for sample in samples {
            sample.1 *= factor;
        }
    }
    channels
}

fn exchanged(mut channels: Channels, [a, b]: [Signal; 2]) -> Channels {
    for (signal, _) in &mut channels {
        *signal = if *signal == a {
            b
        } else if *signal == b {
            a
        } else {
            *signal
        };
    }
    channels
}

fn told(channels: &Channels) -> Option<String> {
    consistent(&recording(channels), &robot()).err().map(|e| e.to_string())
}

/// The message holds both parts.
fn tells(channels: &Channels, what: &str, remedy: &str) {
    let message = told(channels).unwrap_or_default();
    assert!(message.contains(what) && message.contains(remedy), "{what} ... {remedy}: {message:?}");
}

const WHEELS: [Signal; 2] = [Signal::WheelSpeedLeft, Signal::WheelSpeedRight];
const COMMANDS: [Signal; 2] = [Signal::CommandSpeedLeft, Signal::CommandSpeedRight];
const TORQUES: [Signal; 2] = [Signal::TorqueLeft, Signal::TorqueRight];
const FORCES: [Signal; 2] = [Signal::AccelX, Signal::AccelY];
const PLACE: [Signal; 2] = [Signal::PoseX, Signal::PoseY];
const POSE: [Signal; 3] = [Signal::PoseX, Signal::PoseY, Signal::PoseYaw];

#[test]
fn channels_that_agree_pass() {
    for missing in [&[][..], &POSE, &[Signal::GyroZ], &WHEELS, &TORQUES, &FORCES] {
        assert_eq!(told(&without(missing)), None, "without {missing:?}");
    }
}

#[test]
fn what_robots_do_is_no_contradiction() {
    // Wheels that slip, a weak motor, twice the mass, a biased gyro.
    for (signals, factor) in [(&WHEELS[..], 2.5), (&TORQUES, 0.5), (&TORQUES, 2.0), (&[Signal::GyroZ], 1.3)] {
        assert_eq!(told(&scaled(without(&[]), signals, factor)), None, "{signals:?} times {factor}");
    }
}

#[test]
fn an_encoder_of_another_scale_does_not_exchange_torques() {
    // Wide bends to the left, which are bends to the right by the wheels alone.
    let (r, b) = (robot().wheel_radius, robot().half_track);
    let turn = |t: f64| 0.25 * (0.3 * t).sin().powi(2);
    let wheel = |side: f64, t: f64| (forward(t) + side * b * turn(t)) / r;
    let torque = |side: f64, t: f64| 0.8 * (wheel(side, t) / 0.3).tanh() + side * 3.0 * (turn(t) / 0.1).tanh();
    let channels = vec![
        (Signal::WheelSpeedLeft, samples(ROWS, |t| 1.8 * wheel(-1.0, t))),
        (Signal::WheelSpeedRight, samples(ROWS, |t| wheel(1.0, t))),
        (Signal::TorqueLeft, samples(ROWS, |t| torque(-1.0, t))),
        (Signal::TorqueRight, samples(ROWS, |t| torque(1.0, t))),
        (Signal::GyroZ, samples(ROWS, turn)),
    ];
    assert_eq!(told(&channels), None);
}

#[test]
fn wheels_are_held_against_the_pose() {
    let right = &WHEELS[1..];
    tells(&scaled(without(&[]), right, -1.0), "the motion of the pose", "`sign = -1` for wheel_speed_right");
    tells(&scaled(without(&[]), &WHEELS, -1.0), "the motion of the pose", "wheel_speed_left (column");
    tells(&exchanged(without(&[]), WHEELS), "the motion of the pose", "exchange wheel_speed_left");
    tells(&scaled(without(&[]), &WHEELS, 9.549), "times its size", "rpm");
}

#[test]
fn wheels_are_held_against_the_gyro_where_there_is_no_pose() {
    let left = &WHEELS[..1];
    tells(&exchanged(without(&POSE), WHEELS), "turn the body to the other side", "exchange left and right");
    tells(&scaled(without(&POSE), left, -1.0), "their difference does not", "`sign = -1` for wheel_speed_left");
    tells(&scaled(without(&POSE), &WHEELS, 57.3), "times the rate", "deg/s");
    // A robot that is stuck turns a tenth of what its wheels ask.
    let measured_alone = without(&[&POSE[..], &COMMANDS, &TORQUES, &FORCES].concat());
    assert_eq!(told(&scaled(measured_alone, &WHEELS, 10.0)), None);
}

#[test]
fn set_speeds_are_held_against_the_wheels() {
    tells(&exchanged(without(&[]), COMMANDS), "measured speeds", "exchange command_speed_left");
    tells(&scaled(without(&[]), &COMMANDS, 9.549), "times its size", "rpm");
    // Where nothing is measured they stand for the wheels.
    let unmeasured = without(&[&WHEELS[..], &POSE].concat());
    tells(&exchanged(unmeasured, COMMANDS), "turn the body to the other side", "exchange left and right");
}

#[test]
fn torques_are_held_against_the_motion_of_the_wheels() {
    tells(&exchanged(without(&[]), TORQUES), "the robot of the file needs", "exchange torque_left");
    tells(&scaled(without(&[]), &TORQUES[1..], -1.0), "needs", "`sign = -1` for torque_right");
    tells(&scaled(without(&[]), &TORQUES, -1.0), "needs", "torque_left (column 'torque_left_Nm') and torque_right");
    tells(&scaled(without(&[]), &TORQUES, 100.0), "times its size", "kgf m");
    tells(&scaled(without(&[]), &TORQUES, 0.102), "times its size", "kgf m");
    // Set-points may be far beyond what a limit lets through.
    let limit = 1.4 * robot().drive.limit;
    let mut limited = scaled(without(&[]), &TORQUES, 12.0);
    for (_, samples) in limited.iter_mut().filter(|(signal, _)| TORQUES.contains(signal)) {
        for sample in samples.iter_mut() {
            sample.1 = sample.1.clamp(-limit, limit);
        }
    }
    assert_eq!(told(&limited), None);
}

#[test]
fn a_gyro_and_a_pose_are_held_against_each_other() {
    let yaw = [Signal::PoseYaw];
    tells(&scaled(without(&[]), &[Signal::GyroZ], -1.0), "turn to opposite sides", "`sign = -1` for gyro_z");
    tells(&scaled(without(&[]), &yaw, -1.0), "heading mirrored", "`sign = -1` for pose_yaw");
    tells(&exchanged(without(&[]), PLACE), "heading mirrored", "exchange pose_x");
}

#[test]
fn accelerometers_are_held_against_the_push_of_turns() {
    tells(&scaled(without(&[]), &FORCES, -1.0), "pushes inward", "for it and for accel_x");
    tells(&exchanged(without(&[]), FORCES), "turned by a right angle", "exchange the two");
    let in_g = scaled(without(&[]), &FORCES, 1.0 / 9.81);
    tells(&in_g, "times the push of turns", "unit = \"g\"");
    // An upward accelerometer in m/s² shows that the wheels are off, and not the unit.
    let with_gravity = [in_g, vec![(Signal::AccelZ, samples(ROWS, |_| 9.8))]].concat();
    assert_eq!(told(&with_gravity), None);
}

#[test]
fn a_right_angle_shows_in_the_means_where_vibration_hides_the_push() {
    let shaken = |columns: Channels| -> Channels {
        let shake = |(signal, samples): (Signal, Vec<(f64, f64)>)| {
            let by = if FORCES.contains(&signal) { 1.5 } else { 0.0 };
            // Whole periods in a second.
            let at = |(t, v): (f64, f64)| (t, v + by * (std::f64::consts::TAU * 2.0 * t).sin());
            (signal, samples.into_iter().map(at).collect())
        };
        columns.into_iter().map(shake).collect()
    };
    tells(&shaken(exchanged(without(&[]), FORCES)), "averaged over a second", "exchange the two");
    assert_eq!(told(&shaken(without(&[]))), None);
}

#[test]
fn a_state_every_two_seconds_contradicts_nothing() {
    let mut sparse = scaled(without(&TORQUES), &[Signal::GyroZ], -1.0);
    for (_, samples) in &mut sparse {
        *samples = samples.iter().step_by(200).copied().collect();
    }
    assert_eq!(told(&sparse), None);
}
