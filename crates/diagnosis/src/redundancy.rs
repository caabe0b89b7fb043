//! Sensor faults that show without any force law: two sensors that tell the same thing differ.

use robot_model::effect::Redundancy;
use robot_model::{Card, effects};

use crate::motion::{GyroError, frozen_rows, integrated_yaw, pose_yaw};
use crate::run::Run;

/// A sensor fault found by redundancy.
#[derive(Debug, Clone)]
pub(crate) struct Fault {
    pub(crate) card: &'static Card,
    /// In the unit of the card, with sign.
    pub(crate) magnitude: f64,
    /// One sigma of it.
    pub(crate) sigma: f64,
    pub(crate) side: Option<usize>,
}

/// What all checks found.
#[derive(Debug, Clone, Default)]
pub(crate) struct Redundant {
    pub(crate) faults: Vec<Fault>,
    /// Correction of the gyro to apply before anything else.
    pub(crate) gyro: GyroError,
}

/// Yaw travel below which a gyro's scale cannot be told, rad.
const LEAST_TRAVEL: f64 = 3.0;
/// Smallest offset (rad/s) and scale error that are reported and corrected: the interest of their cards.
fn interest(kind: Redundancy) -> f64 {
    card(kind).map_or(f64::MAX, |c| c.interest)
}

fn card(kind: Redundancy) -> Option<&'static Card> {
    effects::catalogue::<f64>().iter().map(|e| e.card()).find(|c| c.redundancy == kind)
}

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

fn median(mut v: Vec<f64>) -> Option<(f64, f64)> {
    v.sort_by(f64::total_cmp);
    let m = *v.get(v.len() / 2)?;
    let m = if v.len().is_multiple_of(2) { 0.5 * (m + v[v.len() / 2 - 1]) } else { m };
    let spread = v.iter().map(|x| (x - m).powi(2)).sum::<f64>() / (v.len().max(2) - 1) as f64;
    Some((m, (spread / v.len() as f64).sqrt()))
}

/// Runs every force-free check.
pub(crate) fn check(runs: &[Run]) -> Redundant {
    let mut out = Redundant::default();
    let found: Vec<(f64, Option<f64>)> = runs.iter().filter_map(gyro_against_pose).collect();
    if let (Some(card), Some((scale, sigma))) =
        (card(Redundancy::GyroGain), median(found.iter().filter_map(|f| f.1).collect()))
        && scale.abs() > interest(Redundancy::GyroGain)
    {
        out.gyro.scale = scale;
        out.faults.push(Fault { card, magnitude: scale, sigma, side: None });
    }
    if let (Some(card), Some((bias, sigma))) =
        (card(Redundancy::GyroOffset), median(found.iter().map(|f| f.0).collect()))
        && bias.abs() > interest(Redundancy::GyroOffset)
    {
        out.gyro.bias = bias;
        out.faults.push(Fault { card, magnitude: bias, sigma, side: None });
    }
    if let Some(card) = card(Redundancy::FrozenAngle) {
        for side in 0..2 {
            let shares: Vec<f64> = runs
                .iter()
                .map(|r| frozen_rows(&r.angle[side]).iter().filter(|&&f| f).count() as f64 / r.rows() as f64)
                .collect();
            let share = shares.iter().sum::<f64>() / shares.len().max(1) as f64;
            if share > card.interest {
                let sigma = median(shares).map_or(0.0, |m| m.1);
                out.faults.push(Fault { card, magnitude: share, sigma, side: Some(side) });
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{PERIOD, driven, robot};

    /// Three runs of the plant whose gyro shows `(1 + scale) ω + bias`.
    fn runs(bias: f64, scale: f64) -> Vec<Run> {
        let mut run = driven(&robot(), &[], 20.0);
        for g in run.gyro.iter_mut().flatten() {
            *g = *g * (1.0 + scale) + bias;
        }
        vec![run; 3]
    }

    fn freeze(run: &mut Run, side: usize, every: usize, rows: usize) -> usize {
        let mut lost = 0;
        for first in (300..run.rows() - rows).step_by(every) {
            let held = run.angle[side][first];
            let speed =
                (run.angle[side][first + rows].zip(held)).map_or(0.0, |(b, a)| (b - a) / (rows as f64 * PERIOD));
            if speed.abs() > 2.0 {
                run.angle[side][first + 1..first + rows].fill(held);
                lost += rows - 1;
            }
        }
        lost
    }

    #[test]
    fn sound_sensors_have_no_fault() {
        let found = check(&runs(0.0, 0.0));
        assert!(found.faults.is_empty(), "{:?}", found.faults);
        assert_eq!(found.gyro, GyroError::default());
        assert!(check(&[]).faults.is_empty());
    }

    #[test]
    fn bias_and_scale_of_the_gyro_are_recovered() {
        for (bias, scale) in [(0.03, 0.0), (-0.02, 0.0), (0.0, 0.08), (0.04, -0.06)] {
            let found = check(&runs(bias, scale));
            approx::assert_abs_diff_eq!(found.gyro.bias, bias, epsilon = 1e-3);
            approx::assert_abs_diff_eq!(found.gyro.scale, scale, epsilon = 5e-3);
            let faults = usize::from(bias != 0.0) + usize::from(scale != 0.0);
            assert_eq!(found.faults.len(), faults, "{:?}", found.faults);
        }
    }

    #[test]
    fn without_a_pose_nothing_is_said_of_the_gyro() {
        let mut blind = runs(0.05, 0.0);
        for run in &mut blind {
            run.pose[2].fill(None);
        }
        assert!(check(&blind).faults.is_empty());
    }

    #[test]
    fn encoder_dropouts_are_found_with_their_side_and_share() {
        let mut dropped = runs(0.0, 0.0);
        let lost: usize = dropped.iter_mut().map(|r| freeze(r, 1, 60, 12)).sum();
        let share = lost as f64 / dropped.iter().map(Run::rows).sum::<usize>() as f64;
        let found = check(&dropped);
        assert_eq!(found.faults.len(), 1, "{:?}", found.faults);
        let fault = &found.faults[0];
        assert_eq!((fault.card.redundancy, fault.side), (Redundancy::FrozenAngle, Some(1)));
        approx::assert_relative_eq!(fault.magnitude, share, max_relative = 0.1);
    }
}
