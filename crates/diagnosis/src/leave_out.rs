//! Free runs on recordings that were not fitted.

use robot_model::tunable::COUNT as NUISANCES;

use crate::answer::Answer;
use crate::diagnose::problem;
use crate::fit::{Hypothesis, Point};
use crate::locate;
use crate::verdict::FreeRun;
use crate::windows::Cut;

/// Free runs on each recording, fitted on the others only.
pub(crate) fn leave_one_out(answer: &Answer<'_>) -> Vec<FreeRun> {
    let p = answer.problem;
    if p.cuts.len() < 2 {
        return Vec::new();
    }
    let none = Hypothesis::default();
    let nominal = Point { theta: [0.0; NUISANCES], ..p.origin() };
    let as_is = p.response(&nominal, &none);
    let mut out = Vec::new();
    for left_out in 0..p.cuts.len() {
        let cuts: Vec<Cut> = (0..p.cuts.len()).filter(|&r| r != left_out).map(|r| p.cuts[r].clone()).collect();
        let others = problem(p.robot, answer.case, &cuts, answer.calibration, p.largest_torque, answer.options);
        let retuned = others.refine(&none, others.begin(&none, others.origin(), None), 3, None);
        let mut point = p.origin();
        point.theta = retuned.point.theta;
        let retuned_response = p.response(&point, &none);
        let corrected_response = answer.winner().map(|w| {
            let mut h = w.trial.hypothesis.clone();
            for (_, onsets) in &mut h.parts {
                if !onsets.is_empty() {
                    onsets.remove(left_out);
                }
            }
            let start = Point { effects: w.trial.fitted.point.effects.clone(), ..others.origin() };
            let fitted = others.refine(&h, others.begin(&h, start, None), 3, None);
            let mut point = p.origin();
            point.theta = fitted.point.theta;
            point.effects = fitted.point.effects;
            p.response(&point, &w.trial.hypothesis)
        });
        let of = |r| locate::rms(p, r, left_out);
        let (a, b) = (of(&as_is), of(&retuned_response));
        let c = corrected_response.as_ref().map_or(b, of);
        for (i, quantity) in ["wheel speed, rad/s", "yaw rate, rad/s"].into_iter().enumerate() {
            out.push(FreeRun {
                recording: p.cuts[left_out].name.clone(),
                quantity: quantity.to_owned(),
                nominal: a[i],
                retuned: b[i],
                corrected: c[i],
            });
        }
    }
    out
}
