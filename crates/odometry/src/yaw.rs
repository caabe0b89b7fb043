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
    let is_unseen = |from: usize, to: usize| drive.time[to] - drive.time[from] > SETTINGS.drive.unseen;
    // Over stretches that are long enough for single counts not to matter.
    let (mut product, mut square, mut of_pose) = (0.0, 0.0, 0.0);
    let mut from = 0;
    for k in 1..seen.len() {
        if is_unseen(seen[k - 1], seen[k]) {
            from = k;
        } else if drive.time[seen[k]] - drive.time[seen[from]] >= SETTINGS.drive.turning {
            let by_wheels = turned[seen[k]] - turned[seen[from]];
            let by_pose = drive.pose[seen[k]][2] - drive.pose[seen[from]][2];
            product += by_wheels * by_pose;
            square += by_wheels * by_wheels;
            of_pose += by_pose * by_pose;
            from = k;
        }
    }
    // Wheels that do not turn as the pose does, one of them reversed or dead, say nothing of what was not seen.
    if square <= 0.0 || product * product < SETTINGS.drive.agree * square * of_pose {
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

    const RATE: f64 = 1.4;

    fn is_hidden(t: f64) -> bool {
        (5.0..8.5).contains(&t) || (12.0..13.0).contains(&t)
    }

    /// A robot that turns in bends, with a track that the robot file has wrong by a fifth, as coarse counters show it; `sign` of the left
    /// wheel.
    fn turned(tick: f64, sign: f64) -> (Vec<f64>, Drive) {
        let robot = WheeledRobot::differential(0.05, 0.3);
        let track = 0.36;
        let time: Vec<f64> = (0..1000).map(|k| 0.02 * f64::from(k)).collect();
        let wheel = |side: f64, sign: f64| {
            let way = |t: f64| 0.2 * t + 0.15 * (1.0 - t.cos());
            let angle = |t: &f64| ((way(*t) + side * 0.5 * track * RATE * t) / 0.05 / tick).floor() * tick * sign;
            time.iter().map(angle).collect::<Vec<f64>>()
        };
        let pose = |t: &f64| {
            let yaw = RATE * t;
            if is_hidden(*t) { [f64::NAN; 3] } else { [0.0, 0.0, yaw - TAU * (yaw / TAU).round()] }
        };
        let wheels = [wheel(-1.0, sign), wheel(1.0, 1.0)];
        let poses = time.iter().map(pose).collect();
        let drive = Drive::of_columns("a", &robot, time.clone(), (WheelData::Angle, &wheels), None, poses);
        let mut drive = drive.expect("a drive");
        unwrap_yaw(&mut drive, TAU);
        turn_while_unseen(&mut drive, &robot);
        (time, drive)
    }

    #[test]
    fn turns_that_were_made_while_the_pose_was_not_seen_are_counted_by_the_wheels() {
        for tick in [1e-6, 0.2] {
            let (time, drive) = turned(tick, 1.0);
            for (t, pose) in time.iter().zip(&drive.pose).filter(|(t, _)| !is_hidden(**t)) {
                approx::assert_relative_eq!(pose[2], RATE * t, epsilon = 1e-9);
            }
        }
    }

    #[test]
    fn wheels_that_do_not_turn_as_the_pose_does_count_no_turns() {
        // One of them runs backward: what it shows is no turning.
        let (time, drive) = turned(1e-6, -1.0);
        let after = time.iter().position(|t| *t >= 8.5).expect("a row");
        let nearest = drive.pose[after][2] - drive.pose[time.iter().position(|t| *t >= 5.0).expect("a row") - 1][2];
        assert!(nearest.abs() <= TAU / 2.0, "{nearest}");
    }
}
