//! Refits that a search is made of.

use robot_model::EffectSpec;

use crate::candidate::{Candidate, sizes_tried};
use crate::fit::{Fitted, Hypothesis, Point, Problem};
use crate::settings::search::{Finalists, Pairs, SETTINGS};
use crate::stand_in::StandIn;
use crate::trial::{Trial, include};
use crate::{disc, handed_over, later_side, onset};
use inference::hypothesis::Variant;

const FINALISTS: Finalists = SETTINGS.finalists;
const PAIRS: Pairs = SETTINGS.pairs;

/// Places that are left to common and to rare effects.
pub(crate) struct Places(pub(crate) [usize; 2]);

impl Places {
    /// Takes a place for `spec`, if one is left.
    pub(crate) fn take(&mut self, spec: &EffectSpec) -> bool {
        let left = &mut self.0[usize::from(spec.rarity > 0.0)];
        let free = *left > 0;
        *left -= usize::from(free);
        free
    }
}

/// Distinct ids in the order of evidence, with the best candidate of each.
pub(crate) fn by_id(candidates: &[Candidate]) -> Vec<&Candidate> {
    let mut out: Vec<&Candidate> = Vec::new();
    for c in candidates {
        if !out.iter().any(|o| o.variant.spec().id == c.variant.spec().id) {
            out.push(c);
        }
    }
    out
}

pub(crate) fn begin(problem: &Problem<'_>, h: &Hypothesis, point: &Point, effects: &[f64], base: &Fitted) -> Fitted {
    let point = Point { effects: effects.to_vec(), ..point.clone() };
    problem.begin(h, point, Some(base.columns.clone()))
}

/// A first refit, with the columns of θ that are there: they are renewed where it may win.
fn refit(problem: &Problem<'_>, h: Hypothesis, start: Fitted, steps: usize, renew: Option<usize>) -> Trial {
    let fitted = problem.refine(&h, start, steps, renew);
    let mut trial = Trial { hypothesis: h, fitted };
    onset::scan(problem, &mut trial);
    onset::settle(problem, &mut trial);
    trial
}

/// From which constants the refits of a search start.
#[derive(Clone, Copy)]
pub(crate) struct Starts<'a> {
    /// A fit where the robot file or the references have them.
    pub(crate) origin: &'a Fitted,
    /// Whether that is so far from the recordings that a fit may not arrive.
    pub(crate) is_far: bool,
    /// Whether it may be so by the constants: no reference taught them, so that fits start from re-tuned ones too.
    pub(crate) tries_both_tunings: bool,
}

impl Starts<'_> {
    /// Where the origin is far from the recordings a tangent there says little of how large an effect is: values of a single effect
    /// whose free run from the origin costs least; `None` where that is near, or these are those of the tangent.
    pub(crate) fn size_by_free_run(self, problem: &Problem<'_>, h: &Hypothesis, tangent: &[f64]) -> Option<Vec<f64>> {
        let (variant, _) = h.parts.first().filter(|_| self.is_far && h.parts.len() == 1)?;
        let [size, ..] = variant.free(&problem.sizes())[..] else { return None };
        let with = |value: f64| -> Vec<f64> { std::iter::once(value).chain(tangent.iter().skip(1).copied()).collect() };
        let cost = |values: &[f64]| begin(problem, h, &self.origin.point, values, self.origin).cost;
        let tried = sizes_tried(&size).map(with).map(|values| (cost(&values), values));
        let (own, best) = tried.min_by(|a, b| a.0.total_cmp(&b.0))?;
        (own < cost(tangent)).then_some(best)
    }

    /// A first refit from the origin and, where both tunings are tried, from the constants of what was fitted before; the better.
    pub(crate) fn refit(self, problem: &Problem<'_>, h: &Hypothesis, effects: &[f64], before: &Fitted) -> Trial {
        let first = refit_from(problem, h, effects, self.origin);
        if self.tries_both_tunings { better(first, refit_from(problem, h, effects, before)) } else { first }
    }
}

/// A first refit from the constants of another fit.
pub(crate) fn refit_from(problem: &Problem<'_>, h: &Hypothesis, effects: &[f64], base: &Fitted) -> Trial {
    refit(problem, h.clone(), begin(problem, h, &base.point, effects, base), FINALISTS.steps, None)
}

/// The trial that fits better.
pub(crate) fn better(first: Trial, second: Trial) -> Trial {
    if second.fitted.cost < first.fitted.cost { second } else { first }
}

/// Refits a trial that may win: more steps, and its place looked for by exact free runs.
pub(crate) fn polish(problem: &Problem<'_>, trial: &Trial, steps: usize) -> Trial {
    let mut trial = trial.clone();
    disc::scan(problem, &mut trial);
    let mut trial = refit(problem, trial.hypothesis, trial.fitted, steps, Some(0));
    disc::scan(problem, &mut trial);
    trial
}

/// Fits effects that are a constant under another name again, from the constants of the best single effect, each with the size
/// whose free run costs least there: what is nearly alike (a torque constant and an extra mass) is compared where both have arrived.
pub(crate) fn refit_from_the_best(problem: &Problem<'_>, singles: &mut [Trial]) {
    let [best, rivals @ ..] = singles else { return };
    let is_close = |rival: &&mut Trial| {
        let is_constant = |variant: &Variant| StandIn::of(variant, problem.robot).is_some();
        rival.fitted.cost < best.fitted.cost + FINALISTS.close && rival.hypothesis.variants().all(is_constant)
    };
    for rival in rivals.iter_mut().filter(is_close).take(FINALISTS.most_close) {
        let h = &rival.hypothesis;
        let ([_, others @ ..], [size, ..]) = (rival.fitted.point.effects.as_slice(), &h.free(&problem.sizes())[..])
        else {
            continue;
        };
        let with = |value: f64| begin(problem, h, &best.fitted.point, &[&[value], others].concat(), &best.fitted);
        let starts = sizes_tried(size).map(with);
        let Some(start) = starts.min_by(|a, b| a.cost.total_cmp(&b.cost)) else { continue };
        let again = refit(problem, h.clone(), start, FINALISTS.more_steps, Some(0));
        if again.fitted.cost < rival.fitted.cost {
            *rival = again;
        }
    }
    best_first(singles);
}

/// Adds effects that may hide in a constant which was re-tuned far beside `h`, each in the better of both fits.
pub(crate) fn include_handed_over(problem: &Problem<'_>, h: &Hypothesis, fitted: &Fitted, trials: &mut Vec<Trial>) {
    let starts = handed_over::starts(problem, h, fitted);
    for (hypothesis, point) in starts.into_iter().chain(handed_over::starts_beyond_stops(problem, h, fitted)) {
        let start = problem.begin(&hypothesis, point, Some(fitted.columns.clone()));
        let trial = refit(problem, hypothesis, start, FINALISTS.more_steps, Some(2));
        include(trials, trial);
    }
}

/// Fits what a hypothesis holds with one effect less again, from its tuning: a fit that had not converged would invent a
/// gain for the effect that is added.
pub(crate) fn converge_members(problem: &Problem<'_>, whole: &Trial, members: &mut [Trial]) {
    for member in members.iter_mut().filter(|t| t.hypothesis.parts.len() + 1 == whole.hypothesis.parts.len()) {
        let Some(effects) = whole.hypothesis.values_of(&member.hypothesis, &whole.fitted.point.effects) else {
            continue;
        };
        if member.fitted.cost - whole.fitted.cost > PAIRS.least_second {
            let point = handed_over::taken_back(problem, whole, &member.hypothesis, effects);
            let start = problem.begin(&member.hypothesis, point, Some(whole.fitted.columns.clone()));
            let again = problem.refine(&member.hypothesis, start, FINALISTS.more_steps, Some(2));
            if again.cost < member.fitted.cost {
                member.fitted = again;
            }
        }
    }
    best_first(members);
}

/// Fits the hypothesis that keeps some of a trial's effects, from where that trial has them; `None` where it lacks one of them.
pub(crate) fn keeping(problem: &Problem<'_>, whole: &Trial, kept: Hypothesis) -> Option<Trial> {
    let effects = whole.hypothesis.values_of(&kept, &whole.fitted.point.effects)?;
    let point = handed_over::taken_back(problem, whole, &kept, effects);
    let start = problem.begin(&kept, point, Some(whole.fitted.columns.clone()));
    let fitted = problem.refine(&kept, start, FINALISTS.more_steps, Some(2));
    Some(Trial { hypothesis: kept, fitted })
}

/// Fits hypotheses that hold all of `part`, and more, again from its tuning where they fit no better than it alone: these
/// cannot have converged.
pub(crate) fn converge_wholes(problem: &Problem<'_>, part: &Trial, wholes: &mut Vec<Trial>) {
    for whole in wholes.iter_mut().filter(|whole| whole.fitted.cost > part.fitted.cost) {
        let effects = &whole.fitted.point.effects;
        if whole.hypothesis.values_of(&part.hypothesis, effects).is_none() {
            continue;
        }
        let start = begin(problem, &whole.hypothesis, &part.fitted.point, effects, &part.fitted);
        let again = problem.refine(&whole.hypothesis, start, FINALISTS.more_steps, Some(2));
        if again.cost < whole.fitted.cost {
            whole.fitted = again;
        }
    }
    let is_alone = part.hypothesis.variants().any(|variant| later_side::is_alone(problem, variant));
    if problem.constants_are_loose && !is_alone {
        include_handed_over(problem, &part.hypothesis, &part.fitted, wholes);
    }
    best_first(wholes);
}

pub(crate) fn best_first(trials: &mut [Trial]) {
    trials.sort_by(|a, b| a.fitted.cost.total_cmp(&b.fitted.cost));
}

#[cfg(test)]
mod tests {
    use testing::robot;

    use super::*;
    use crate::nothing::retune;
    use crate::run_numbers::constant;
    use crate::testing::{cutting, driven, problem};
    use crate::windows::cut;
    use inference::hypothesis::{Dose, Place, Variant};

    #[test]
    fn where_the_origin_is_far_free_runs_tell_how_large_an_effect_is() {
        let robot = robot();
        let blank = problem(&robot, &[]);
        let is_payload = |v: &Variant| v.spec().id == "payload" && v.place == Place::Whole;
        let payload = blank.variants().into_iter().find(is_payload).expect("in the catalogue");
        let doses: Vec<Dose> = vec![payload.dose(&[14.0], None)];
        let cuts = [cut(&driven(&robot, &doses, 12.0), &cutting())];
        let p = problem(&robot, &cuts);
        let origin = p.begin(&Hypothesis::default(), p.origin(), None);
        let h = Hypothesis::single(payload, Vec::new());
        let starts = Starts { origin: &origin, is_far: true, tries_both_tunings: false };
        let sized = starts.size_by_free_run(&p, &h, &[0.3]).expect("a better start");
        assert!((9.0..20.0).contains(&sized[0]), "{sized:?}");
        assert_eq!(starts.size_by_free_run(&p, &h, &[14.0]), None, "nothing costs less than the truth");
        let near = Starts { is_far: false, ..starts };
        assert_eq!(near.size_by_free_run(&p, &h, &[0.3]), None);
    }

    #[test]
    fn what_looks_like_the_best_effect_is_fitted_again_from_its_constants() {
        let robot = robot();
        let blank = problem(&robot, &[]);
        let of = |id: &str| -> Hypothesis {
            let is_whole = |v: &Variant| v.spec().id == id && v.place == Place::Whole;
            Hypothesis::single(blank.variants().into_iter().find(is_whole).expect("in the catalogue"), Vec::new())
        };
        let (payload, torque) = (of("payload"), of("torque_constant"));
        let cuts = [cut(&driven(&robot, &payload.doses(&[14.0], 0), 12.0), &cutting())];
        let p = Problem { has_references: false, constants_are_loose: true, ..problem(&robot, &cuts) };

        // As a fit that went astray left it, beside the truth.
        let best =
            Trial { fitted: p.begin(&payload, Point { effects: vec![14.0], ..p.origin() }, None), hypothesis: payload };
        let mut astray = p.begin(&torque, Point { effects: vec![0.0], ..p.origin() }, None);
        astray.cost = best.fitted.cost + 0.9 * FINALISTS.close;
        let mut singles = vec![best, Trial { fitted: astray.clone(), hypothesis: torque }];
        refit_from_the_best(&p, &mut singles);
        assert_eq!(singles[0].hypothesis.ids(), ["payload"]);
        let again = &singles[1].fitted;
        assert!(again.cost < astray.cost && again.point.effects[0] < -0.05, "{} {:?}", again.cost, again.point.effects);

        // What is no constant is not tried.
        let mut pull = vec![singles[0].clone(), Trial { fitted: astray.clone(), hypothesis: of("constant_pull") }];
        refit_from_the_best(&p, &mut pull);
        approx::assert_relative_eq!(pull[1].fitted.cost, astray.cost);
    }

    #[test]
    fn without_references_a_fit_takes_more_steps() {
        let robot = robot();
        let cuts = [cut(&driven(&robot, &[], 12.0), &cutting())];
        let known = Problem { constants_are_loose: true, ..problem(&robot, &cuts) };
        let by_file = Problem { has_references: false, ..known.clone() };
        let mut point = known.origin();
        point.theta[constant("viscous")] += 4.0;
        let left = |p: &Problem<'_>| {
            let start = p.begin(&Hypothesis::default(), point.clone(), None);
            p.refine(&Hypothesis::default(), start, 1, None).cost
        };
        assert!(left(&by_file) < 0.5 * left(&known), "{} {}", left(&by_file), left(&known));
    }

    #[test]
    fn two_effects_that_fit_worse_than_one_of_them_are_fitted_again_and_a_loose_constant_becomes_its_effect() {
        let robot = robot();
        let blank = problem(&robot, &[]);
        let of = |id: &str| -> Variant {
            let is_whole = |v: &Variant| v.spec().id == id && v.place == Place::Whole;
            blank.variants().into_iter().find(is_whole).expect("in the catalogue")
        };
        let (drag, viscous) = (of("quadratic_drag"), of("viscous_friction"));
        let size = |v: &Variant| v.free(&blank.sizes())[0].usual;
        let doses: Vec<Dose> = vec![drag.dose(&[size(&drag)], None), viscous.dose(&[size(&viscous)], None)];
        let cuts = [16.0, 20.0].map(|seconds| cut(&driven(&robot, &doses, seconds), &cutting()));
        let loose = Problem { constants_are_loose: true, ..problem(&robot, &cuts) };

        // One effect, beside which the constant of the other has moved.
        let single = Hypothesis::single(drag, Vec::new());
        let start = loose.begin(&single, Point { effects: vec![size(&drag)], ..loose.origin() }, None);
        let single = Trial { fitted: retune(&loose, &single, start), hypothesis: single };
        let viscous_at = constant("viscous");
        assert!(single.fitted.point.theta[viscous_at] > 1.6, "{:?}", single.fitted.point.theta);

        // Both, as a fit that went astray left them.
        let both = Hypothesis { parts: vec![(drag, Vec::new()), (viscous, Vec::new())], acting: None };
        let astray = loose.begin(&both, Point { effects: vec![0.0, 0.0], ..loose.origin() }, None);
        assert!(astray.cost > single.fitted.cost);
        let mut wholes = vec![Trial { hypothesis: both, fitted: astray }];
        converge_wholes(&loose, &single, &mut wholes);
        assert!(wholes[0].fitted.cost <= single.fitted.cost, "{} {}", wholes[0].fitted.cost, single.fitted.cost);

        // The same pair is found where nobody tried it, and not where constants are known.
        let mut none = Vec::new();
        converge_wholes(&loose, &single, &mut none);
        let found: Vec<_> = none.iter().map(|t| t.hypothesis.ids()).collect();
        assert!(found.contains(&vec!["quadratic_drag", "viscous_friction"]), "{found:?}");
        let mut none = Vec::new();
        converge_wholes(&problem(&robot, &cuts), &single, &mut none);
        assert!(none.is_empty());
    }
}
