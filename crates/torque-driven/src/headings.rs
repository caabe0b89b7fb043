//! Where recordings without a pose head.
//!
//! A gyro says how far a robot has turned since a recording began, not where it headed then. A slope is one direction for all
//! recordings: where several show one, each by its own drive, they are turned until these directions are the same.

use std::f64::consts::TAU;

use faer::Mat;
use inference::algebra::{select, solve_spd};
use inference::hypothesis::{Onsets, Place, Variant};
use robot_model::tunable::COUNT as NUISANCES;

use crate::fit::{Fitted, Hypothesis, Point, Problem};
use crate::run::Run;
use crate::settings::preparation::{Headings, SETTINGS};
use crate::windows::Cut;
use verdict::Diagnosis;

const RULES: Headings = SETTINGS.headings;

/// By how much each recording is to be turned to the left so that the slopes that they show agree, rad.
pub(crate) fn turns(problem: &Problem<'_>, runs: &[Run]) -> Vec<f64> {
    let sound = vec![0.0; runs.len()];
    let heads = |run: &Run| run.pose[2].iter().any(Option::is_some);
    if runs.len() < 2 || runs.iter().all(heads) {
        return sound;
    }
    let Some(slopes) = slopes(problem) else { return sound };

    // One with a pose says where the slope falls; without any the first one does.
    let shown = |k: &usize| slopes[*k].is_some();
    let first = (0..runs.len()).filter(shown).min_by_key(|k| !heads(&runs[*k]));
    let Some(falls) = first.and_then(|k| slopes[k]) else { return sound };
    let turn = |(slope, run): (Option<f64>, &Run)| match slope {
        Some(own) if !heads(run) => falls - own - TAU * ((falls - own) / TAU).round(),
        _ => 0.0,
    };
    let turns: Vec<f64> = slopes.into_iter().zip(runs).map(turn).collect();
    // Drives that begin alike are left as they are.
    turns.into_iter().map(|turn| if turn.abs() > RULES.least { turn } else { 0.0 }).collect()
}

/// Direction in which the ground falls in each run by itself, rad, where it shows that it does.
fn slopes(problem: &Problem<'_>) -> Option<Vec<Option<f64>>> {
    let is_slope = |v: &Variant| v.spec().id == "grade" && v.place == Place::Whole;
    let slope = Hypothesis::single(problem.variants().into_iter().find(is_slope)?, Onsets::default());
    let none = Hypothesis::default();
    let Fitted { point, response, .. } = problem.begin(&none, problem.origin(), None);
    let constants = problem.nuisance_columns(&point, &none, &response);
    let level = Point { effects: vec![0.0; 2], ..point.clone() };
    let columns = problem.effect_columns(&level, &slope, &response);
    let of_run = |run: usize| {
        let mut normal = problem.normal_of_run(&point, &response, &constants, &columns, run)?;
        problem.with_prior(&point, &mut normal);
        let falls = [NUISANCES, NUISANCES + 1];
        let covariance = select(&normal.covariance()?, &falls);
        let (step, _) = solve_spd(&normal.matrix, &normal.gradient)?;
        let fall = Mat::from_fn(2, 1, |i, _| step[(falls[i], 0)]);
        let (weighed, _) = solve_spd(&covariance, &fall)?;
        let square = fall[(0, 0)] * weighed[(0, 0)] + fall[(1, 0)] * weighed[(1, 0)];
        (square > RULES.sure * RULES.sure).then(|| fall[(1, 0)].atan2(fall[(0, 0)]))
    };
    Some((0..problem.cuts.len()).map(of_run).collect())
}

/// Turns recordings.
pub(crate) fn turn(cuts: &mut [Cut], turns: &[f64]) {
    for (cut, turn) in cuts.iter_mut().zip(turns) {
        cut.segments.iter_mut().for_each(|segment| segment.start.yaw += turn);
        cut.path.iter_mut().for_each(|place| place[2] += turn);
    }
}

/// Whether a slope is told, or may be what is.
pub(crate) fn is_slope(answer: &Diagnosis) -> bool {
    answer.ranked.iter().any(|cause| cause.effect == "grade" && cause.probability > 0.5)
}

/// What was done, where anything was.
pub(crate) fn sentence(cuts: &[Cut], turns: &[f64]) -> Option<String> {
    let turned = cuts.iter().zip(turns).filter(|(_, turn)| **turn != 0.0);
    let told: Vec<String> = turned
        .map(|(cut, turn)| {
            let way = if *turn > 0.0 { "left" } else { "right" };
            format!("'{}' is turned by {:.0}° to the {way}", cut.name, turn.to_degrees().abs())
        })
        .collect();
    (!told.is_empty()).then(|| {
        format!(
            "no pose says where these recordings head: {}, so that the slopes that they show agree; the direction of the slope \
             counts from where the recordings head that are not turned",
            told.join(", ")
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{cutting, driven, problem};
    use crate::windows::cut;
    use inference::hypothesis::Dose;
    use robot_model::{Presence, effects};
    use testing::robot;

    /// Drives over ground that falls by four degrees in these directions of each, without their poses.
    fn runs(falls: &[f64]) -> Vec<Run> {
        let run = |(k, falls): (usize, &f64)| {
            let values = vec![0.07 * falls.cos(), 0.07 * falls.sin()];
            let slope = Dose { effect: &effects::grade::Law, values, presence: Presence::default() };
            let mut run = driven(&robot(), &[slope], 16.0 + 2.0 * k as f64);
            run.pose.iter_mut().flatten().for_each(|pose| *pose = None);
            run
        };
        falls.iter().enumerate().map(run).collect()
    }

    fn turns_of(runs: &[Run]) -> Vec<f64> {
        let robot = robot();
        let cuts: Vec<Cut> = runs.iter().map(|run| cut(run, &cutting())).collect();
        turns(&problem(&robot, &cuts), runs)
    }

    #[test]
    fn recordings_without_a_pose_are_turned_until_the_slopes_that_they_show_agree() {
        let turns = turns_of(&runs(&[0.3, 2.5, -1.4]));
        assert_eq!(turns[0], 0.0);
        approx::assert_abs_diff_eq!(turns[1], 0.3 - 2.5, epsilon = 0.1);
        approx::assert_abs_diff_eq!(turns[2], 0.3 + 1.4, epsilon = 0.1);

        let all = runs(&[0.3, 2.5]);
        let mut cuts: Vec<Cut> = all.iter().map(|run| cut(run, &cutting())).collect();
        let before = cuts[1].segments[2].start.yaw;
        turn(&mut cuts, &turns);
        approx::assert_abs_diff_eq!(cuts[1].segments[2].start.yaw - before, turns[1], epsilon = 1e-12);
        let told = sentence(&cuts, &turns).expect("a sentence");
        assert!(told.contains("is turned by 12") && told.contains("° to the right"), "{told}");
    }

    #[test]
    fn recordings_that_begin_alike_that_show_no_slope_or_that_have_a_pose_are_left_as_they_are() {
        assert_eq!(turns_of(&runs(&[0.3, 0.3])), [0.0; 2]);
        let level = [16.0, 18.0].map(|seconds| driven(&robot(), &[], seconds));
        let mut blind = level.clone();
        blind.iter_mut().flat_map(|run| &mut run.pose).flatten().for_each(|pose| *pose = None);
        assert_eq!(turns_of(&blind), [0.0; 2]);
        assert_eq!(turns_of(&level), [0.0; 2]);
        assert_eq!(sentence(&[], &[]), None);

        // The one with a pose says where the ground falls.
        let mut runs = runs(&[0.3, 2.5]);
        let slope = Dose {
            effect: &effects::grade::Law,
            values: vec![0.07 * 2.5_f64.cos(), 0.07 * 2.5_f64.sin()],
            presence: Presence::default(),
        };
        runs[1] = driven(&robot(), &[slope], 18.0);
        let turns = turns_of(&runs);
        approx::assert_abs_diff_eq!(turns[0], 2.5 - 0.3, epsilon = 0.1);
        assert_eq!(turns[1], 0.0);
    }

    #[test]
    fn recordings_stay_turned_only_where_a_slope_is_likelier_than_not() {
        let told = |effect: &str, probability| {
            let mut answer = Diagnosis::withheld();
            answer.ranked = vec![verdict::Cause::plain(effect, effect, probability)];
            is_slope(&answer)
        };
        assert!(told("grade", 0.9) && !told("grade", 0.3) && !told("payload", 0.9));
    }
}
