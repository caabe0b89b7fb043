//! Free runs on recordings that were not fitted: as it is, re-tuned, corrected, and a placebo.

use inference::experiment::{self, Comparison, Experiment, Forecast};
use inference::robust;
use robot_model::tunable::COUNT as NUISANCES;
use verdict::FreeRun;

use crate::calibrate::problem;
use crate::decision::Scored;
use crate::fit::{Fitted, Hypothesis, Point, Problem};
use crate::judged::Judged;
use crate::rms::{residuals, rms};
use crate::settings::decision::{LeaveOut, SETTINGS};
use crate::simulate::{Response, RunResponse};
use crate::windows::{Cut, Segment};

const LEAVE_OUT: LeaveOut = SETTINGS.leave_out;

/// A hypothesis at fitted values.
#[derive(Clone)]
pub(crate) struct Model {
    pub(crate) hypothesis: Hypothesis,
    pub(crate) point: Point,
}

/// A recording by four simulations: windows by segment.
pub(crate) type Simulated = Forecast<Model, RunResponse>;

/// Free runs on recordings that were left out of the fit.
pub(crate) struct Forecasts {
    /// From measured states, every segment.
    pub(crate) free_runs: Vec<FreeRun>,
    /// From the first measured state alone.
    pub(crate) whole: Vec<FreeRun>,
    /// One for each recording.
    pub(crate) simulated: Vec<Simulated>,
    /// The best wrong cause, if one was fitted.
    pub(crate) placebo: Option<Scored>,
}

/// Torque-driven recordings, each of which is left out in turn.
struct LeftOut<'a> {
    answer: &'a Judged<'a>,
    retuned: &'a Fitted,
    placebo: Option<&'a Scored>,
}

/// Free runs on each recording, fitted on the others only: from measured states, and over the whole recording. A lone
/// recording cannot be left out: it is simulated as fitted.
pub(crate) fn leave_one_out(answer: &Judged<'_>, retuned: &Fitted) -> Forecasts {
    let placebo = placebo(answer);
    let left_out = LeftOut { answer, retuned, placebo };
    let simulated = experiment::leave_out(&left_out);
    let free_runs = experiment::free_runs(&left_out, &simulated, |run| answer.problem.cuts[run].name.clone());
    Forecasts { free_runs, whole: whole_recordings(answer, &simulated), simulated, placebo: placebo.cloned() }
}

impl Experiment for LeftOut<'_> {
    type Model = Model;
    type Response = RunResponse;

    fn blocks(&self) -> usize {
        self.answer.problem.cuts.len()
    }

    fn fitted_without(&self, run: usize) -> Option<Comparison<Model>> {
        let (answer, p) = (self.answer, self.answer.problem);
        if p.cuts.len() < 2 {
            return None;
        }

        let cuts = all_but(p, run);
        let others = problem(p.robot, answer.case, &cuts, answer.calibration, p.largest_torque, answer.options);
        let fitted = |h: &Hypothesis, of_all: &Point| fitted_on_others(&others, h, of_all, p.constants_are_loose);
        // What a recording has to itself is not known beforehand: its deviations are zero.
        let elsewhere = |f: &Fitted| Point { run: p.origin().run, ..f.point.clone() };
        let model =
            |s: &Scored, fitted: &Fitted| Model { hypothesis: s.trial.hypothesis.clone(), point: elsewhere(fitted) };

        let none = Hypothesis::default();
        let retuned = fitted(&none, &self.retuned.point);
        let corrected = |w: &Scored| model(w, &fitted(&without(&w.trial.hypothesis, run), &w.trial.fitted.point));
        // The placebo's tuning has seen the left-out recording: if anything, that flatters it.
        let placebo = |s: &Scored| {
            let (h, of_all) = (without(&s.trial.hypothesis, run), &s.trial.fitted.point);
            let start = Point { theta: of_all.theta, effects: of_all.effects.clone(), ..others.origin() };
            let start = others.begin(&h, start, Some(retuned.columns.clone()));
            model(s, &others.refine(&h, start, LEAVE_OUT.placebo_steps, None))
        };
        Some(Comparison {
            nominal: self.nominal(),
            corrected: answer.winner().map(corrected),
            placebo: self.placebo.map(placebo),
            retuned: Model { hypothesis: none, point: elsewhere(&retuned) },
        })
    }

    fn fitted(&self) -> Comparison<Model> {
        let model = |s: &Scored| Model { hypothesis: s.trial.hypothesis.clone(), point: s.trial.fitted.point.clone() };
        Comparison {
            nominal: self.nominal(),
            retuned: Model { hypothesis: Hypothesis::default(), point: self.retuned.point.clone() },
            corrected: self.answer.winner().map(model),
            placebo: self.placebo.map(model),
        }
    }

    fn response(&self, model: &Model, run: usize) -> RunResponse {
        let p = self.answer.problem;
        // With one recording everything was fitted on it, its onset too.
        if p.cuts.len() < 2 {
            return p.run_response(run, &model.point, &model.hypothesis);
        }
        forecast(p, model, run)
    }

    fn quantities(&self) -> Vec<String> {
        QUANTITIES.map(str::to_owned).to_vec()
    }

    fn errors(&self, response: &RunResponse, run: usize) -> Vec<Vec<f64>> {
        residuals(self.answer.problem, run, response).to_vec()
    }
}

impl LeftOut<'_> {
    fn nominal(&self) -> Model {
        let point = Point { theta: [0.0; NUISANCES], ..self.answer.problem.origin() };
        Model { hypothesis: Hypothesis::default(), point }
    }
}

/// All recordings but one.
pub(crate) fn all_but(p: &Problem<'_>, run: usize) -> Vec<Cut> {
    (0..p.cuts.len()).filter(|&r| r != run).map(|r| p.cuts[r].clone()).collect()
}

/// A hypothesis fitted on the recordings of `others`; `of_all`: its fit on all.
///
/// The robot file may be so far away (`may_be_far`) that no fit arrives: then it begins where that of all recordings ended, too. Which of the
/// two counts is told by the other recordings alone; only the start has seen the one that is left out.
pub(crate) fn fitted_on_others(others: &Problem<'_>, h: &Hypothesis, of_all: &Point, may_be_far: bool) -> Fitted {
    let from = |theta| {
        let start = Point { theta, effects: of_all.effects.clone(), ..others.origin() };
        others.refine(h, others.begin(h, start, None), LEAVE_OUT.steps, None)
    };
    let first = from(others.centre);
    let again = may_be_far.then(|| from(of_all.theta));
    again.filter(|again| again.cost < first.cost).unwrap_or(first)
}

/// Free run of a recording, each segment with onsets that the other segments of the recording tell.
///
/// When an effect sets in cannot be known before a drive; nothing of the segment that is forecast may tell it.
///
/// Of two effects that set in, the first is forecast so; the second stays as it was fitted.
pub(crate) fn forecast(p: &Problem<'_>, model: &Model, run: usize) -> RunResponse {
    let Model { hypothesis, point } = model;
    let Some(part) = hypothesis.parts.iter().position(|(variant, _)| variant.begins()) else {
        return p.run_response(run, point, hypothesis);
    };
    let from = |onset: Option<f64>| {
        let mut own = hypothesis.clone();
        own.parts[part].1[run] = onset;
        p.run_response(run, point, &own)
    };
    let cut = &p.cuts[run];
    let [with, without] = [from(Some(cut.from)), from(None)];
    let costs = |response: &RunResponse| -> Vec<f64> {
        response.iter().enumerate().map(|(s, y)| p.segment_cost(run, s, p.q(run, s, y))).collect()
    };
    let costs: Vec<[f64; 2]> = costs(&with).into_iter().zip(costs(&without)).map(Into::into).collect();

    let of_segment = |(s, segment): (usize, &Segment)| match present(&costs, s) {
        Some(true) => with[s].clone(),
        Some(false) => without[s].clone(),
        None => {
            let middle = segment.row + segment.windows * cut.rows_per_window / 2;
            from(Some(cut.time(middle as f64))).swap_remove(s)
        }
    };
    cut.segments.iter().enumerate().map(of_segment).collect()
}

/// Whether an effect is present in segment `s`, as the other segments tell by their costs with it and without; `None` if
/// they say that it sets in within `s`.
fn present(costs: &[[f64; 2]], s: usize) -> Option<bool> {
    let others = |border: usize| -> f64 {
        let cost = |(i, cost): (usize, &[f64; 2])| if i == s { 0.0 } else { cost[usize::from(i < border)] };
        costs.iter().enumerate().map(cost).sum()
    };
    // Borders `s` and `s + 1` cost the same, for they differ in `s` only.
    let border = (0..=costs.len()).min_by(|a, b| others(*a).total_cmp(&others(*b))).unwrap_or(0);
    (border != s && border != s + 1).then_some(border < s)
}

/// The same simulations over whole recordings, from the first measured state alone.
fn whole_recordings(answer: &Judged<'_>, simulated: &[Simulated]) -> Vec<FreeRun> {
    let p = answer.problem;
    let cuts: Vec<Cut> = p.cuts.iter().map(Cut::whole).collect();
    let whole = problem(p.robot, answer.case, &cuts, answer.calibration, p.largest_torque, answer.options);
    let left_out = simulated.iter().enumerate().filter(|(_, s)| s.left_out);
    let of_recording = |(run, simulated): (usize, &Simulated)| -> Vec<FreeRun> {
        let all = simulated.models.map(|m| residuals(&whole, run, &whole.run_response(run, &m.point, &m.hypothesis)));
        let row = |(q, quantity): (usize, &str)| {
            let errors = all.map(|of| robust::rms(of[q].iter().copied()).unwrap_or(f64::NAN));
            let row = || experiment::free_run(cuts[run].name.clone(), quantity.to_owned(), &errors);
            (!all.nominal[q].is_empty()).then(row)
        };
        WHOLE.into_iter().enumerate().filter_map(row).collect()
    };
    left_out.flat_map(of_recording).collect()
}

/// What is compared in segments.
pub(crate) const QUANTITIES: [&str; 2] = ["wheel speed, rad/s", "yaw rate, rad/s"];
/// What is compared over whole recordings.
const WHOLE: [&str; 2] = ["wheel speed over the whole recording, rad/s", "yaw rate over the whole recording, rad/s"];

/// Whether the correction (or re-tuning, without one) forecasts recordings that were left out of its fit no worse than the
/// calibrated model does, all recordings and both quantities together.
pub(crate) fn is_worthwhile(p: &Problem<'_>, calibrated: &Response, runs: &[FreeRun]) -> bool {
    let change = |row: &FreeRun| {
        let run = p.cuts.iter().position(|cut| cut.name == row.recording)?;
        let quantity = QUANTITIES.into_iter().position(|quantity| quantity == row.quantity)?;
        let before = rms(p, &[(run, calibrated[run].clone())])[quantity];
        (before > 0.0).then(|| (row.corrected / before).ln())
    };
    runs.iter().filter_map(change).sum::<f64>() <= 0.0
}

/// The hypothesis for all recordings but one.
pub(crate) fn without(h: &Hypothesis, left_out: usize) -> Hypothesis {
    let mut h = h.clone();
    for (_, onsets) in h.parts.iter_mut().filter(|(_, o)| !o.is_empty()) {
        onsets.remove(left_out);
    }
    h
}

/// The best hypothesis that shares no effect with the winner and is no larger.
pub(crate) fn placebo<'a>(answer: &'a Judged<'_>) -> Option<&'a Scored> {
    let winner = answer.winner()?.trial.hypothesis.ids();
    let shared = |s: &Scored| s.trial.hypothesis.ids().iter().any(|id| winner.contains(id));
    let all = answer.decision.scored.iter();
    all.filter(|s| s.trial.hypothesis.parts.len() <= winner.len() && !shared(s))
        .max_by(|a, b| a.score.total_cmp(&b.score))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::calibrate::Calibration;
    use crate::case::Case;
    use crate::channel::Channel;
    use crate::decision::Decision;
    use crate::nothing::without_effect;
    use crate::redundancy::Redundant;
    use crate::testing::{calibration, cutting, driven, problem};
    use crate::trial::Trial;
    use crate::visit::Visit;
    use crate::windows::cut;
    use inference::Options;
    use inference::hypothesis::Place;
    use robot_model::Robot;
    use testing::robot;

    fn scored(p: &Problem<'_>, id: &str, score: f64) -> Scored {
        let form = p.variants().into_iter().find(|v| v.spec().id == id && v.place == Place::Whole);
        let h = Hypothesis::single(form.expect("in the catalogue"), Vec::new());
        let effects = h.free(&p.sizes()).iter().map(|f| f.usual).collect();
        let fitted = p.begin(&h, Point { effects, ..p.origin() }, None);
        Scored { trial: Trial { hypothesis: h, fitted }, visits: None, score, probability: 0.4 }
    }

    /// An answer without references.
    fn judged<'a>(
        problem: &'a Problem<'a>,
        case: &'a Case,
        (options, sensors): (&'a Options, &'a Redundant),
        calibration: &'a Calibration,
        decision: &'a Decision,
    ) -> Judged<'a> {
        let (references, visits): (&[Cut], &[Option<Visit>]) = (&[], &[]);
        Judged { case, options, problem, references, visits, calibration, sensors, simulator: None, decision }
    }

    /// Forecasts of drives whose effects have been weighed: viscous friction first, then rolling resistance.
    fn forecasts(cuts: &[Cut]) -> Forecasts {
        let robot = robot();
        let p = problem(&robot, cuts);
        let calibration = calibration(&p);
        let case = Case { pose_sigma: 1e-4, ..Case::new(robot) };
        let all = [("viscous_friction", 30.0), ("rolling_resistance", 10.0), ("viscous_friction", 5.0)];
        let scored = all.map(|(id, score)| scored(&p, id, score)).to_vec();
        let decision = Decision { scored, none: 0.1, ..Decision::default() };
        let (options, sensors) = Default::default();
        let answer = judged(&p, &case, (&options, &sensors), &calibration, &decision);
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
            segment.observed.iter_mut().for_each(|y| y[Channel::LeftWheel] *= 1.2);
        }
        let after = forecasts(&changed);

        let point = |f: &Forecasts, run: usize| f.simulated[run].models.best().point.clone();
        let of = |f: &Forecasts, run: usize| (point(f, run).theta, point(f, run).effects);
        assert_eq!(of(&before, 0), of(&after, 0), "the fit for recording 0 saw recording 0");
        assert_ne!(of(&before, 1), of(&after, 1), "the fit for recording 1 did not see recording 0");
        // What was changed is forecast worse, by the placebo as well.
        let wheels = |f: &Forecasts| (f.free_runs[0].corrected, f.free_runs[0].placebo.expect("a placebo"));
        let ((c0, p0), (c1, p1)) = (wheels(&before), wheels(&after));
        assert!(c1 > c0 && p1 > p0, "corrected {c0} to {c1}, placebo {p0} to {p1}");
    }

    #[test]
    fn without_references_a_fit_begins_where_that_of_all_recordings_ended_too() {
        // Between a tyre that slips by a share of its speed and a contact that creeps with the slip speed lie bad fits.
        let file = robot();
        let truth = Robot { slip_at_peak: 0.1, rest_speed: 3.0, adhesion: 0.4 * file.adhesion, ..file };
        let cuts = [14.0, 18.0].map(|seconds| cut(&driven(&truth, &[], seconds), &cutting()));
        let p = Problem { has_references: false, constants_are_loose: true, ..problem(&file, &cuts) };
        let origin = p.begin(&Hypothesis::default(), p.origin(), None);
        let arrived = without_effect(&p, &origin).point;
        let cost = |may_be_far| fitted_on_others(&p, &Hypothesis::default(), &arrived, may_be_far).cost;
        let [from_the_file, from_both] = [false, true].map(cost);
        assert!(from_both < 0.8 * from_the_file, "{from_the_file} {from_both}");
    }

    #[test]
    fn the_other_segments_tell_whether_an_effect_is_present_in_one() {
        // Costs with the effect and without: absent in the first two, present from within the third on.
        let costs = [[9.0, 1.0], [9.0, 1.0], [6.0, 5.0], [1.0, 9.0], [1.0, 9.0]];
        let told: Vec<Option<bool>> = (0..costs.len()).map(|s| present(&costs, s)).collect();
        // The fourth may hold the instant as well, for all that its neighbours say.
        assert_eq!(told, [Some(false), Some(false), None, None, Some(true)]);
        // What a segment itself costs does not matter to it.
        let mut changed = costs;
        changed[4] = [99.0, 0.0];
        assert_eq!(present(&changed, 4), Some(true));
    }

    #[test]
    fn an_onset_is_not_taken_from_the_segment_that_is_forecast() {
        let robot = robot();
        let form = inference::hypothesis::variants(true).into_iter().find(|v| v.place == Place::Onset);
        let form = form.expect("an effect that sets in");
        let values: Vec<f64> = form.free(&inference::hypothesis::Sizes::default()).iter().map(|f| f.usual).collect();
        let dose = form.dose(&values, Some(7.0));
        let cuts = [cut(&driven(&robot, &[dose], 16.0), &cutting())];
        let p = problem(&robot, &cuts);
        let hypothesis = Hypothesis::single(form, vec![Some(7.0)]);
        let model = Model { hypothesis, point: Point { effects: values, ..p.origin() } };

        let plain = forecast(&p, &model, 0);
        let mut wrong = model.clone();
        wrong.hypothesis.parts[0].1[0] = Some(1.0);
        assert_eq!(forecast(&p, &wrong, 0), plain, "the fitted onset of the run itself was used");
    }

    #[test]
    fn a_whole_recording_runs_from_its_first_state_alone() {
        let robot = robot();
        let cuts = [cut(&driven(&robot, &[], 12.0), &cutting())];
        let whole = [cuts[0].whole()];
        let (n, all) = (cuts[0].segments.len(), &whole[0].segments);
        assert!(n > 1 && all.len() == 1 && all[0].windows == cuts[0].segments.iter().map(|s| s.windows).sum::<usize>());
        let [by_segment, at_once] = [&cuts, &whole].map(|cuts| {
            let p = problem(&robot, cuts);
            rms(&p, &[(0, p.run_response(0, &p.origin(), &Hypothesis::default()))])
        });
        // The robot that drove is the one simulated: both stay near, the longer run less so.
        assert!(by_segment[0] < 0.05 && at_once[0] < 0.5 && by_segment != at_once, "{by_segment:?} {at_once:?}");
    }

    #[test]
    fn a_correction_is_worthwhile_unless_it_forecasts_worse_than_the_calibrated_model() {
        let robot = robot();
        let mut cuts = [cut(&driven(&robot, &[], 8.0), &cutting())];
        for segment in &mut cuts[0].segments {
            segment.observed.iter_mut().for_each(|y| *y = y.map(|y| 1.1 * y));
        }
        let p = problem(&robot, &cuts);
        let calibrated = p.response(&p.origin(), &Hypothesis::default());
        let level = rms(&p, &[(0, calibrated[0].clone())]);
        let runs = |factor: [f64; 2]| {
            let run = |i: usize| FreeRun {
                recording: p.cuts[0].name.clone(),
                quantity: QUANTITIES[i].to_owned(),
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
        // Without a gyro the wheels alone tell.
        assert!(!is_worthwhile(&p, &calibrated, &runs([1.5, 0.1])[..1]));
    }
}
