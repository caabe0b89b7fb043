//! Free runs on recordings that were not fitted: as it is, re-tuned, corrected, and a placebo.

use std::sync::Arc;

use robot_model::tunable::COUNT as NUISANCES;

use crate::calibrate::problem;
use crate::decide::Scored;
use crate::fit::{Columns, Fitted, Hypothesis, Point, Problem};
use crate::judged::Judged;
use crate::rms::rms;
use crate::settings::decision::{LeaveOut, SETTINGS};
use crate::simulate::Response;
use crate::windows::Cut;
use verdict::FreeRun;

const LEAVE_OUT: LeaveOut = SETTINGS.leave_out;

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
        let retuned = others.refine(&none, others.begin(&none, others.origin(), None), LEAVE_OUT.steps, None);
        let elsewhere = |f: &Fitted| Point { theta: f.point.theta, effects: f.point.effects.clone(), ..p.origin() };
        let run = |point: &Point, h: &Hypothesis| p.run_response(left_out, point, h);
        let error = |response: &Vec<Vec<f64>>| rms(p, &[(left_out, response.clone())]);
        let refit = |s: &Scored, theta: [f64; NUISANCES], columns: Option<Arc<Columns>>, steps: usize| {
            let h = without(&s.trial.hypothesis, left_out);
            let start = Point { theta, effects: s.trial.fitted.point.effects.clone(), ..others.origin() };
            elsewhere(&others.refine(&h, others.begin(&h, start, columns), steps, None))
        };
        let corrected = answer.winner().map(|w| (refit(w, others.centre, None, LEAVE_OUT.steps), &w.trial.hypothesis));
        // The placebo's tuning has seen the left-out recording: if anything, that flatters it.
        let placebo = wrong.map(|s| {
            let columns = Some(retuned.columns.clone());
            let point = refit(s, s.trial.fitted.point.theta, columns, LEAVE_OUT.placebo_steps);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::calibrate::{Calibration, Regimes};
    use crate::case::Case;
    use crate::decide::Decision;
    use crate::gate::Gate;
    use crate::redundancy::Redundant;
    use crate::testing::{cutting, driven, problem};
    use crate::trial::Trial;
    use crate::windows::{CHANNELS, cut};
    use inference::Options;
    use inference::hypothesis::Place;
    use robot_model::tunable::usual_sigma;
    use testing::robot;

    fn scored(p: &Problem<'_>, id: &str, score: f64) -> Scored {
        let form = p.variants().into_iter().find(|v| v.spec().id == id && v.place == Place::Whole);
        let h = Hypothesis::single(form.expect("in the catalogue"), Vec::new());
        let effects = h.free(p.largest_torque).iter().map(|f| f.usual).collect();
        let fitted = p.begin(&h, Point { effects, ..p.origin() }, None);
        Scored { trial: Trial { hypothesis: h, fitted }, visits: None, score, probability: 0.4 }
    }

    /// Forecasts of drives whose effects have been weighed: viscous friction first, then rolling resistance.
    fn forecasts(cuts: &[Cut]) -> Forecasts {
        let robot = robot();
        let p = problem(&robot, cuts);
        let calibration = Calibration {
            theta: p.centre,
            information: p.information.clone(),
            variance: p.variance,
            spread: p.spread,
            regimes: Regimes::default(),
            gate: Gate::default(),
        };
        let case = Case {
            robot,
            sigma: usual_sigma(),
            pose_sigma: 1e-4,
            references: Vec::new(),
            recordings: Vec::new(),
            held_out: Vec::new(),
        };
        let all = [("viscous_friction", 30.0), ("rolling_resistance", 10.0), ("viscous_friction", 5.0)];
        let scored = all.map(|(id, score)| scored(&p, id, score)).to_vec();
        let answer = Judged {
            case: &case,
            options: &Options::default(),
            problem: &p,
            references: &[],
            calibration: &calibration,
            sensors: &Redundant::default(),
            decision: &Decision { scored, none: 0.1, unknown: 0.0 },
        };
        let placebo = placebo(&answer).expect("a rival").trial.hypothesis.ids();
        assert_eq!(placebo, ["rolling_resistance"], "the best hypothesis that shares nothing with the winner");
        leave_one_out(&answer, &p.begin(&Hypothesis::default(), p.origin(), None))
    }

    #[test]
    fn a_fit_does_not_see_the_recording_that_it_leaves_out() {
        let cuts = [8.0, 10.0].map(|seconds| cut(&driven(&robot(), &[], seconds), &cutting()));
        let before = forecasts(&cuts);

        let mut changed = cuts;
        for segment in &mut changed[0].segments {
            segment.observed.iter_mut().step_by(CHANNELS).for_each(|y| *y *= 1.2);
        }
        let after = forecasts(&changed);

        let of = |f: &Forecasts, run: usize| (f.left_out[run].point.theta, f.left_out[run].point.effects.clone());
        assert_eq!(of(&before, 0), of(&after, 0), "the fit for recording 0 saw recording 0");
        assert_ne!(of(&before, 1), of(&after, 1), "the fit for recording 1 did not see recording 0");
        // What was changed is forecast worse, by the placebo as well.
        let wheels = |f: &Forecasts| (f.free_runs[0].corrected, f.free_runs[0].placebo.expect("a placebo"));
        let ((c0, p0), (c1, p1)) = (wheels(&before), wheels(&after));
        assert!(c1 > c0 && p1 > p0, "corrected {c0} to {c1}, placebo {p0} to {p1}");
    }

    #[test]
    fn a_correction_is_worthwhile_unless_it_forecasts_worse_than_the_calibrated_model() {
        let robot = robot();
        let mut cuts = [cut(&driven(&robot, &[], 8.0), &cutting())];
        for segment in &mut cuts[0].segments {
            segment.observed.iter_mut().for_each(|y| *y *= 1.1);
        }
        let p = problem(&robot, &cuts);
        let calibrated = p.response(&p.origin(), &Hypothesis::default());
        let level = rms(&p, &[(0, calibrated[0].clone())]);
        let runs = |factor: [f64; 2]| {
            let run = |i: usize| FreeRun {
                recording: "r".to_owned(),
                quantity: "q".to_owned(),
                nominal: level[i],
                retuned: level[i],
                corrected: factor[i] * level[i],
                placebo: None,
            };
            [run(0), run(1)]
        };
        assert!(is_worthwhile(&p, &calibrated, &runs([0.5, 0.5])));
        assert!(!is_worthwhile(&p, &calibrated, &runs([1.5, 1.5])));
        // Shares count, whatever the quantities' sizes: half of one outweighs a fifth more of the other.
        assert!(is_worthwhile(&p, &calibrated, &runs([1.2, 0.5])));
        assert!(!is_worthwhile(&p, &calibrated, &runs([3.0, 0.5])));
    }
}
