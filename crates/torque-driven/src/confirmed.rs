//! Whether recordings that were left out of the fit need the effects of an answer.
//!
//! The laws of the plant are not quite the robot's, and what a fit gains by an effect may be what their form lacks. Recordings that
//! were left out tell: `Δ = Σ (Fᵢ without − Fᵢ with)`, the gain in their segments' costs `F`, and its standard error from how it differs
//! between segments (leave-one-out cross-validation: Vehtari, Gelman and Gabry 2017, Statistics and Computing 27, 1413, section 5).

use inference::hypothesis::{Place, Variant};
use inference::robust::mean_with_error;
use rayon::prelude::*;

use crate::calibrate::problem;
use crate::decision::{Decision, Scored};
use crate::fit::{Fitted, Hypothesis, Point, Problem, is_at_a_stop};
use crate::judged::Judged;
use crate::leave_out::{Model, all_but, fitted_on_others, forecast, without};
use crate::refits;
use crate::settings::decision::{Confirmation, Prices, SETTINGS};
use crate::stand_in::StandIn;

use crate::trial::Trial;

const RULES: Confirmation = SETTINGS.confirmation;
const PRICES: Prices = SETTINGS.prices;

/// An effect that recordings left out of the fit do not need.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Unconfirmed {
    /// The effect, for people.
    name: String,
    /// What left-out recordings gain by it, and its standard error, nats.
    gain: [f64; 2],
}

impl Unconfirmed {
    /// Whether the gain is beyond its errors, or is as much as an effect has to gain to be named at all, whatever its errors.
    fn is_needed(&self) -> bool {
        let [gain, error] = self.gain;
        gain > (RULES.errors * error).min(PRICES.none + PRICES.per_effect)
    }

    /// Why it is not named, for people.
    pub(crate) fn sentence(&self) -> String {
        let Self { name, gain: [gain, error] } = self;
        format!(
            "{name} is not named: recordings left out of the fit are forecast no better with it ({gain:.1} \u{b1} {error:.1} nats of \
             log-likelihood, one standard error) than without it"
        )
    }
}

impl Judged<'_> {
    /// The decision in which no effect is named that left-out recordings do not need: most of its probability is that of the hypothesis
    /// without it. Of a lone recording nothing is left out.
    pub(crate) fn without_unconfirmed(&self, retuned: &Fitted) -> Decision {
        let mut out = self.decision.clone();
        if self.problem.cuts.len() < 2 {
            return out;
        }
        for _ in 0..RULES.rounds {
            let names_something = out.scored.iter().map(|s| s.probability).sum::<f64>() > out.none;
            let Some(best) = out.scored.first().filter(|_| names_something).cloned() else { break };
            let Some((rest, unconfirmed)) = self.least_needed(&best, &out, retuned) else { break };
            self.hand_on(&mut out, 0, rest, 1.0 - RULES.doubted);
            out.unconfirmed.push(unconfirmed);
            out.scored.sort_by(|a, b| b.probability.total_cmp(&a.probability));
        }
        out
    }

    /// The effect of a hypothesis that left-out recordings need least, if they do not need it, and the hypothesis without it.
    fn least_needed(&self, best: &Scored, all: &Decision, retuned: &Fitted) -> Option<(Hypothesis, Unconfirmed)> {
        let parts = best.trial.hypothesis.parts.iter().enumerate();
        let is_alone = best.trial.hypothesis.parts.len() == 1;
        let asked = parts.filter(|(_, (variant, _))| !is_alone || self.is_told_by_forecasts(variant)).map(|(i, _)| i);
        let asked: Vec<usize> = asked.filter(|part| !self.shows_once(&best.trial, *part)).collect();
        if asked.is_empty() {
            return None;
        }

        let with = left_out_costs(self, &best.trial);
        let judged = asked.into_iter().filter_map(|part| {
            let mut rest = best.trial.hypothesis.clone();
            let (variant, _) = rest.parts.remove(part);
            let without = self.fit_of(&rest, best, all, retuned)?;
            // Constants as far from the robot file as a fit may go are no alternative, however well they forecast.
            if at_stops(&without.fitted) > at_stops(&best.trial.fitted) {
                return None;
            }
            // Nor is one that lies beyond belief where the effect leaves it near: any, or the one that is the effect under another name.
            let both = [&without, &best.trial];
            let own = StandIn::of(&variant, self.problem.robot).filter(|constant| !constant.may_be_of_tyres());
            let of_own = own.map(|constant| both.map(|trial| moves(self.problem, &trial.fitted)[constant.place]));
            let all = both.map(|trial| farthest(self.problem, &trial.fitted));
            if is_beyond_belief(all) || of_own.is_some_and(is_beyond_belief) {
                return None;
            }
            let without = left_out_costs(self, &without);
            Some((rest, Unconfirmed { name: inference::words::variant(&variant), gain: gain(&without, &with) }))
        });
        judged.filter(|(_, effect)| !effect.is_needed()).min_by(|(_, a), (_, b)| a.gain[0].total_cmp(&b.gain[0]))
    }

    /// Whether forecasts can tell that an effect is not needed that is named alone. Without references a constant within what the robot file states forecasts as
    /// well as an effect that is the same constant under another name: only of what tyres look like does that say anything. Beside another
    /// effect each has to be needed.
    fn is_told_by_forecasts(&self, variant: &Variant) -> bool {
        let stands_in = StandIn::of(variant, self.problem.robot);
        self.problem.has_references || stands_in.is_none_or(StandIn::may_be_of_tyres)
    }

    /// Whether one recording alone shows an effect that is always there, and the others do not show it though they have it: then none of them
    /// can confirm it.
    pub(crate) fn shows_once(&self, trial: &Trial, part: usize) -> bool {
        let p = self.problem;
        let variant = &trial.hypothesis.parts[part].0;
        if variant.begins() || variant.place == Place::Disc {
            return false;
        }
        let sized = |point: &Point, share: f64| {
            let mut point = point.clone();
            let before: usize = trial.hypothesis.variants().take(part).map(Variant::count).sum();
            let own = variant.strengths().len();
            point.effects[before..before + own].iter_mut().for_each(|size| *size *= share);
            point
        };
        let whole = &trial.fitted.point;
        let cost = |point: &Point, run: usize| -> f64 {
            let response = p.run_response(run, point, &trial.hypothesis);
            response.iter().enumerate().map(|(s, y)| p.segment_cost(run, s, p.q(run, s, y))).sum()
        };
        let (with, without) = (sized(whole, 1.0), sized(whole, 0.0));
        let shows = |run: &usize| cost(&without, *run) - cost(&with, *run) > RULES.shows;
        let shown: Vec<usize> = (0..p.cuts.len()).filter(shows).collect();
        let [run] = shown[..] else { return false };

        let others = (0..p.cuts.len()).filter(|other| *other != run);
        let of_others = |point: &Point| others.clone().map(|other| cost(point, other)).sum::<f64>();
        (of_others(&without) - of_others(&with)).abs() < RULES.shows
    }

    /// The fit of what is left of a hypothesis: one that was weighed, or a new one.
    fn fit_of(&self, rest: &Hypothesis, of: &Scored, all: &Decision, retuned: &Fitted) -> Option<Trial> {
        if rest.parts.is_empty() {
            return Some(Trial { hypothesis: rest.clone(), fitted: retuned.clone() });
        }
        let weighed = all.scored.iter().find(|s| s.trial.hypothesis.is_of_the_effects_of(rest));
        weighed.map(|s| s.trial.clone()).or_else(|| refits::keeping(self.problem, &of.trial, rest.clone()))
    }
}

/// How many constants are as far from the robot file as a fit may go.
fn at_stops(fitted: &Fitted) -> usize {
    fitted.point.theta.iter().filter(|x| is_at_a_stop(**x)).count()
}

/// By how many sigmas each constant lies from where it is known to be.
fn moves(problem: &Problem<'_>, fitted: &Fitted) -> Vec<f64> {
    fitted.point.theta.iter().zip(problem.centre).map(|(own, centre)| (own - centre).abs()).collect()
}

/// Whether a constant lies farther from where it is known to be than anybody believes, and with an effect near.
fn is_beyond_belief([far, near]: [f64; 2]) -> bool {
    far > RULES.believable && far > RULES.nearer * near
}

/// The same of the constant that lies farthest.
pub(crate) fn farthest(problem: &Problem<'_>, fitted: &Fitted) -> f64 {
    moves(problem, fitted).into_iter().fold(0.0, f64::max)
}

/// What left-out segments gain by a hypothesis over another one, by their costs under both, and its standard error, nats.
pub(crate) fn gain(without: &[f64], with: &[f64]) -> [f64; 2] {
    let of_segments: Vec<f64> = without.iter().zip(with).map(|(without, with)| without - with).collect();
    let (mean, error) = mean_with_error(&of_segments);
    [mean, error].map(|of_segment| of_segment * of_segments.len() as f64)
}

/// What each segment of a recording costs that was left out of the fit of a hypothesis, nats, recordings one after the other.
pub(crate) fn left_out_costs(answer: &Judged<'_>, trial: &Trial) -> Vec<f64> {
    let p = answer.problem;
    let of_run = |run: usize| -> Vec<f64> {
        let cuts = all_but(p, run);
        let others = problem(p.robot, answer.case, &cuts, answer.calibration, p.largest_torque, answer.options);
        let fitted =
            fitted_on_others(&others, &without(&trial.hypothesis, run), &trial.fitted.point, p.constants_are_loose);
        let point = Point { run: p.origin().run, ..fitted.point };
        let response = forecast(p, &Model { hypothesis: trial.hypothesis.clone(), point }, run);
        response.iter().enumerate().map(|(s, y)| p.segment_cost(run, s, p.q(run, s, y))).collect()
    };
    (0..p.cuts.len()).into_par_iter().flat_map_iter(of_run).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{Asked, cutting, driven, problem};
    use crate::windows::{Cut, cut};
    use inference::hypothesis::variants;
    use testing::robot;

    #[test]
    fn a_gain_beyond_its_errors_or_as_large_as_the_price_of_a_name_is_needed() {
        let needed = |gain: [f64; 2]| Unconfirmed { name: String::new(), gain }.is_needed();
        assert!(needed([9.0, 4.0]) && !needed([7.0, 4.0]) && !needed([-9.0, 1.0]));
        assert!(needed([30.0, 20.0]), "much, though one recording is forecast worse");
        let told = Unconfirmed { name: "extra mass".into(), gain: [1.25, 2.5] }.sentence();
        assert!(told.contains("extra mass is not named") && told.contains("1.2 \u{b1} 2.5 nats"), "{told}");
    }

    fn of(id: &str) -> Variant {
        let is_it = |v: &Variant| v.spec().id == id && v.place == Place::Whole;
        variants(true).into_iter().find(is_it).expect("in the catalogue")
    }

    /// The decision about drives of a robot with viscous friction, of so large an effect that was named beside.
    fn judged(cuts: &[Cut], effects: &[(Variant, f64)], has_references: bool) -> Decision {
        let robot = robot();
        let p = crate::fit::Problem { has_references, constants_are_loose: !has_references, ..problem(&robot, cuts) };
        let parts = effects.iter().map(|(v, _)| (*v, Vec::new())).collect();
        let hypothesis = Hypothesis { parts, acting: None };
        let point = crate::fit::Point { effects: effects.iter().map(|(_, size)| *size).collect(), ..p.origin() };
        let fitted = p.refine(&hypothesis, p.begin(&hypothesis, point, None), 4, None);
        let scored = Scored { trial: Trial { hypothesis, fitted }, visits: None, score: 20.0, probability: 0.9 };
        let decision = Decision { scored: vec![scored], none: 0.1, ..Decision::default() };
        let none = Hypothesis::default();
        let retuned = p.refine(&none, p.begin(&none, p.origin(), None), 4, None);
        Asked::new(&p, decision).judged().without_unconfirmed(&retuned)
    }

    #[test]
    fn an_effect_that_left_out_drives_do_not_need_keeps_little_of_its_probability() {
        let (gain, drag, viscous) = (of("torque_constant"), of("quadratic_drag"), of("viscous_friction"));
        let drives = |doses: &[inference::hypothesis::Dose]| {
            [8.0, 10.0, 12.0].map(|s| cut(&driven(&robot(), doses, s), &cutting()))
        };
        let fault_free = drives(&[]);
        let alone = judged(&fault_free, &[(gain, 0.01)], false);
        approx::assert_relative_eq!(alone.none, 0.1 + (1.0 - RULES.doubted) * 0.9, epsilon = 1e-12);
        assert_eq!(alone.unconfirmed.len(), 1);

        let of_drives = judged(&fault_free, &[(viscous, 0.01)], false);
        assert_eq!(of_drives.none, 0.1, "a constant of the file forecasts as well");
        for effect in [viscous, gain] {
            let told = judged(&fault_free, &[(effect, 0.01)], true);
            assert_eq!((told.none, told.unconfirmed.len()), (alone.none, 1), "{} beside references", effect.label());
        }
        let lone = judged(&fault_free[..1], &[(gain, 0.01)], false);
        assert_eq!(lone.none, 0.1, "nothing is left out of one recording");

        let dragged = drives(&[drag.dose(&[20.0], None)]);
        let both = judged(&dragged, &[(drag, 20.0), (gain, 0.01)], false);
        assert_eq!(both.scored[0].trial.hypothesis.ids(), ["quadratic_drag"], "that is there");
        assert_eq!(both.none, 0.1);
    }
}
