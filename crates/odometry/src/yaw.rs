//! Whole turns of a yaw that wraps around.

use std::f64::consts::TAU;

use crate::drive::Drive;
use crate::kinematics::{Geometry, Kinematics};
use crate::settings::SETTINGS;
use crate::wheel::WheeledRobot;

/// Takes the yaw of each row to be the nearest to that of the row before in which it was seen; `turn` is a whole turn in its unit.
pub(crate) fn unwrap_yaw(drive: &mut Drive, turn: f64) {
    let mut last: Option<f64> = None;
    for pose in &mut drive.pose {
        if pose[2].is_finite() {
            if let Some(before) = last {
                pose[2] -= ((pose[2] - before) / turn).round() * turn;
            }
            last = Some(pose[2]);
        }
    }
}

/// Adds the whole turns that a robot made while its pose was not seen, by its wheels: of a yaw in rad from row to row the nearest is
/// right only while it is seen. Wheels count by as much as they turn the robot while it is seen, whatever its file says.
pub(crate) fn turn_while_unseen(drive: &mut Drive, robot: &WheeledRobot) {
    let geometry = Geometry::given(robot);
    let kinematics = Kinematics::new(robot, &geometry);
    let steering = |row: usize| drive.steering.as_ref().map_or(0.0, |s| s[row]);
    let mut turned = vec![0.0; drive.time.len()];
    for row in 1..turned.len() {
        turned[row] = turned[row - 1] + kinematics.motion(&drive.turns[row], steering(row))[2];
    }

    let seen: Vec<usize> = (0..drive.pose.len()).filter(|&row| drive.is_seen(row)).collect();
    let is_unseen = |from: usize, to: usize| drive.time[to] - drive.time[from] > SETTINGS.drive.rate;
    let (mut product, mut square) = (0.0, 0.0);
    for rows in seen.windows(2).filter(|rows| !is_unseen(rows[0], rows[1])) {
        let by_wheels = turned[rows[1]] - turned[rows[0]];
        product += by_wheels * (drive.pose[rows[1]][2] - drive.pose[rows[0]][2]);
        square += by_wheels * by_wheels;
    }
    if square <= 0.0 {
        return;
    }
    let scale = product / square;

    let mut turns = 0.0;
    let mut added = vec![0.0; seen.len()];
    for (k, rows) in seen.windows(2).enumerate() {
        if is_unseen(rows[0], rows[1]) {
            let by_wheels = scale * (turned[rows[1]] - turned[rows[0]]);
            turns += ((by_wheels - (drive.pose[rows[1]][2] - drive.pose[rows[0]][2])) / TAU).round();
        }
        added[k + 1] = turns * TAU;
    }
    for (row, added) in seen.into_iter().zip(added) {
        drive.pose[row][2] += added;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drive::WheelData;

    #[test]
    fn turns_that_were_made_while_the_pose_was_not_seen_are_counted_by_the_wheels() {
        // On the spot, with a track that the robot file has wrong by a fifth.
        let robot = WheeledRobot::differential(0.05, 0.3);
        let (rate, track) = (1.4, 0.36);
        let time: Vec<f64> = (0..1000).map(|k| 0.02 * f64::from(k)).collect();
        let wheel = |side: f64| time.iter().map(|t| side * rate * t * 0.5 * track / 0.05).collect::<Vec<f64>>();
        let wheels = [wheel(-1.0), wheel(1.0)];
        let is_hidden = |t: f64| (5.0..8.5).contains(&t) || (12.0..13.0).contains(&t);
        let wrapped = |t: f64| {
            let yaw = rate * t;
            if is_hidden(t) { [f64::NAN; 3] } else { [0.0, 0.0, yaw - TAU * (yaw / TAU).round()] }
        };
        let pose = time.iter().map(|t| wrapped(*t)).collect();
        let drive = Drive::new("a", &robot, time.clone(), (WheelData::Angle, &wheels), None, pose).expect("a drive");
        for (t, pose) in time.iter().zip(&drive.pose).filter(|(t, _)| !is_hidden(**t)) {
            approx::assert_relative_eq!(pose[2], rate * t, epsilon = 1e-9);
        }
    }
}
