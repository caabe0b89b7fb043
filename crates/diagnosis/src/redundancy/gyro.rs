//! The gyro against the pose heading: zero and gain.

use robot_model::effect::Redundancy;

use super::pool::median;
use super::{Fault, Redundant, card};
use crate::motion::{GyroError, integrated_yaw, pose_yaw};
use crate::run::Run;

/// Yaw travel below which a gyro's scale cannot be told, rad.
const LEAST_TRAVEL: f64 = 3.0;

/// Offset and scale of one run's gyro against the pose heading, by least squares:
/// `yaw_pose(t) = c + (∫gyro − b t)/(1 + s)`. The scale is `None` with too little travel.
fn gyro_against_pose(run: &Run) -> Option<(f64, Option<f64>)> {
    let turned = integrated_yaw(run, GyroError::default())?;
    let poses = pose_yaw(run);
    if poses.len() < 20 {
        return None;
    }
    let at = |k: usize| 0.5 * (turned[k] + turned[k.saturating_sub(1)]);
    let (first, last) = (poses[0], poses[poses.len() - 1]);
    let travel: f64 = poses.windows(2).map(|w| (w[1].1 - w[0].1).abs()).sum();
    let n = poses.len();
    let with_scale = travel > LEAST_TRAVEL && (last.0 > first.0);
    // ∫gyro = c' + (1 + s) yaw + b t
    let columns = if with_scale { 3 } else { 2 };
    let a = faer::Mat::from_fn(n, columns, |i, j| match j {
        0 => 1.0,
        1 => poses[i].0 as f64 * run.period,
        _ => poses[i].1,
    });
    let y = faer::Mat::from_fn(n, 1, |i, _| at(poses[i].0) - if with_scale { 0.0 } else { poses[i].1 });
    let m = a.transpose() * &a;
    let (x, _) = crate::linalg::solve_spd(&m, &(a.transpose() * &y))?;
    Some((x[(1, 0)], with_scale.then(|| x[(2, 0)] - 1.0)))
}

/// An error of the gyro with its sigma.
type Told = Option<(f64, f64)>;

/// Offset and scale over all runs, where they are beyond the interest of their cards.
fn pooled(runs: &[Run]) -> [Told; 2] {
    let found: Vec<(f64, Option<f64>)> = runs.iter().filter_map(gyro_against_pose).collect();
    let beyond = |kind: Redundancy, all: Vec<f64>| {
        median(all).filter(|m| m.0.abs() > card(kind).map_or(f64::MAX, |c| c.interest))
    };
    [
        beyond(Redundancy::GyroOffset, found.iter().map(|f| f.0).collect()),
        beyond(Redundancy::GyroGain, found.iter().filter_map(|f| f.1).collect()),
    ]
}

/// What is to be corrected in the gyro of these runs.
pub(super) fn errors(runs: &[Run]) -> GyroError {
    let [bias, scale] = pooled(runs).map(|m| m.map_or(0.0, |m| m.0));
    GyroError { bias, scale }
}

/// Zero and gain: corrected as they are, told as far as the references do not show them.
pub(super) fn check(runs: &[Run], references: &[Run], out: &mut Redundant) {
    let [bias, scale] = pooled(runs);
    let known = errors(references);
    out.gyro = GyroError { bias: bias.map_or(0.0, |m| m.0), scale: scale.map_or(0.0, |m| m.0) };
    for (kind, own, told) in [(Redundancy::GyroGain, known.scale, scale), (Redundancy::GyroOffset, known.bias, bias)] {
        if let (Some(card), Some((value, sigma))) = (card(kind), told)
            && (value - own).abs() > card.interest
        {
            out.faults.push(Fault { card, parameter: 0, magnitude: value - own, sigma, side: None });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::check;
    use super::*;
    use crate::testing::{driven, robot};

    /// Three runs of the plant whose gyro shows `(1 + scale) ω + bias`.
    fn runs(bias: f64, scale: f64) -> Vec<Run> {
        let mut run = driven(&robot(), &[], 20.0);
        for g in run.gyro.iter_mut().flatten() {
            *g = *g * (1.0 + scale) + bias;
        }
        vec![run; 3]
    }

    #[test]
    fn sound_sensors_have_no_fault() {
        let sound = runs(0.0, 0.0);
        for references in [&sound[..], &[]] {
            let found = check(&sound, references);
            assert!(found.faults.is_empty(), "{:?}", found.faults);
            assert_eq!(found.gyro, GyroError::default());
        }
        assert!(check(&[], &sound).faults.is_empty());
        assert!(check(&[], &[]).faults.is_empty());
    }

    #[test]
    fn bias_and_scale_of_the_gyro_are_recovered() {
        for (bias, scale) in [(0.03, 0.0), (-0.02, 0.0), (0.0, 0.08), (0.04, -0.06)] {
            let found = check(&runs(bias, scale), &runs(0.0, 0.0));
            approx::assert_abs_diff_eq!(found.gyro.bias, bias, epsilon = 1e-3);
            approx::assert_abs_diff_eq!(found.gyro.scale, scale, epsilon = 5e-3);
            let faults = usize::from(bias != 0.0) + usize::from(scale != 0.0);
            assert_eq!(found.faults.len(), faults, "{:?}", found.faults);
        }
    }

    #[test]
    fn what_the_references_show_too_is_corrected_and_not_told() {
        let found = check(&runs(0.03, 0.0), &runs(0.03, 0.0));
        assert!(found.faults.is_empty(), "{:?}", found.faults);
        approx::assert_abs_diff_eq!(found.gyro.bias, 0.03, epsilon = 1e-3);
        let found = check(&runs(0.05, 0.0), &runs(0.02, 0.0));
        approx::assert_abs_diff_eq!(found.faults[0].magnitude, 0.03, epsilon = 1e-3);
        approx::assert_abs_diff_eq!(found.gyro.bias, 0.05, epsilon = 1e-3);
    }

    #[test]
    fn without_a_pose_nothing_is_said_of_the_gyro() {
        let mut blind = runs(0.05, 0.0);
        for run in &mut blind {
            run.pose[2].fill(None);
        }
        assert!(check(&blind, &runs(0.0, 0.0)).faults.is_empty());
    }
}
