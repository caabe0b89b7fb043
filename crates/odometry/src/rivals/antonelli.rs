//! Linear least squares of a differential drive: Antonelli, Chiaverini & Fusco, "A calibration method for odometry of mobile
//! robots based on the least-squares technique", IEEE Trans. Robot. 21 (2005), eqs. 9 to 18: first headings give the radii over
//! the track, then positions the track. Applied to consecutive windows of ten seconds as the trajectories.

use crate::drive::Drive;
use crate::motion::{Laws, relative};
use crate::rivals::differential;
use crate::settings::SETTINGS;
use crate::wheel::WheeledRobot;
use crate::windows::windows;

/// Radii and track from all windows; `None` of other robots, or where nothing turns.
pub(super) fn calibrated(robot: &WheeledRobot, drives: &[&Drive]) -> Option<Laws> {
    let (left, right, track) = differential(robot)?;
    let length = SETTINGS.forecast.lengths[1];
    let spans = || drives.iter().flat_map(|d| windows(d, length, length).into_iter().map(move |w| (*d, w)));

    // Headings: Δθ = c_R Σ q_R − c_L Σ q_L.
    let (mut normal, mut slope) = (nalgebra::Matrix2::zeros(), nalgebra::Vector2::zeros());
    for (drive, window) in spans() {
        let sum = |wheel: usize| drive.turns[window.from + 1..=window.to].iter().map(|t| t[wheel]).sum::<f64>();
        let row = nalgebra::Vector2::new(sum(right), -sum(left));
        normal += row * row.transpose();
        slope += row * window.moved[2];
    }
    let per_track = normal.try_inverse()? * slope;

    // Positions: linear in the track, with the headings of the first step.
    let (mut squares, mut products) = (0.0, 0.0);
    for (drive, window) in spans() {
        let (mut heading, mut at) = (0.0, [0.0, 0.0, 0.0]);
        for turn in &drive.turns[window.from + 1..=window.to] {
            let turned = per_track[0] * turn[right] - per_track[1] * turn[left];
            let way = 0.5 * (per_track[0] * turn[right] + per_track[1] * turn[left]);
            let (sin, cos) = (heading + 0.5 * turned).sin_cos();
            at = [at[0] + way * cos, at[1] + way * sin, 0.0];
            heading += turned;
        }
        let regressor = relative([0.0; 3], at);
        for axis in 0..2 {
            squares += regressor[axis] * regressor[axis];
            products += regressor[axis] * window.moved[axis];
        }
    }
    let found = products / squares;
    if !(found.is_finite() && found > 0.0) {
        return None;
    }
    let radius = |wheel: usize, c: f64| c * found / robot.wheels[robot.measured()[wheel]].radius;
    let mut out = Laws::given(robot);
    out.geometry.across = found / track;
    out.geometry.radius[right] = radius(right, per_track[0]);
    out.geometry.radius[left] = radius(left, per_track[1]);
    Some(out)
}
