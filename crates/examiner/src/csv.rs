//! The files of a case as text.

use std::fmt::Write as _;

use crate::free::SEGMENT;
use crate::run::{Motion, Run};
use crate::sensors::Sheet;

/// Appends a number after a comma.
fn cell(out: &mut String, x: f64, decimals: usize) {
    // Writing to a String cannot fail.
    let _ = write!(out, ",{x:.decimals$}");
}

fn cells<const K: usize>(out: &mut String, values: Option<[f64; K]>, decimals: usize) {
    match values {
        Some(values) => values.iter().for_each(|x| cell(out, *x, decimals)),
        None => out.push_str(&",".repeat(K)),
    }
}

fn time(out: &mut String, k: usize, row: f64) {
    let decimals = if (row * 100.0).fract() > 1e-9 { 3 } else { 2 };
    let _ = write!(out, "{:.decimals$}", k as f64 * row);
}

fn torque_decimals(sheet: &Sheet) -> usize {
    if sheet.torque_step < 0.01 { 3 } else { 2 }
}

/// A reference run or recording.
pub(crate) fn recording(run: &Run, sheet: &Sheet, row: f64, pose: bool, accel: bool) -> String {
    let mut out = String::with_capacity(run.rows.len() * 70);
    out.push_str(
        "time_s,wheel_speed_left_rad_s,wheel_speed_right_rad_s,wheel_angle_left_rad,\
         wheel_angle_right_rad,torque_left_Nm,torque_right_Nm,gyro_z_rad_s,accel_x_m_s2,\
         accel_y_m_s2,pose_x_m,pose_y_m,pose_yaw_rad\n",
    );
    for (k, r) in run.rows.iter().enumerate() {
        time(&mut out, k, row);
        cells(&mut out, Some(r.speed), 3);
        cells(&mut out, Some(r.angle), 4);
        cells(&mut out, Some(r.torque), torque_decimals(sheet));
        cells(&mut out, r.imu.map(|i| [i[0]]), 4);
        cells(&mut out, r.imu.filter(|_| accel).map(|i| [i[1], i[2]]), 3);
        cells(&mut out, r.pose.filter(|_| pose), 4);
        out.push('\n');
    }
    out
}

/// A held-out run: inputs in every row, the state at restarts.
pub(crate) fn heldout(run: &Run, starts: &[Motion], rate: impl Fn(f64) -> f64, sheet: &Sheet, row: f64) -> String {
    let mut out = String::with_capacity(run.rows.len() * 32);
    out.push_str(
        "time_s,torque_left_Nm,torque_right_Nm,pose_x_m,pose_y_m,pose_yaw_rad,body_vx_m_s,\
         body_vy_m_s,gyro_z_rad_s,wheel_speed_left_rad_s,wheel_speed_right_rad_s,\
         wheel_angle_left_rad,wheel_angle_right_rad\n",
    );
    for (k, r) in run.rows.iter().enumerate() {
        time(&mut out, k, row);
        cells(&mut out, Some(r.torque), torque_decimals(sheet));
        let start = (k % SEGMENT == 0).then(|| &starts[k / SEGMENT]);
        cells(&mut out, start.map(|s| [s.body[0], s.body[1], s.body[2]]), 4);
        cells(&mut out, start.map(|s| [s.body[3], s.body[4]]), 5);
        cells(&mut out, start.map(|s| [rate(s.body[5])]), 4);
        cells(&mut out, start.map(|s| s.speed), 3);
        cells(&mut out, start.map(|s| s.angle), 4);
        out.push('\n');
    }
    out
}

/// The true responses of a held-out run.
pub(crate) fn responses(shown: &[[f64; 3]], row: f64) -> String {
    let mut out = String::with_capacity(shown.len() * 32);
    out.push_str("time_s,wheel_speed_left_rad_s,wheel_speed_right_rad_s,yaw_rate_rad_s\n");
    for (k, s) in shown.iter().enumerate() {
        time(&mut out, k, row);
        cells(&mut out, Some([s[0], s[1]]), 4);
        cell(&mut out, s[2], 5);
        out.push('\n');
    }
    out
}
