//! The wheel angle against its own rate: frozen, and jumping.

use robot_model::effect::Redundancy;

use super::pool::{Measured, median};
use super::{FAULTS, Fault, spec};
use crate::motion::frozen_rows;
use crate::run::Run;
use crate::settings::redundancy::{Jumps, SETTINGS};

const JUMPS: Jumps = SETTINGS.jumps;

/// Share of rows with a frozen angle, beyond what the references show.
pub(super) fn frozen(runs: &[Run], references: &[Run], out: &mut Vec<Fault>) {
    let Some(spec) = spec(Redundancy::FrozenAngle) else { return };
    for side in 0..2 {
        let shares = |runs: &[Run]| -> Vec<f64> {
            runs.iter()
                .map(|r| frozen_rows(&r.angle[side]).iter().filter(|&&f| f).count() as f64 / r.rows() as f64)
                .collect()
        };
        let mean = |shares: &[f64]| shares.iter().sum::<f64>() / shares.len().max(1) as f64;
        let here = shares(runs);
        let share = mean(&here) - mean(&shares(references));
        if share > spec.interest {
            let sigma = median(&here).map_or(0.0, |m| m.1);
            out.push(Fault::new((spec, 0), Measured { value: share, sigma }, Some(side)));
        }
    }
}

/// Rows before which the angle jumps by more than `least`, with the jump: a step unlike those before and after, which
/// agree with each other. A wheel cannot take up and lose that speed again within a row; an angle that freezes and
/// jumps, or a sample that is wrong, does not leave its neighbours as they were.
pub(super) fn jumps_of(angle: &[Option<f64>], least: f64) -> Vec<(usize, f64)> {
    let (around, beside) = (JUMPS.around, JUMPS.beside);
    let steps: Vec<Option<f64>> = angle.windows(2).map(|w| Some(w[1]? - w[0]?)).collect();
    (around..steps.len().saturating_sub(around))
        .filter_map(|k| {
            let step = steps[k]?;
            let mut near: Vec<f64> =
                (k - around..=k + around).filter(|&i| i != k).map(|i| steps[i]).collect::<Option<_>>()?;
            let nearest = near[around - beside..around + beside].to_vec();
            near.sort_by(f64::total_cmp);
            let usual = 0.5 * (near[around - 1] + near[around]);
            // A wheel that seems to stand before it jumps is a frozen angle's.
            let moving = nearest[..beside].iter().all(|s| *s != 0.0);
            let steady = moving && nearest.iter().all(|s| (s - usual).abs() < JUMPS.steady * least);
            (steady && (step - usual).abs() > least).then_some((k + 1, step - usual))
        })
        .collect()
}

/// Jumps of the angle that the references do not have.
pub(super) fn jumps(runs: &[Run], references: &[Run], out: &mut Vec<Fault>) {
    let Some(spec) = spec(Redundancy::JumpingAngle).filter(|_| !references.is_empty()) else { return };
    for side in 0..2 {
        let found = |runs: &[Run]| -> Vec<f64> {
            runs.iter().flat_map(|r| jumps_of(&r.angle[side], spec.interest)).map(|j| j.1).collect()
        };
        let (here, there) = (found(runs), found(references));
        // Counts per run, with the spread of rare events.
        let (n, m) = (runs.len().max(1) as f64, references.len() as f64);
        let more = here.len() as f64 / n - there.len() as f64 / m;
        if more > JUMPS.sure * (there.len() as f64).sqrt() / m
            && let Some((magnitude, sigma)) = median(&here)
        {
            // Nothing else makes an angle jump between steps that agree.
            let jump = Fault::new((spec, 0), Measured { value: magnitude, sigma }, Some(side));
            out.push(Fault { probability: FAULTS.surest, ..jump });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::check;
    use super::*;
    use crate::testing::driven;
    use testing::{PERIOD, robot};

    fn runs() -> Vec<Run> {
        vec![driven(&robot(), &[], 20.0); 3]
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
    fn encoder_dropouts_are_found_with_their_side_and_share() {
        for rows in [5, 12] {
            let mut dropped = runs();
            let lost: usize = dropped.iter_mut().map(|r| freeze(r, 1, 60, rows)).sum();
            let share = lost as f64 / dropped.iter().map(Run::rows).sum::<usize>() as f64;
            let found = check(&dropped, &runs(), None);
            assert_eq!(found.faults.len(), 1, "{:?}", found.faults);
            let fault = &found.faults[0];
            assert_eq!((fault.spec.redundancy, fault.side), (Redundancy::FrozenAngle, Some(1)));
            approx::assert_relative_eq!(fault.magnitude, share, max_relative = 0.1);
        }
    }

    #[test]
    fn an_index_that_slips_once_is_found_with_its_size() {
        for jump in [-0.4, 0.1, 6.3] {
            let mut slipped = runs();
            for a in slipped[1].angle[0].iter_mut().skip(1234).flatten() {
                *a += jump;
            }
            let found = check(&slipped, &runs(), None).faults;
            assert_eq!(found.len(), 1, "{found:?}");
            assert_eq!((found[0].spec.redundancy, found[0].side), (Redundancy::JumpingAngle, Some(0)));
            approx::assert_abs_diff_eq!(found[0].magnitude, jump, epsilon = 0.01);
            // The references do the same: nothing is missing.
            assert!(check(&slipped, &slipped, None).faults.is_empty());
        }
    }

    #[test]
    fn a_wrong_sample_and_a_gap_are_no_jump() {
        let mut noisy = runs();
        let angle = &mut noisy[0].angle[0];
        angle[700] = angle[700].map(|a| a + 0.5);
        angle[900..903].fill(None);
        assert!(jumps_of(angle, 0.05).is_empty());
    }
}
