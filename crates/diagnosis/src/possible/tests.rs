//! Values that cannot be.

use super::*;
use testing::{recording, robot, samples};

type Channels = Vec<(Signal, Vec<(f64, f64)>)>;

const ROWS: usize = 1000;

/// Both sides turn at 5 and 7 rad/s; the inertial sensor and the pose go with them.
fn drive(robot: &Robot<f64>) -> Channels {
    let r = robot.wheel_radius;
    let (speed, turn) = (6.0 * r, r / robot.half_track);
    vec![
        (Signal::WheelSpeedLeft, samples(ROWS, |_| 5.0)),
        (Signal::WheelSpeedRight, samples(ROWS, |_| 7.0)),
        (Signal::TorqueLeft, samples(ROWS, |t| 3.0 + t.sin())),
        (Signal::GyroZ, samples(ROWS, move |_| turn)),
        (Signal::AccelX, samples(ROWS, |t| 0.1 * t.sin())),
        (Signal::AccelZ, samples(ROWS, |_| 9.7)),
        (Signal::PoseX, samples(ROWS, move |t| speed / turn * (turn * t).sin())),
        (Signal::PoseY, samples(ROWS, move |t| -speed / turn * (turn * t).cos())),
        (Signal::PoseYaw, samples(ROWS, move |t| turn * t)),
    ]
}

fn scaled(channels: &Channels, signal: Signal, factor: f64) -> Channels {
    let mut out = channels.clone();
    for (_, samples) in out.iter_mut().filter(|c| c.0 == signal) {
        for s in samples {
            s.1 *= factor;
        }
    }
    out
}

fn refused(channels: &Channels) -> String {
    possible(recording(channels), &robot(), Some(0.5)).map(|_| ()).expect_err("impossible").to_string()
}

#[test]
fn a_drive_as_robots_drive_stays_as_it_is() {
    let robot = robot();
    let real = recording(&drive(&robot));
    let (kept, told) = possible(real.clone(), &robot, Some(0.5)).expect("possible");
    assert_eq!((kept, told), (real, Vec::new()));
}

#[test]
fn a_spike_is_left_out_and_told() {
    let robot = robot();
    let mut channels = drive(&robot);
    channels[8].1[300].1 = 1e300;
    channels[3].1[10].1 = -5e3;
    let (kept, told) = possible(recording(&channels), &robot, Some(0.5)).expect("possible");
    assert_eq!(kept.get(Signal::PoseYaw).map(Channel::len), Some(ROWS - 1));
    assert_eq!(kept.get(Signal::GyroZ).map(Channel::len), Some(ROWS - 1));
    assert_eq!(told.len(), 2);
    assert!(told[1].contains("1 of 1000 samples of pose_yaw"), "{told:?}");
}

#[test]
fn wrong_units_are_named() {
    let right = drive(&robot());
    for (signal, factor, unit) in [
        (Signal::TorqueLeft, 1e3, "mNm"),
        (Signal::PoseX, 1e3, "mm"),
        (Signal::GyroZ, 57.3, "deg/s"),
        (Signal::PoseYaw, 57.3, "deg"),
        (Signal::WheelSpeedLeft, 1e3, "deg/s"),
    ] {
        let message = refused(&scaled(&right, signal, factor));
        assert!(message.contains(signal.name()), "{message}");
        assert!(message.contains(&format!("`unit = \"{unit}\"`")), "{signal}: {message}");
    }
}

#[test]
fn set_speeds_tell_the_unit_of_a_gyro_as_measured_ones_do() {
    let mut channels = scaled(&drive(&robot()), Signal::GyroZ, 57.3);
    channels.retain(|c| !c.0.name().starts_with("pose"));
    for c in &mut channels {
        c.0 = match c.0 {
            Signal::WheelSpeedLeft => Signal::CommandSpeedLeft,
            Signal::WheelSpeedRight => Signal::CommandSpeedRight,
            other => other,
        };
    }
    let message = refused(&channels);
    assert!(message.contains("its wheels turn it") && message.contains("`unit = \"deg/s\"`"), "{message}");
}

#[test]
fn a_value_without_end_is_told_in_few_digits() {
    let message = refused(&scaled(&drive(&robot()), Signal::PoseYaw, 1e300));
    assert!(message.len() < 400, "{message}");
}

#[test]
fn a_sensor_upside_down_or_on_its_side_is_refused_with_the_lines_that_mend_it() {
    let right = drive(&robot());
    let message = refused(&scaled(&right, Signal::AccelZ, -1.0));
    assert!(message.contains("upside down; write `sign = -1` for accel_z, gyro_z"), "{message}");
    let mut aside = scaled(&right, Signal::AccelZ, 0.01);
    for s in &mut aside[4].1 {
        s.1 = -9.8;
    }
    let message = refused(&aside);
    assert!(message.contains("accel_x (column") && message.contains("with `sign = -1`"), "{message}");
}

#[test]
fn accelerations_in_g_or_without_gravity_are_told_and_kept() {
    let robot = robot();
    for (factor, word) in [(1.0 / GRAVITY, "`unit = \"g\"`"), (0.001, "gravity was taken off")] {
        let other = recording(&scaled(&drive(&robot), Signal::AccelZ, factor));
        let (kept, told) = possible(other.clone(), &robot, Some(0.5)).expect("possible");
        assert_eq!(kept, other);
        assert!(told[0].contains(word), "{told:?}");
    }
}

#[test]
fn currents_are_judged_by_the_torque_that_they_give() {
    let robot = robot();
    let drive = |amperes: f64| {
        let mut channels = drive(&robot);
        channels.retain(|c| c.0 != Signal::TorqueLeft);
        channels.push((Signal::CurrentLeft, samples(ROWS, move |t| amperes * (1.5 + t.sin()))));
        recording(&channels)
    };
    let per_current = robot.mass * GRAVITY * robot.wheel_radius / 20.0;
    assert!(possible(drive(4.0), &robot, Some(per_current)).is_ok_and(|(_, told)| told.is_empty()));
    let told = possible(drive(4000.0), &robot, Some(per_current)).expect_err("milliamperes").to_string();
    assert!(
        told.contains("current_left") && told.contains("torque_per_current") && told.contains("unit = \"mA\""),
        "{told}"
    );
    assert!(possible(drive(4000.0), &robot, None).is_ok(), "nothing says what a current gives");
}
