//! The gyro against the pose heading: zero and gain.

use robot_model::EffectSpec;
use robot_model::effect::Redundancy;

use super::pool::{Measured, alone, beyond, least_squares};
use super::{Fault, Redundant, spec};
use crate::motion::{GyroError, integrated_yaw, pose_yaw};
use crate::run::Run;
use crate::settings::redundancy::{Gyro, SETTINGS};

const GYRO: Gyro = SETTINGS.gyro;

/// Offset and scale of one run's gyro against the pose heading, by least squares:
/// `∫gyro = c + b t + (1 + s) yaw_pose(t)`. The scale is `None` with too little travel.
fn gyro_against_pose(run: &Run) -> Option<[Option<Measured>; 2]> {
    let turned = integrated_yaw(run, GyroError::default())?;
    let poses = pose_yaw(run);
    if poses.len() < GYRO.least_poses {
        return None;
    }
    let at = |k: usize| 0.5 * (turned[k] + turned[k.saturating_sub(1)]);
    let travel: f64 = poses.windows(2).map(|w| (w[1].1 - w[0].1).abs()).sum();
    let time = |k: usize| k as f64 * run.period;
    if travel > GYRO.least_travel {
        let rows: Vec<_> = poses.iter().map(|&(k, yaw)| ([1.0, time(k), yaw], at(k) - yaw)).collect();
        let [_, bias, scale] = least_squares(&rows, GYRO.alike)?;
        Some([Some(bias), Some(scale)])
    } else {
        let rows: Vec<_> = poses.iter().map(|&(k, yaw)| ([1.0, time(k)], at(k) - yaw)).collect();
        let [_, bias] = least_squares(&rows, GYRO.alike)?;
        Some([Some(bias), None])
    }
}

/// The errors of the gyro that can be checked, and what each run says of them.
type GyroErrors = [(Redundancy, Vec<Option<Measured>>); 2];

fn found(runs: &[Run]) -> GyroErrors {
    let all: Vec<[Option<Measured>; 2]> = runs.iter().filter_map(gyro_against_pose).collect();
    [
        (Redundancy::GyroOffset, all.iter().map(|m| m[0]).collect()),
        (Redundancy::GyroGain, all.iter().map(|m| m[1]).collect()),
    ]
}

/// The error over all runs, if it matters and is sure.
fn pooled(spec: &EffectSpec, runs: &[Option<Measured>]) -> Option<Measured> {
    alone(runs, spec.interest).filter(|m| m.is_reportable(spec.interest))
}

/// What is to be corrected in the gyro of these runs.
pub(super) fn errors(runs: &[Run]) -> GyroError {
    let [bias, scale] =
        found(runs).map(|(kind, all)| spec(kind).and_then(|c| pooled(c, &all)).map_or(0.0, |m| m.value));
    GyroError { bias, scale }
}

/// Zero and gain: corrected as they are, told as far as the references do not show them.
pub(super) fn check(runs: &[Run], references: &[Run], out: &mut Redundant) {
    out.gyro = errors(runs);
    let known = errors(references);
    let [bias, scale] = found(runs);
    let [known_bias, known_scale] = found(references);
    for ((kind, all), (_, before), own) in [(scale, known_scale, known.scale), (bias, known_bias, known.bias)] {
        let Some(spec) = spec(kind) else { continue };
        let Some(here) = pooled(spec, &all) else { continue };
        // References that say nothing of it are no reason to doubt what the runs show.
        let sure = beyond(&all, &before, spec.interest).is_none_or(|m| m.is_reportable(spec.interest));
        let magnitude = here.value - own;
        if sure && magnitude.abs() > spec.interest {
            out.faults.push(Fault::new((spec, 0), Measured { value: magnitude, ..here }, None));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::check;
    use super::*;
    use crate::testing::driven;
    use testing::robot;

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
            let found = check(&sound, references, None);
            assert!(found.faults.is_empty(), "{:?}", found.faults);
            assert_eq!(found.gyro, GyroError::default());
        }
        assert!(check(&[], &sound, None).faults.is_empty());
        assert!(check(&[], &[], None).faults.is_empty());
    }

    #[test]
    fn bias_and_scale_of_the_gyro_are_recovered() {
        for (bias, scale) in [(0.03, 0.0), (-0.02, 0.0), (0.0, 0.08), (0.04, -0.06)] {
            let found = check(&runs(bias, scale), &runs(0.0, 0.0), None);
            approx::assert_abs_diff_eq!(found.gyro.bias, bias, epsilon = 1e-3);
            approx::assert_abs_diff_eq!(found.gyro.scale, scale, epsilon = 5e-3);
            let faults = usize::from(bias != 0.0) + usize::from(scale != 0.0);
            assert_eq!(found.faults.len(), faults, "{:?}", found.faults);
        }
    }

    #[test]
    fn what_the_references_show_too_is_corrected_and_not_told() {
        let found = check(&runs(0.03, 0.0), &runs(0.03, 0.0), None);
        assert!(found.faults.is_empty(), "{:?}", found.faults);
        approx::assert_abs_diff_eq!(found.gyro.bias, 0.03, epsilon = 1e-3);
        let found = check(&runs(0.05, 0.0), &runs(0.02, 0.0), None);
        approx::assert_abs_diff_eq!(found.faults[0].magnitude, 0.03, epsilon = 1e-3);
        approx::assert_abs_diff_eq!(found.gyro.bias, 0.05, epsilon = 1e-3);
    }

    #[test]
    fn without_a_pose_nothing_is_said_of_the_gyro() {
        let mut blind = runs(0.05, 0.0);
        for run in &mut blind {
            run.pose[2].fill(None);
        }
        assert!(check(&blind, &runs(0.0, 0.0), None).faults.is_empty());
    }
}
