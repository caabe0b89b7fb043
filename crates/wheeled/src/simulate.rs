//! A robot as stated on the torques and steering angles of a drive.

use std::sync::Arc;

use verdict::{ErrorAhead, SimulatedPath};

use crate::constants::constants;
use crate::drive::{Drive, STEP};
use crate::left_out::{LENGTHS, forecasts, medians, predicted};
use crate::robot::AnyWheels;
use crate::rows::Constants;

/// The motion of a robot as stated, from the torques of its motors and the angles of its steering alone: from the first pose
/// that was measured with its velocity to the end of the drive (anew after stretches without a pose), at rest at the origin
/// without any. Beside it errors over each of [`LENGTHS`], of runs that begin anew every second.
pub fn simulate(robot: &AnyWheels, drive: &Drive) -> SimulatedPath {
    let all = constants(robot, true, drive.gyro.is_some());
    let stated = vec![0.0; all.len()];
    let model = Constants { robot: Arc::new(robot.clone()), all };
    let pose = predicted(&model, &stated, drive);
    let errors = if drive.has_pose() { forecasts(&model, &stated, drive) } else { Vec::new() };
    SimulatedPath {
        name: drive.name.clone(),
        time: (0..pose.len()).map(|k| drive.start + STEP * k as f64).collect(),
        pose,
        ahead: ErrorAhead::of(LENGTHS, medians(&errors).map(|m| m.map(|m| m.map(Some)))),
    }
}
