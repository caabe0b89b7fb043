//! From a decision to the verdict: kind of answer, causes with sizes and intervals, places, limits.

use std::collections::BTreeMap;
use std::iter;

use catalogue::answer::{NONE, UNKNOWN};
use faer::Mat;
use robot_model::tunable::{COUNT as NUISANCES, tunables};

use crate::confirmed::Unconfirmed;
use crate::decide::fault_free_cost;
use crate::decision::Scored;
use crate::fit::{Fitted, Hypothesis};
use crate::judged::Judged;
use crate::leave_out::{Forecasts, QUANTITIES, is_worthwhile, leave_one_out};
use crate::motion::GyroError;
use crate::predict::predict;
use crate::redundancy::Fault;
use crate::settings::decision::{Answer, SETTINGS};
use crate::settings::fit;
use crate::{locate, own_effects, retuned, stand_in, words};
use inference::algebra::solve_spd;
use inference::experiment::Standing;
use inference::hypothesis::Dose;
use inference::hypothesis::Place;
use robot_model::tunable::tuned;
use verdict::FORMAT;
use verdict::{Cause, Diagnosis, Estimate, Trial, Verdict};

const ANSWER: Answer = SETTINGS.answer;

impl Judged<'_> {
    fn verdict(&self) -> Verdict {
        let d = self.decision;
        let best = d.scored.first().map_or(0.0, |s| s.probability);
        // A fault that two sensors show stands, whatever the motion does besides.
        if self.has_sensor_fault() {
            Verdict::Explained
        } else if d.unknown > ANSWER.likely {
            Verdict::Unknown
        } else if d.scored.iter().map(|s| s.probability).sum::<f64>() > d.none && best > 0.0 {
            Verdict::Explained
        } else {
            Verdict::NoMismatch
        }
    }

    fn has_sensor_fault(&self) -> bool {
        self.sensors.faults.iter().any(|f| f.probability > ANSWER.likely)
    }

    /// Whether sensors are wrong and the motion shows nothing that no name explains.
    pub(crate) fn is_of_sensors_alone(&self) -> bool {
        self.has_sensor_fault() && self.decision.unknown <= ANSWER.likely
    }

    fn causes(&self) -> Vec<Cause> {
        let either = self.decision.on_either_side();
        let mut by_effect: BTreeMap<(&str, Option<usize>), (f64, &Scored, usize)> = BTreeMap::new();
        for s in &self.decision.scored {
            for (i, (v, _)) in s.trial.hypothesis.parts.iter().enumerate() {
                let id = v.spec().id;
                let slot = by_effect.entry((id, v.side().filter(|_| either.contains(id)))).or_insert((0.0, s, i));
                slot.0 += s.probability;
            }
        }
        let mut out: Vec<Cause> = by_effect.into_values().map(|(p, s, i)| self.cause(s, i, p)).collect();
        let mut none = self.decision.none;
        for fault in &self.sensors.faults {
            out.extend(fault.causes());
            none *= 1.0 - fault.probability;
        }
        out.push(Cause::plain(NONE.id, NONE.name, none));
        out.push(Cause::plain(UNKNOWN.id, UNKNOWN.name, self.decision.unknown));
        out.retain(|c| c.probability >= ANSWER.listed || c.effect == NONE.id || c.effect == UNKNOWN.id);
        out.sort_by(|a, b| b.probability.total_cmp(&a.probability).then(a.effect.cmp(&b.effect)));
        out
    }

    pub(crate) fn cause(&self, scored: &Scored, part: usize, probability: f64) -> Cause {
        let trial = &scored.trial;
        let (variant, onsets) = &trial.hypothesis.parts[part];
        let before: usize = trial.hypothesis.parts[..part].iter().map(|(v, _)| v.count()).sum();
        let free = variant.free(&self.problem.sizes());
        let e = &trial.fitted.point.effects[before..before + free.len()];
        let sigmas = self.sigmas(&trial.hypothesis, &trial.fitted);
        let spec = variant.spec();
        let strengths = variant.strengths().len();
        let moved = stand_in::sigma_of_size(self.problem, variant, e[0]).hypot(stand_in::mass_elsewhere(
            self.problem,
            variant,
            &trial.fitted.point.theta,
        ));
        let [curvature, model_error] = self.margins();
        let model_error = model_error.hypot(spec.law_error);
        let curvature = curvature * self.misfit(&trial.fitted).sqrt();
        let mut place = None;
        let mut of_disc = ["x", "y", "radius"].into_iter();
        let parameters = free
            .iter()
            .zip(e)
            .enumerate()
            .filter_map(|(i, (f, &value))| {
                let name = f.parameter.map_or_else(|| of_disc.next(), |i| Some(spec.parameters[i].name))?;
                let model = if f.parameter.is_some() { model_error * value } else { 0.0 };
                let model = if i == 0 { model.hypot(moved) } else { model };
                let sigma = sigmas.as_ref().map(|s| (curvature * s[before + i]).hypot(model));
                let at_bound = value <= f.bounds[0] || value >= f.bounds[1];
                Some((name.to_owned(), Estimate { value, sigma, at_bound }))
            })
            .collect();
        if variant.place == Place::Disc {
            let d = &e[free.len() - 3..];
            place = Some([d[0], d[1], d[2]]);
        }
        let intervals = match variant.place {
            Place::Disc => place.map(|d| self.inside(d)),
            _ if variant.begins() => Some(self.after(onsets)),
            _ => None,
        };
        let side = variant.side();
        let sigma = sigmas.as_ref().map(|s| {
            let norm: f64 = e[..strengths].iter().map(|x| x * x).sum::<f64>().sqrt().max(1e-12);
            let of_fit: f64 = s[before..before + strengths].iter().zip(e).map(|(s, x)| (s * x / norm).powi(2)).sum();
            let model = model_error * variant.magnitude(e);
            (curvature.powi(2) * of_fit + model.powi(2) + moved.powi(2)).sqrt()
        });
        Cause {
            effect: spec.id.to_owned(),
            name: inference::words::variant(variant),
            probability: probability.min(1.0),
            magnitude: Some(variant.magnitude(e)),
            sigma,
            unit: inference::words::unit(spec).into(),
            parameters,
            side: side.map(|s| inference::words::side(s).into()),
            place,
            intervals,
        }
    }

    /// One sigma of a size in sigmas of the curvature, and the share of a size that the model gets wrong.
    fn margins(&self) -> [f64; 2] {
        if self.problem.has_references {
            [ANSWER.curvature, ANSWER.model_error]
        } else {
            [ANSWER.curvature_without, ANSWER.model_error_without]
        }
    }

    /// How many times what a fault-free drive costs a fit costs, at least one: by so much the residuals are larger than the
    /// noise that its curvature knows of (Birge's ratio, squared; Birge 1932).
    fn misfit(&self, fitted: &Fitted) -> f64 {
        let fault_free = fault_free_cost(self.problem, &self.calibration.regimes.scatter);
        (self.problem.misfit(&fitted.response) / fault_free.max(1.0)).max(1.0)
    }

    /// One sigma of every free value of a fit, from the curvature of its cost.
    fn sigmas(&self, h: &Hypothesis, fitted: &Fitted) -> Option<Vec<f64>> {
        let p = self.problem;
        let columns = p.effect_columns(&fitted.point, h, &fitted.response);
        let mut normal = p.normal(&fitted.point, &fitted.response, &fitted.columns, &columns)?;
        p.with_prior(&fitted.point, &mut normal);
        let n = normal.matrix.nrows();
        for i in NUISANCES..n {
            normal.matrix[(i, i)] += fit::SETTINGS.fit.whiff_of_sigmas;
        }
        let (inverse, _) = solve_spd(&normal.matrix, &Mat::identity(n, n))?;
        let free = h.free(&p.sizes());
        Some(
            free.iter()
                .enumerate()
                .map(|(i, f)| inverse[(NUISANCES + i, NUISANCES + i)].max(0.0).sqrt() * f.unit)
                .collect(),
        )
    }

    /// The whole diagnosis.
    pub(crate) fn diagnosis(&self, retuned: &Fitted, screened: Vec<(String, f64)>) -> Diagnosis {
        let forecasts = leave_one_out(self, retuned);
        let wheels = || {
            let of_wheels = forecasts.free_runs.iter().filter(|row| row.quantity == QUANTITIES[0]);
            Standing::new(&of_wheels.cloned().collect::<Vec<_>>())
        };
        let is_asked = self.verdict() == Verdict::Explained && !self.is_of_sensors_alone();
        match self.decision.refuted_by(if is_asked { wheels() } else { None }) {
            Some(decision) => Judged { decision: &decision, ..*self }.told(retuned, screened, forecasts),
            None => self.told(retuned, screened, forecasts),
        }
    }

    /// The same with forecasts of what was left out.
    fn told(&self, retuned: &Fitted, screened: Vec<(String, f64)>, forecasts: Forecasts) -> Diagnosis {
        let p = self.problem;
        let verdict = self.verdict();
        let ranked = self.causes();
        let none = Hypothesis::default();
        let calibrated = p.response(&p.origin(), &none);
        let winner = self.winner();
        let theta = winner.map_or(retuned.point.theta, |w| w.trial.fitted.point.theta);
        let worthwhile = is_worthwhile(p, &calibrated, &forecasts.free_runs);
        let (corrector, forecaster) = if worthwhile { (winner, theta) } else { (None, p.centre) };
        let gyro = self.sensors.gyro;
        let predictions = self
            .case
            .held_out
            .iter()
            .map(|h| {
                let given = self.case.effects.doses(&h.name);
                let named = corrector
                    .map_or(Vec::new(), |w| w.trial.hypothesis.lasting().doses(&w.trial.fitted.point.effects, 0));
                let predict = |theta, effects: &[Dose], gyro| {
                    let active: Vec<_> = effects.iter().map(Dose::active).collect();
                    predict(h, &tuned(p.robot, &p.sigma, theta), &active, gyro, self.options.step)
                };
                let corrected = predict(&forecaster, &[given.clone(), named].concat(), gyro);
                let plain = predict(&p.centre, &given, GyroError::default());
                (corrected, plain)
            })
            .collect();
        let fault_free = fault_free_cost(p, &self.calibration.regimes.scatter);
        // What a refuted hypothesis leaves is no measure of what is explained.
        let is_measured = (winner.is_some() || verdict == Verdict::Unknown) && self.decision.refuted.is_none();
        let unexplained = is_measured.then(|| self.decision.level.share());
        // What a sensor shows wrongly is no part of the motion that is forecast.
        let forecasts_tell = verdict == Verdict::Explained && !self.is_of_sensors_alone();
        let standing = Standing::new(&forecasts.free_runs).filter(|_| forecasts_tell);
        let as_good = forecasts.placebo.as_ref().filter(|_| standing.is_some_and(|s| s.is_matched_by_placebo()));
        let indistinguishable = self.rivals(&ranked, verdict, as_good);
        let tuning = tunables::<f64>().iter().zip(theta).map(|(t, x)| (t.id.to_owned(), x)).collect();
        let mut correction = corrector.map_or_else(
            || p.correction(&none, &forecaster, &[]),
            |w| p.correction(&w.trial.hypothesis, &forecaster, &w.trial.fitted.point.effects),
        );
        correction.effects.extend(self.sensors.faults.iter().map(Fault::effect));
        let fitted = winner.map_or(retuned, |w| &w.trial.fitted);
        let located = locate::locate(self, &calibrated, fitted, &forecasts, unexplained, &ranked);
        let mut limits = self.limits();
        limits.extend(retuned::moved_by_visit(p, fitted, &self.case.recordings));
        limits.extend(own_effects::beyond_range(p, retuned, &ranked));
        limits.extend(located.contradiction);
        limits.extend(self.decision.unconfirmed.iter().map(Unconfirmed::sentence));
        let wrong = forecasts.placebo.as_ref().map(|s| inference::words::variants(s.trial.hypothesis.variants()));
        limits.extend(standing.and_then(|s| s.doubt(&forecasts.free_runs, wrong.as_deref())));
        if verdict == Verdict::NoMismatch {
            limits.extend(Standing::new(&forecasts.free_runs).and_then(|s| s.objection_to_re_tuning()));
        }
        if winner.is_some() && !worthwhile {
            limits.push(
                "the correction does not improve the forecasts of recordings left out of the fit: \
                 held-out drives are predicted without it"
                    .to_owned(),
            );
        }
        let mut out = Diagnosis {
            format: FORMAT,
            verdict,
            sentences: Vec::new(),
            ranked,
            indistinguishable,
            findings: located.findings,
            cells: located.cells,
            located: located.told,
            free_runs: [forecasts.free_runs, forecasts.whole].concat(),
            unexplained,
            limits,
            trials: self.trials(retuned),
            costs: [p.misfit(&calibrated), retuned.cost, fault_free],
            null_scores: self.calibration.null_scores.of_references.clone(),
            screened,
            tuning,
            retuned: self.retuned(verdict, winner.map_or(&none, |w| &w.trial.hypothesis), fitted),
            simulator: self.simulator.map(|s| s.told.clone()),
            correction,
            traces: located.traces,
            steady: None,
            response: None,
            next: None,
            law: None,
            own_effects: p.known.told(),
            coverage: BTreeMap::new(),
            predicted_paths: Vec::new(),
            predictions,
        };
        out.sentences = words::sentences(&out, self);
        out
    }

    fn trials(&self, retuned: &Fitted) -> Vec<Trial> {
        let p = self.problem;
        let row = |s: &Scored| Trial {
            hypothesis: s.trial.hypothesis.parts.iter().map(|(v, _)| v.label()).collect(),
            gain: retuned.cost - s.trial.fitted.cost,
            visits: s.visits,
            score: s.score,
            probability: s.probability,
            correction: p.correction(&s.trial.hypothesis, &s.trial.fitted.point.theta, &s.trial.fitted.point.effects),
        };
        self.decision.scored.iter().map(row).collect()
    }

    /// Classes of causes that these recordings cannot tell apart: sensor faults that show in the same redundancy, and the
    /// rivals of the best hypothesis.
    fn rivals(&self, ranked: &[Cause], verdict: Verdict, as_good: Option<&Scored>) -> Vec<Vec<String>> {
        let of_sensors = self.sensors.faults.iter().map(|f| iter::once(f.spec).chain(f.alike()));
        let mut out: Vec<Vec<String>> = of_sensors.map(|all| all.map(|s| s.id.to_owned()).collect()).collect();
        out.retain(|class| class.len() > 1);
        out.sort_unstable();
        out.dedup();
        out.extend(self.rivals_of_winner(ranked, verdict, as_good));
        out
    }

    fn is_of_sensor(&self, effect: &str) -> bool {
        self.sensors.faults.iter().any(|f| f.spec.id == effect || f.alike().any(|s| s.id == effect))
    }

    /// The best hypothesis with effects of the same kind of probability, and with a wrong cause that forecasts left-out
    /// recordings as well.
    fn rivals_of_winner(&self, ranked: &[Cause], verdict: Verdict, as_good: Option<&Scored>) -> Option<Vec<String>> {
        let winner = self.winner().filter(|_| verdict == Verdict::Explained)?;
        // Alternatives to the best hypothesis, not its own second member.
        let members = winner.trial.hypothesis.ids();
        let best = members
            .iter()
            .filter_map(|m| ranked.iter().find(|c| c.effect == *m))
            .map(|c| c.probability)
            .fold(0.0, f64::max);
        let as_good = as_good.map_or_else(Vec::new, |s| s.trial.hypothesis.ids());
        let weighed: Vec<(Vec<&str>, f64)> =
            self.decision.scored.iter().map(|s| (s.trial.hypothesis.ids(), s.probability)).collect();
        let rivals: Vec<String> = ranked
            .iter()
            .filter(|c| c.effect != NONE.id && c.effect != UNKNOWN.id && !members.contains(&c.effect.as_str()))
            .filter(|c| {
                let competes =
                    instead(&weighed, &members, &c.effect) > ANSWER.rival * best && !self.is_of_sensor(&c.effect);
                competes || as_good.contains(&c.effect.as_str())
            })
            .map(|c| c.effect.clone())
            .collect();
        (!rivals.is_empty()).then(|| members.iter().map(|m| (*m).to_owned()).chain(rivals).collect())
    }
}

/// Probability that an effect is there and a member of the best hypothesis is not: what is likely only beside that hypothesis is no
/// alternative to it.
fn instead(weighed: &[(Vec<&str>, f64)], members: &[&str], effect: &str) -> f64 {
    let lacks_a_member = |ids: &[&str]| members.iter().any(|m| !ids.contains(m));
    weighed.iter().filter(|(ids, _)| ids.contains(&effect) && lacks_a_member(ids)).map(|(_, p)| p).sum()
}

#[cfg(test)]
mod tests {
    use super::instead;

    #[test]
    fn what_is_likely_only_beside_the_best_hypothesis_is_no_alternative_to_it() {
        let weighed =
            [(vec!["pull"], 0.6), (vec!["pull", "gain"], 0.2), (vec!["scrub"], 0.15), (vec!["scrub", "gain"], 0.05)];
        let of = |effect: &str| instead(&weighed, &["pull"], effect);
        approx::assert_abs_diff_eq!(of("gain"), 0.05);
        approx::assert_abs_diff_eq!(of("scrub"), 0.2);
        // Of two members either may be the one that is not there.
        approx::assert_abs_diff_eq!(instead(&weighed, &["pull", "gain"], "scrub"), 0.2);
    }
}
