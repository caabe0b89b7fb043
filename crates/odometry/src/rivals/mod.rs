//! Classical calibrations of odometry, which forecast the same drives.

mod antonelli;
mod direct;
mod umbmark;

use crate::drive::Drive;
use crate::motion::Laws;
use crate::wheel::WheeledRobot;

/// A calibration from drives; `None` where it does not apply to the robot or the drives.
pub(crate) type Rival = fn(&WheeledRobot, &[&Drive]) -> Option<Laws>;

/// The calibrations by the names under which they are published.
pub(crate) const RIVALS: [(&str, Rival); 4] = [
    ("UMBmark (Borenstein & Feng 1996)", umbmark::calibrated),
    ("linear least squares (Antonelli et al. 2005)", antonelli::calibrated),
    ("end poses of drives (OptiOdom, Sousa et al. 2022)", direct::end_poses),
    ("windows with the pose's frame (Censi et al. 2013)", direct::with_frame),
];

/// The two wheels of a differential drive among the measured ones, left first, and its track; `None` of other robots.
pub(crate) fn differential(robot: &WheeledRobot) -> Option<(usize, usize, f64)> {
    let wheels: Vec<_> = robot.measured().into_iter().map(|k| &robot.wheels[k]).collect();
    let [a, b] = wheels.as_slice() else { return None };
    let plain = wheels.iter().all(|w| !w.steered && w.roller == 0.0 && w.direction == 0.0);
    let track = a.place[1] - b.place[1];
    (plain && track != 0.0).then(|| if track > 0.0 { (0, 1, track) } else { (1, 0, -track) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drive::WheelData;
    use crate::motion::implied;

    /// Two laps of a square of 1 m by a robot whose right wheel is larger and whose track is wider than stated by less than a per cent.
    fn squares(robot: &WheeledRobot, truth: &Laws, left: bool) -> Drive {
        let (side, corner) = (40, 40);
        let mut turns = vec![[0.0, 0.0]];
        let quarter = std::f64::consts::FRAC_PI_2 * 0.5 * 0.3 / 0.05 / f64::from(corner);
        for _ in 0..8 {
            // The controller believes the stated robot; it is the pose that shows the truth.
            turns.extend(vec![[1.0 / 0.05 / f64::from(side); 2]; side as usize]);
            let sign = if left { 1.0 } else { -1.0 };
            turns.extend(vec![[-sign * quarter, sign * quarter]; corner as usize]);
        }
        let time: Vec<f64> = (0..turns.len()).map(|k| 0.1 * k as f64).collect();
        let mut angles = [Vec::new(), Vec::new()];
        let mut sum = [0.0; 2];
        for turn in &turns {
            for k in 0..2 {
                sum[k] += turn[k];
                angles[k].push(sum[k]);
            }
        }
        let still = vec![[0.0; 3]; time.len()];
        let mut drive = Drive::new("square", robot, time, (WheelData::Angle, &angles), None, still).expect("a drive");
        drive.pose = implied(robot, &drive, truth);
        drive
    }

    #[test]
    fn classical_calibrations_of_a_differential_drive_find_ratio_and_track() {
        let robot = WheeledRobot::differential(0.05, 0.3);
        let mut truth = Laws::given(&robot);
        truth.geometry.radius[1] = 1.004;
        truth.geometry.across = 1.006;
        let drives = [squares(&robot, &truth, true), squares(&robot, &truth, false)];
        let drives: Vec<&Drive> = drives.iter().collect();
        for (name, rival) in RIVALS {
            let found = rival(&robot, &drives).unwrap_or_else(|| panic!("{name} does not apply"));
            let ratio = found.geometry.radius[1] / found.geometry.radius[0];
            approx::assert_abs_diff_eq!(ratio, 1.004, epsilon = 4e-4);
            // UMBmark keeps the mean radius, so that its track bears the mean's error.
            approx::assert_abs_diff_eq!(found.geometry.across, 1.006, epsilon = 3e-3);
        }
        let omni = WheeledRobot::omni_3(0.05, 0.2);
        assert!(umbmark::calibrated(&omni, &drives).is_none() && antonelli::calibrated(&omni, &drives).is_none());
    }
}
