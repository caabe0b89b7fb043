//! Free runs on recordings that were not fitted: as it is, re-tuned, corrected, and a placebo.

use std::sync::Arc;

use robot_model::tunable::COUNT as NUISANCES;

use crate::calibrate::problem;
use crate::decide::Scored;
use crate::fit::{Columns, Fitted, Hypothesis, Point, Problem};
use crate::judged::Judged;
use crate::rms::rms;
use crate::simulate::Response;
use crate::windows::Cut;
use verdict::FreeRun;

/// Gauss–Newton steps of a placebo, from where its own fit ended.
const PLACEBO_STEPS: usize = 2;

/// A recording's best point without it in the fit.
pub(crate) struct LeftOut {
    pub(crate) run: usize,
    /// Corrected, or re-tuned when there is nothing to correct with.
    pub(crate) point: Point,
}

/// What was simulated for a recording: windows by segment.
pub(crate) struct Simulated {
    /// Whether the fits behind `retuned` and `corrected` left it out.
    pub(crate) left_out: bool,
    pub(crate) nominal: Vec<Vec<f64>>,
    pub(crate) retuned: Vec<Vec<f64>>,
    pub(crate) corrected: Option<Vec<Vec<f64>>>,
}

/// Free runs on recordings that were left out of the fit.
pub(crate) struct Forecasts {
    pub(crate) free_runs: Vec<FreeRun>,
    /// The points behind them.
    pub(crate) left_out: Vec<LeftOut>,
    /// One for each recording.
    pub(crate) simulated: Vec<Simulated>,
}

/// Free runs on each recording, fitted on the others only. A lone recording cannot be left out: it is simulated as fitted.
pub(crate) fn leave_one_out(answer: &Judged<'_>, retuned: &Fitted) -> Forecasts {
    let p = answer.problem;
    let none = Hypothesis::default();
    let nominal = Point { theta: [0.0; NUISANCES], ..p.origin() };
    if p.cuts.len() < 2 {
        let simulated = (0..p.cuts.len()).map(|run| Simulated {
            left_out: false,
            nominal: p.run_response(run, &nominal, &none),
            retuned: retuned.response[run].clone(),
            corrected: answer.winner().map(|w| w.trial.fitted.response[run].clone()),
        });
        return Forecasts { free_runs: Vec::new(), left_out: Vec::new(), simulated: simulated.collect() };
    }
    let wrong = placebo(answer);
    let mut out = Vec::new();
    let mut points = Vec::new();
    let mut simulated = Vec::new();
    for left_out in 0..p.cuts.len() {
        let cuts: Vec<Cut> = (0..p.cuts.len()).filter(|&r| r != left_out).map(|r| p.cuts[r].clone()).collect();
        let others = problem(p.robot, answer.case, &cuts, answer.calibration, p.largest_torque, answer.options);
        let retuned = others.refine(&none, others.begin(&none, others.origin(), None), 3, None);
        let elsewhere = |f: &Fitted| Point { theta: f.point.theta, effects: f.point.effects.clone(), ..p.origin() };
        let run = |point: &Point, h: &Hypothesis| p.run_response(left_out, point, h);
        let error = |response: &Vec<Vec<f64>>| rms(p, &[(left_out, response.clone())]);
        let refit = |s: &Scored, theta: [f64; NUISANCES], columns: Option<Arc<Columns>>, steps: usize| {
            let h = without(&s.trial.hypothesis, left_out);
            let start = Point { theta, effects: s.trial.fitted.point.effects.clone(), ..others.origin() };
            elsewhere(&others.refine(&h, others.begin(&h, start, columns), steps, None))
        };
        let corrected = answer.winner().map(|w| (refit(w, others.centre, None, 3), &w.trial.hypothesis));
        // The placebo's tuning has seen the left-out recording: if anything, that flatters it.
        let placebo = wrong.map(|s| {
            let point = refit(s, s.trial.fitted.point.theta, Some(retuned.columns.clone()), PLACEBO_STEPS);
            error(&run(&point, &s.trial.hypothesis))
        });
        let retuned = elsewhere(&retuned);
        let shown = Simulated {
            left_out: true,
            nominal: run(&nominal, &none),
            retuned: run(&retuned, &none),
            corrected: corrected.as_ref().map(|(point, h)| run(point, h)),
        };
        let (a, b) = (error(&shown.nominal), error(&shown.retuned));
        let c = shown.corrected.as_ref().map_or(b, error);
        simulated.push(shown);
        for (i, quantity) in ["wheel speed, rad/s", "yaw rate, rad/s"].into_iter().enumerate() {
            out.push(FreeRun {
                recording: p.cuts[left_out].name.clone(),
                quantity: quantity.to_owned(),
                nominal: a[i],
                retuned: b[i],
                corrected: c[i],
                placebo: placebo.map(|d| d[i]),
            });
        }
        points.push(LeftOut { run: left_out, point: corrected.map_or(retuned, |c| c.0) });
    }
    Forecasts { free_runs: out, left_out: points, simulated }
}

/// Whether the correction (or re-tuning, without one) forecasts recordings that were left out of its fit no worse than the
/// calibrated model does, all recordings and both quantities together.
pub(crate) fn is_worthwhile(p: &Problem<'_>, calibrated: &Response, runs: &[FreeRun]) -> bool {
    let before = (0..p.cuts.len()).flat_map(|r| rms(p, &[(r, calibrated[r].clone())]));
    let change: f64 = runs.iter().zip(before).map(|(f, before)| (f.corrected / before.max(1e-9)).ln()).sum();
    change.is_nan() || change <= 0.0
}

/// The hypothesis for all recordings but one.
fn without(h: &Hypothesis, left_out: usize) -> Hypothesis {
    let mut h = h.clone();
    for (_, onsets) in h.parts.iter_mut().filter(|(_, o)| !o.is_empty()) {
        onsets.remove(left_out);
    }
    h
}

/// The best hypothesis that shares no effect with the winner and is no larger.
fn placebo<'a>(answer: &'a Judged<'_>) -> Option<&'a Scored> {
    let winner = answer.winner()?.trial.hypothesis.ids();
    let shared = |s: &Scored| s.trial.hypothesis.ids().iter().any(|id| winner.contains(id));
    let all = answer.decision.scored.iter();
    all.filter(|s| s.trial.hypothesis.parts.len() <= winner.len() && !shared(s))
        .max_by(|a, b| a.score.total_cmp(&b.score))
}
