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
