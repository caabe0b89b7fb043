//! Direct minimisation of pose errors: of the ends of drives by the geometry alone (OptiOdom: Sousa et al., J. Intell. Robot.
//! Syst. 105, 39, 2022, eq. 14), and of windows by the geometry and the pose's frame in the robot (Censi et al., IEEE Trans.
//! Robot. 29, 2013; Kümmerle et al. 2012).

use crate::constants::{Constant, Measured, Quantity, constants};
use crate::drive::Drive;
use crate::motion::{Laws, implied};
use crate::settings::SETTINGS;
use crate::wheel::WheeledRobot;
use crate::windows::{Window, laws, windows};
use inference::least_squares::{Constant as Free, Residuals, Settings};

/// The geometry that brings the ends of drives where they were measured.
pub(super) fn end_poses(robot: &WheeledRobot, drives: &[&Drive]) -> Option<Laws> {
    let whole = |drive: &Drive| {
        let seen: Vec<usize> = (0..drive.pose.len()).filter(|&k| drive.is_seen(k)).collect();
        let (from, to) = (*seen.first()?, *seen.last()?);
        let moved = crate::motion::relative(drive.pose[from], drive.pose[to]);
        Some(vec![Window::of_pose(from, to, moved)])
    };
    fitted(robot, drives, whole, |_| false)
}

/// Geometry and frame that bring windows where they were measured.
pub(super) fn with_frame(robot: &WheeledRobot, drives: &[&Drive]) -> Option<Laws> {
    let length = SETTINGS.windows.length;
    fitted(
        robot,
        drives,
        |drive| Some(windows(drive, length, length)),
        |quantity| matches!(quantity, Quantity::Mounting | Quantity::OriginX | Quantity::OriginY),
    )
}

fn fitted(
    robot: &WheeledRobot,
    drives: &[&Drive],
    windows: impl Fn(&Drive) -> Option<Vec<Window>>,
    also: impl Fn(Quantity) -> bool,
) -> Option<Laws> {
    let geometry = |c: &Constant| {
        matches!(
            c.quantity,
            Quantity::Radius(_) | Quantity::Across | Quantity::Reach | Quantity::Along | Quantity::SteeringOffset
        )
    };
    let mut free: Vec<Constant> =
        constants(robot, Measured::POSE).into_iter().filter(|c| geometry(c) || also(c.quantity)).collect();
    // Track and wheelbase of a mecanum robot act as one: one of them is fitted, as the publications do.
    if robot.has_rollers() && free.iter().any(|c| c.quantity == Quantity::Across) {
        free.retain(|c| c.quantity != Quantity::Along);
    }
    let windows: Vec<Vec<Window>> = drives.iter().map(|d| windows(d)).collect::<Option<_>>()?;
    let residuals = |theta: &[f64]| -> Vec<f64> {
        let laws = laws(robot, &free, theta);
        let of = |(drive, windows): (&&Drive, &Vec<Window>)| {
            let path = implied(robot, drive, &laws);
            windows.iter().flat_map(|w| w.error(&path)).collect::<Vec<f64>>()
        };
        drives.iter().zip(&windows).flat_map(of).collect()
    };
    let of = |c: &Constant| Free { longest: 2.0, ..Free::new(0.0, c.usual) };
    let fitted = Residuals::new(free.iter().map(of).collect(), residuals).fit(&Settings::default()).ok()?;
    Some(laws(robot, &free, &fitted.values))
}
