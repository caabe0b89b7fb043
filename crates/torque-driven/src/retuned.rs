//! Constants of the robot that moved farther than they are known: "re-tune" as an answer.

use std::collections::BTreeMap;

use faer::Mat;
use inference::algebra::inverse_spd;
use inference::robust::NINETY;
use robot_model::Robot;
use robot_model::constants::Constant;
use robot_model::tunable::{COUNT as NUISANCES, Tunable, tunables, tuned};
use verdict::{Retuned, Verdict};

use crate::fit::{Columns, Fitted, Hypothesis, Problem};
use crate::judged::Judged;
use crate::run::Run;
use crate::settings::decision::{Answer, Retune, SETTINGS};
use crate::stand_in;

const RETUNE: Retune = SETTINGS.retune;
const ANSWER: Answer = SETTINGS.answer;

/// Constants that a fit moved from where the references, or the robot file, have them; the farthest first.
///
/// What stands for a law that the plant lacks is not among them, since nobody can measure it on a robot, unless an effect of
/// the catalogue is it under another name.
fn retuned(p: &Problem<'_>, h: &Hypothesis, fitted: &Fitted, likely: Option<usize>) -> Vec<Retuned> {
    let known = covariance(p, h, fitted).zip(inverse_spd(&p.information));
    let Some((covariance, prior)) = known else { return Vec::new() };
    let mut out = moved(p.robot, &p.sigma, [&p.centre, &fitted.point.theta], [&prior, &covariance], likely);
    if !p.has_references {
        out.retain(|constant| is_told_without_references(constant, likely));
    }
    // Where a simulation of this form is best is not quite what a robot of another form has.
    for constant in &mut out {
        let sigma = ((constant.to - constant.from) / constant.sigmas).abs();
        constant.half_width = constant.half_width.hypot(NINETY * RETUNE.form * sigma);
    }
    out
}

/// Whether a constant moved so far that not the form of the plant's laws moved it, which no reference shows: one that can be
/// measured on a robot, by more than both the file and the form err, or one that is likelier moved than not.
fn is_told_without_references(constant: &Retuned, likely: Option<usize>) -> bool {
    let Some(k) = tunables::<f64>().iter().position(|t| t.id == constant.constant) else { return false };
    let is_measurable = tunables::<f64>()[k].between_visits >= RETUNE.measurable;
    let far = RETUNE.least_known * RETUNE.form.hypot(1.0);
    likely == Some(k) || (is_measurable && constant.sigmas.abs() >= far)
}

impl Judged<'_> {
    /// The same as part of an answer: constants that make up for what nobody knows are not what the robot has; a constant that
    /// is likelier moved than not is told however far.
    pub(crate) fn retuned(&self, verdict: Verdict, h: &Hypothesis, fitted: &Fitted) -> Vec<Retuned> {
        if verdict == Verdict::Unknown {
            return Vec::new();
        }
        retuned(self.problem, h, fitted, self.decision.moved_constant(self.problem))
    }

    /// Constants that a tuning, in sigmas by id, puts farther from the robot file than it states, the farthest first, a few of them.
    pub(crate) fn beyond_the_file(&self, tuning: &BTreeMap<String, f64>) -> Vec<Retuned> {
        let p = self.problem;
        let theta = tunables::<f64>().map(|t| tuning.get(t.id).copied().unwrap_or(0.0));
        let is_beyond = |k: &usize| (theta[*k] - p.centre[*k]).abs() >= RETUNE.least_known;
        let far = (0..NUISANCES).filter(is_beyond);
        let mut out: Vec<Retuned> = far.filter_map(|k| otherwise(p.robot, &p.sigma, [&p.centre, &theta], k)).collect();
        out.sort_by(|a, b| b.sigmas.abs().total_cmp(&a.sigmas.abs()));
        out.truncate(ANSWER.listed_beyond);
        out
    }
}

/// Constants of a robot that lie elsewhere at the second tuning than at the first, by more than either is uncertain: with
/// the covariance of each, in the constants' sigmas.
pub(crate) fn moved(
    robot: &Robot<f64>,
    sigma_of: &[f64; NUISANCES],
    [first, last]: [&[f64; NUISANCES]; 2],
    [prior, known]: [&Mat<f64>; 2],
    likely: Option<usize>,
) -> Vec<Retuned> {
    let of = |(k, tunable): (usize, &Tunable<f64>)| {
        let moved = last[k] - first[k];
        let sigma = |of: &Mat<f64>| of[(k, k)].max(0.0).sqrt();
        let known = ANSWER.curvature * sigma(known);
        let is_measurable = tunable.between_visits >= RETUNE.measurable;
        let least = if is_measurable { RETUNE.least_sigmas } else { RETUNE.least_of_form };
        let far = least.max(RETUNE.least_known * known).max(RETUNE.least_prior * sigma(prior));
        let far = if likely == Some(k) { RETUNE.least_likely } else { far };
        if moved.abs() < far || !(is_measurable || stand_in::is_an_effect(k, robot)) {
            return None;
        }
        let constant = otherwise(robot, sigma_of, [first, last], k)?;
        let half_width = NINETY * known * ((constant.to - constant.from) / moved).abs();
        Some(Retuned { half_width, ..constant })
    };
    let mut out: Vec<Retuned> = tunables::<f64>().iter().enumerate().filter_map(of).collect();
    out.sort_by(|a, b| b.sigmas.abs().total_cmp(&a.sigmas.abs()));
    out
}

/// A sentence on each visit of the recordings whose constants a fit found a stated sigma and more from those of the others.
pub(crate) fn moved_by_visit(problem: &Problem<'_>, fitted: &Fitted, recordings: &[Run]) -> Vec<String> {
    let theta = fitted.point.theta;
    let of_visit = |(_, runs): (usize, Vec<usize>)| {
        let first = *runs.first()?;
        let mut there = theta;
        problem.move_to_visit(&mut there, &fitted.point, first);
        let is_far = |k: &usize| {
            (there[*k] - theta[*k]).abs() >= RETUNE.least_sigmas
                && tunables::<f64>()[*k].between_visits >= RETUNE.measurable
        };
        let elsewhere = (0..NUISANCES).filter(is_far);
        let constants: Vec<String> = elsewhere
            .filter_map(|k| otherwise(problem.robot, &problem.sigma, [&theta, &there], k))
            .map(|constant| constant.values())
            .collect();
        let name = recordings.get(first)?.visit.as_ref().map_or("without a name", |visit| &visit.name);
        (!constants.is_empty()).then(|| {
            format!("on the visit '{name}' constants are not where the others have them: {}", constants.join(", "))
        })
    };
    problem.free_visits().into_iter().filter_map(of_visit).collect()
}

/// The constant at place `k` at two tunings, without an interval; `None` of one that no robot file has.
pub(crate) fn otherwise(
    robot: &Robot<f64>,
    sigma: &[f64; NUISANCES],
    [first, last]: [&[f64; NUISANCES]; 2],
    k: usize,
) -> Option<Retuned> {
    let tunable = tunables::<f64>()[k];
    let constant = constant_of(&tunable)?;
    let [from, to] = [first, last].map(|theta| (constant.get)(&tuned(robot, sigma, theta)));
    Some(Retuned {
        constant: tunable.id.to_owned(),
        unit: constant.unit.to_owned(),
        from,
        to,
        half_width: 0.0,
        sigmas: last[k] - first[k],
    })
}

/// The constant that a tuning moves.
pub(crate) fn constant_of(tunable: &Tunable<f64>) -> Option<&'static Constant<f64>> {
    Robot::<f64>::CONSTANTS.iter().find(|c| c.tuning.is_some_and(|t| t.id == tunable.id))
}

/// Covariance of the constants, in their sigmas, at a fit.
fn covariance(p: &Problem<'_>, h: &Hypothesis, fitted: &Fitted) -> Option<Mat<f64>> {
    let columns =
        if h.parts.is_empty() { Columns(Vec::new()) } else { p.effect_columns(&fitted.point, h, &fitted.response) };
    let mut normal = p.normal(&fitted.point, &fitted.response, &fitted.columns, &columns)?;
    p.with_prior(&fitted.point, &mut normal);
    for i in p.centre.len()..normal.matrix.nrows() {
        normal.matrix[(i, i)] += RETUNE.ridge;
    }
    inverse_spd(&normal.matrix)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::between_visits::visits_of_references;
    use crate::testing::{cutting, driven, problem};
    use crate::visit::{KnownBy, Visit};
    use crate::windows::{Cut, cut};
    use robot_model::tunable::usual_sigma;
    use testing::robot;

    #[test]
    fn a_constant_that_moved_is_reported_with_its_values_and_one_that_did_not_is_not() {
        let robot = robot();
        let at = tunables::<f64>().iter().position(|t| t.id == "rolling_resistance").expect("tunable");
        let mut theta = [0.0; robot_model::tunable::COUNT];
        theta[at] = 4.0;
        let moved = tuned(&robot, &usual_sigma(), &theta);
        let cuts = [cut(&driven(&moved, &[], 30.0), &cutting())];
        let p = problem(&robot, &cuts);

        let none = Hypothesis::default();
        let fitted = p.refine(&none, p.begin(&none, p.origin(), None), 6, Some(2));
        let found = retuned(&p, &none, &fitted, None);
        let first = found.first().unwrap_or_else(|| panic!("at {:?}", fitted.point.theta));
        assert_eq!(first.constant, "rolling_resistance", "{found:?}");
        assert!((first.to - moved.rolling_resistance).abs() < 2.0 * first.half_width, "{first:?}");
        approx::assert_relative_eq!(first.from, robot.rolling_resistance, epsilon = 1e-12);
        let sigma = (first.to - first.from) / first.sigmas;
        assert!(first.half_width > NINETY * RETUNE.form * sigma, "a robot has other laws than the plant: {first:?}");

        let at_rest = p.begin(&none, p.origin(), None);
        assert!(retuned(&p, &none, &at_rest, None).is_empty());
    }

    #[test]
    fn of_constants_that_stand_for_the_form_of_a_law_those_are_told_that_are_effects() {
        let robot = robot();
        let little = Mat::from_fn(NUISANCES, NUISANCES, |i, j| if i == j { 0.01 } else { 0.0 });
        let told = |id: &str, sigmas: f64| {
            let mut theta = [0.0; NUISANCES];
            theta[crate::run_numbers::constant(id)] = sigmas;
            let place = crate::run_numbers::constant(id);
            let found = |likely| moved(&robot, &usual_sigma(), [&[0.0; NUISANCES], &theta], [&little, &little], likely);
            assert!(found(Some(place)).len() >= found(None).len());
            found(None).into_iter().map(|r| r.constant).collect::<Vec<_>>()
        };
        let place = crate::run_numbers::constant("viscous");
        let likely = |sigmas: f64| {
            let mut theta = [0.0; NUISANCES];
            theta[place] = sigmas;
            moved(&robot, &usual_sigma(), [&[0.0; NUISANCES], &theta], [&little, &little], Some(place)).len()
        };
        assert_eq!([likely(0.5), likely(0.1)], [1, 0], "likelier moved, but not at all where it is");
        assert_eq!(told("lateral_factor", -3.7), ["lateral_factor"]);
        assert!(told("lateral_factor", -1.5).is_empty(), "fault-free robots are that far off");
        assert!(told("sliding_share", 3.7).is_empty(), "no effect of the catalogue is a share in sliding");
        assert_eq!(told("rolling_resistance", 1.5), ["rolling_resistance"]);
    }

    #[test]
    fn without_references_the_form_of_the_laws_is_no_constant_that_moved() {
        let told = |id: &str, sigmas: f64, likely: bool| {
            let place = crate::run_numbers::constant(id);
            let mut theta = [0.0; NUISANCES];
            theta[place] = sigmas;
            let constant = otherwise(&robot(), &usual_sigma(), [&[0.0; NUISANCES], &theta], place).expect("a constant");
            is_told_without_references(&constant, likely.then_some(place))
        };
        assert!(!told("slip_at_peak", -9.0, false), "nobody can measure it on a robot");
        assert!(told("rolling_resistance", 4.0, false) && !told("rolling_resistance", 3.0, false));
        assert!(told("rolling_resistance", 1.0, true));
    }

    #[test]
    fn a_visit_whose_constants_moved_is_told_with_them() {
        let robot = robot();
        let mut theta = [0.0; robot_model::tunable::COUNT];
        for id in ["rolling_resistance", "coulomb_left", "coulomb_right"] {
            theta[crate::run_numbers::constant(id)] = 3.0;
        }
        let there = tuned(&robot, &usual_sigma(), &theta);
        let days: Vec<Run> = [("monday", &robot), ("tuesday", &there)]
            .map(|(day, robot)| {
                let visit = Some(Visit { name: day.to_owned(), known_by: KnownBy::User });
                Run { visit, ..driven(robot, &[], 24.0) }
            })
            .to_vec();
        let number = |(visit, run): (usize, &Run)| Cut { visit: Some(visit), ..cut(run, &cutting()) };
        let cuts: Vec<Cut> = days.iter().enumerate().map(number).collect();
        // The constants that both scatter about are known.
        let information = Mat::from_fn(NUISANCES, NUISANCES, |i, j| if i == j { 100.0 } else { 0.0 });
        let p = Problem { visits: visits_of_references(&cuts), information, ..problem(&robot, &cuts) };

        let none = Hypothesis::default();
        let fitted = p.refine(&none, p.begin(&none, p.origin(), None), 8, Some(2));
        let [told] = &moved_by_visit(&p, &fitted, &days)[..] else { panic!("{:?}", fitted.point.visits) };
        assert!(told.starts_with("on the visit 'tuesday'") && told.contains("coulomb"), "{told}");
        assert!(moved_by_visit(&p, &p.begin(&none, p.origin(), None), &days).is_empty());
    }
}
