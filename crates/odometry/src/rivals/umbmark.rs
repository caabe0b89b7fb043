//! UMBmark: Borenstein & Feng, "Measurement and correction of systematic odometry errors in mobile robots", IEEE Trans. Robot.
//! Autom. 12 (1996), eqs. 3 to 20: return errors of squares driven both ways give the ratio of the wheels and the wheelbase.

use crate::drive::Drive;
use crate::kinematics::Kinematics;
use crate::motion::{Laws, implied, relative};
use crate::rivals::differential;
use crate::settings::SETTINGS;
use crate::wheel::WheeledRobot;
use inference::robust::mean;

/// Squares of one drive: return error per lap in its start frame, side, and whether they turn left.
struct Squares {
    error: [f64; 2],
    side: f64,
    left: bool,
}

/// Ratio of the wheels and track from the squares among the drives; `None` where they are not driven both ways.
pub(super) fn calibrated(robot: &WheeledRobot, drives: &[&Drive]) -> Option<Laws> {
    let (left_wheel, right_wheel, track) = differential(robot)?;
    let given = Laws::given(robot);
    let squares: Vec<Squares> = drives.iter().filter_map(|d| squares(robot, d, &given)).collect();
    let of = |left: bool, value: fn(&Squares) -> f64| mean(squares.iter().filter(|s| s.left == left).map(value));
    let [cw, ccw] = [of(false, |s| s.error[0])?, of(true, |s| s.error[0])?];
    let side = mean(squares.iter().map(|s| s.side))?;

    let alpha = (cw + ccw) / (-4.0 * side);
    let beta = (cw - ccw) / (-4.0 * side);
    let right_angle = std::f64::consts::FRAC_PI_2;
    let base = right_angle / (right_angle - alpha);
    // Eq. 14 with R = (L/2)/sin(β/2): E_d = (R + b/2)/(R − b/2).
    let bend = 2.0 * (0.5 * beta).sin() / side;
    let ratio = (1.0 + 0.5 * track * bend) / (1.0 - 0.5 * track * bend);

    let mut out = given;
    out.geometry.across = base;
    // Eqs. 18 and 19 keep the mean diameter.
    out.geometry.radius[left_wheel] = 2.0 / (ratio + 1.0);
    out.geometry.radius[right_wheel] = 2.0 / (1.0 / ratio + 1.0);
    Some(out)
}

/// A drive as squares with turns on the spot, if it is one: whole laps back to the start, straight sides.
fn squares(robot: &WheeledRobot, drive: &Drive, given: &Laws) -> Option<Squares> {
    let rules = SETTINGS.forecast;
    let seen: Vec<usize> = (0..drive.pose.len()).filter(|&k| drive.is_seen(k)).collect();
    let (first, last) = (*seen.first()?, *seen.last()?);
    let turned = drive.pose[last][2] - drive.pose[first][2];
    let laps = (turned.abs() / std::f64::consts::TAU).round();
    if laps < 1.0 || (turned.abs() - laps * std::f64::consts::TAU).abs() > rules.corner {
        return None;
    }
    let kinematics = Kinematics::new(robot, &given.geometry);
    let (mut way, mut curved) = (0.0, 0.0);
    for row in first + 1..=last {
        let [x, _, t] = kinematics.motion(&drive.turns[row], 0.0);
        way += x.abs();
        // Way that is driven while turning by a tenth of a radian per side of the robot and more is no side of a square.
        if t.abs() * rules.corner > x.abs() {
            curved += x.abs();
        }
    }
    let path = implied(robot, drive, given);
    let back = relative(drive.pose[first], drive.pose[last]);
    let is_loop = back[0].hypot(back[1]) < rules.loop_share * way;
    // A circle turns all the way, a square a quarter at each corner.
    let quarters = straight_quarters(drive, first, last);
    if !is_loop || curved > rules.loop_share * way || quarters != (4.0 * laps) as usize {
        return None;
    }
    let calculated = relative(path[first], path[last]);
    let error = [0, 1].map(|axis| (back[axis] - calculated[axis]) / laps);
    Some(Squares { error, side: way / (4.0 * laps), left: turned > 0.0 })
}

/// How often the heading rests near another multiple of a right angle.
fn straight_quarters(drive: &Drive, first: usize, last: usize) -> usize {
    let right_angle = std::f64::consts::FRAC_PI_2;
    let quarter = |row: usize| ((drive.pose[row][2] - drive.pose[first][2]) / right_angle).round() as i64;
    let (mut count, mut at) = (0, quarter(first));
    for row in first..=last {
        if drive.is_seen(row) && quarter(row) != at {
            (count, at) = (count + 1, quarter(row));
        }
    }
    count
}
