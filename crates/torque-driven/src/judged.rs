//! A case whose hypotheses are weighed: what every part of an answer is made of.

use crate::calibrate::Calibration;
use crate::case::Case;
use crate::confirmed::farthest;
use crate::decision::{Decision, Scored};
use crate::fit::{Fitted, Hypothesis, Problem, is_at_a_stop};
use crate::redundancy::Redundant;
use crate::refits;
use crate::settings::decision::SETTINGS;
use crate::simulator::Simulator;
use crate::stand_in::StandIn;
use crate::visit::Visit;
use crate::windows::Cut;
use inference::Options;
use inference::hypothesis::Variant;
use inference::robust::NINETY;
use robot_model::effects::{encoder_scale, wheel_radius_mismatch};
use robot_model::tunable::{Tunable, tunables};
use std::cmp::Reverse;

/// All that an answer is made of.
pub(crate) struct Judged<'a> {
    pub(crate) case: &'a Case,
    pub(crate) options: &'a Options,
    pub(crate) problem: &'a Problem<'a>,
    pub(crate) references: &'a [Cut],
    /// Visits of the references.
    pub(crate) visits: &'a [Option<Visit>],
    pub(crate) calibration: &'a Calibration,
    pub(crate) sensors: &'a Redundant,
    pub(crate) decision: &'a Decision,
    /// What the user's simulator believes.
    pub(crate) simulator: Option<&'a Simulator>,
}

impl Judged<'_> {
    /// The hypothesis the robot is corrected with; `None` when nothing in the motion is to be corrected.
    pub(crate) fn winner(&self) -> Option<&Scored> {
        let d = self.decision;
        let best = d.scored.first()?;
        // Also under "unknown" the best effect still makes a better simulator than none.
        (d.scored.iter().map(|s| s.probability).sum::<f64>() > d.none).then_some(best)
    }

    /// The decision in which no effect stands whose 90 % interval holds no effect at all: what it gains is that of constants that
    /// may have moved, so that its probability is that of the hypothesis without it; alone, of "nothing is missing".
    pub(crate) fn without_sizes_of_zero(&self, retuned: &Fitted) -> Decision {
        let mut out = self.decision.clone();
        let mut longest_first: Vec<usize> = (0..out.scored.len()).collect();
        longest_first.sort_by_key(|&i| Reverse(out.scored[i].trial.hypothesis.parts.len()));
        let mut has_fallen = false;
        for i in longest_first {
            let s = out.scored[i].clone();
            if s.probability < SETTINGS.answer.listed {
                continue;
            }
            let parts = s.trial.hypothesis.parts.iter().enumerate();
            let stands = parts.filter(|(part, _)| !self.may_be_zero(&s, *part)).map(|(_, part)| part.clone());
            let rest = Hypothesis { parts: stands.collect(), ..s.trial.hypothesis.clone() };
            if rest.parts.len() == s.trial.hypothesis.parts.len() {
                continue;
            }
            // The interval of a constant under another name is wide where another constant may stand for it. Without the effect that one is
            // then farther off than an effect would be named for, and farther than with it: nobody would believe that.
            let [far, near] = [retuned, &s.trial.fitted].map(|fitted| farthest(self.problem, fitted));
            let is_constant = |v: &Variant| StandIn::of(v, self.problem.robot).is_some();
            let is_beyond = far > SETTINGS.prices.named_from && near < far;
            if rest.parts.is_empty() && is_beyond && s.trial.hypothesis.variants().all(is_constant) {
                continue;
            }

            has_fallen = true;
            self.hand_on(&mut out, i, rest, 1.0);
        }
        self.doubt_nothing_at_a_stop(&mut out, retuned);
        if has_fallen {
            out.scored.sort_by(|a, b| b.probability.total_cmp(&a.probability));
        }
        out
    }

    /// Makes "nothing is missing" no likelier than not where it needs a constant at the end of what a fit may give it, which somebody
    /// could measure on the robot: the fit asks for more than that, and an effect that is a constant under another name may be what it
    /// makes up for. Those that are weighed share what "nothing" loses, each up to that as well; the rest is what nobody weighed.
    fn doubt_nothing_at_a_stop(&self, decision: &mut Decision, retuned: &Fitted) {
        let most = SETTINGS.retune.at_a_stop;
        let stops =
            |(t, moved): (Tunable<f64>, &f64)| t.between_visits >= SETTINGS.retune.measurable && is_at_a_stop(*moved);
        let any_stops = tunables::<f64>().into_iter().zip(&retuned.point.theta).any(stops);
        if self.problem.has_references || decision.none <= most || !any_stops {
            return;
        }

        let is_constant = |v: &Variant| StandIn::of(v, self.problem.robot).is_some();
        let mut hidden: Vec<&mut Scored> = decision.scored.iter_mut().collect();
        hidden.retain(|s| s.trial.hypothesis.variants().all(is_constant));
        let all: f64 = hidden.iter().map(|s| s.probability).sum();
        if all >= SETTINGS.answer.listed {
            let lost = decision.none - most;
            let more = |s: &Scored| (s.probability * lost / all).min((most - s.probability).max(0.0));
            let shared: f64 = hidden.iter().map(|s| more(s)).sum();
            for s in hidden {
                s.probability += more(s);
            }
            decision.none = most;
            decision.unknown += lost - shared;
        }
    }

    /// Hands a share of the probability of a hypothesis on to that with these of its effects alone, which is fitted where nobody has;
    /// without any, to "nothing is missing".
    pub(crate) fn hand_on(&self, decision: &mut Decision, from: usize, rest: Hypothesis, share: f64) {
        let s = decision.scored[from].clone();
        let handed = share * s.probability;
        decision.scored[from].probability -= handed;
        match decision.scored.iter().position(|other| other.trial.hypothesis.is_of_the_effects_of(&rest)) {
            _ if rest.parts.is_empty() => decision.none += handed,
            Some(heir) => decision.scored[heir].probability += handed,
            None => {
                let heir = refits::keeping(self.problem, &s.trial, rest);
                decision.scored.extend(heir.map(|trial| Scored { trial, probability: handed, ..s }));
            }
        }
    }

    /// Whether the 90 % interval of an effect holds no effect at all. Another radius of a wheel is none where that of its encoder's scale
    /// holds it.
    fn may_be_zero(&self, scored: &Scored, part: usize) -> bool {
        let cause = self.cause(scored, part, scored.probability);
        let of_encoder = self.sensors.faults.iter().filter(|f| {
            f.spec.id == encoder_scale::SPEC.id
                && cause.effect == wheel_radius_mismatch::SPEC.id
                && f.side.map(inference::words::side) == cause.side.as_deref()
        });
        let of_scale = of_encoder.map(|f| f.sigma / (1.0 + f.magnitude)).fold(0.0, f64::max);
        cause.magnitude.zip(cause.sigma).is_some_and(|(size, sigma)| size.abs() < NINETY * sigma.hypot(of_scale))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::Point;
    use crate::testing::{Asked, cutting, driven, problem};
    use crate::trial::Trial;
    use crate::windows::cut;
    use inference::hypothesis::Place;
    use testing::robot;

    /// An effect in all places.
    fn of(id: &str) -> Variant {
        let forms = inference::hypothesis::variants(true).into_iter();
        { forms }.find(|v| v.spec().id == id && v.place != Place::Disc).expect("in the catalogue")
    }

    /// A hypothesis of such effects that are so large.
    fn scored(p: &Problem<'_>, effects: &[(Variant, f64)], probability: f64) -> Scored {
        let parts = effects.iter().map(|(v, _)| (*v, Vec::new())).collect();
        let hypothesis = Hypothesis { parts, acting: None };
        let effects = effects.iter().map(|(_, size)| *size).collect();
        let fitted = p.begin(&hypothesis, Point { effects, ..p.origin() }, None);
        Scored { trial: Trial { hypothesis, fitted }, visits: None, score: 10.0, probability }
    }

    fn told(p: &Problem<'_>, scored: Vec<Scored>, none: f64) -> Decision {
        let decision = Decision { scored, none, ..Decision::default() };
        Asked::new(p, decision).judged().without_sizes_of_zero(&p.begin(&Hypothesis::default(), p.origin(), None))
    }

    #[test]
    fn an_effect_whose_absence_needs_a_constant_that_nobody_believes_keeps_its_probability() {
        let (robot, viscous) = (robot(), of("viscous_friction"));
        let cuts = [cut(&driven(&robot, &[], 12.0), &cutting())];
        let p = problem(&robot, &cuts);
        let none_at = |effect: Variant, sigmas: f64| {
            let mut point = p.origin();
            point.theta[0] = p.centre[0] + sigmas;
            let retuned = p.begin(&Hypothesis::default(), point, None);
            let scored = vec![scored(&p, &[(effect, 1e-6)], 0.4)];
            let decision = Decision { scored, none: 0.6, ..Decision::default() };
            Asked::new(&p, decision).judged().without_sizes_of_zero(&retuned).none
        };
        approx::assert_relative_eq!(none_at(viscous, 3.0), 1.0, epsilon = 1e-12);
        approx::assert_relative_eq!(none_at(viscous, 5.0), 0.6, epsilon = 1e-12);
        let of_no_constant = of("quadratic_drag");
        approx::assert_relative_eq!(none_at(of_no_constant, 5.0), 1.0, epsilon = 1e-12);
    }

    #[test]
    fn nothing_is_no_likelier_than_not_where_a_constant_stops_at_the_end_of_its_range() {
        let (robot, payload) = (robot(), of("payload"));
        let cuts = [cut(&driven(&robot, &[], 12.0), &cutting())];
        let p = Problem { has_references: false, constants_are_loose: true, ..problem(&robot, &cuts) };
        let none_at = |id: &str, sigmas: f64| {
            let mut point = p.origin();
            point.theta[robot_model::tunable::place_of(id).expect("tunable")] = sigmas;
            let retuned = p.begin(&Hypothesis::default(), point, None);
            let scored = vec![scored(&p, &[(payload, 9.0)], 0.1)];
            let decision = Decision { scored, none: 0.9, ..Decision::default() };
            let told = Asked::new(&p, decision).judged().without_sizes_of_zero(&retuned);
            let sum = told.none + told.scored[0].probability + told.unknown;
            assert!(told.scored[0].probability < 0.5, "{:?}", told.scored[0].probability);
            approx::assert_relative_eq!(sum, 1.0, epsilon = 1e-12);
            told.none
        };
        assert!(none_at("motor_inertia", 6.0) < 0.5);
        assert!(none_at("motor_inertia", 5.0) > 0.8);
        assert!(
            none_at("slip_at_peak", 6.0) > 0.8,
            "what makes up for another law of the tyres is no constant to measure"
        );
    }

    #[test]
    fn the_size_of_stiction_is_as_unsure_as_the_speed_at_which_it_fades() {
        let (robot, stiction) = (robot(), of("stiction"));
        let cuts = [cut(&driven(&robot, &[stiction.dose(&[3.0], None)], 24.0), &cutting())];
        let p = problem(&robot, &cuts);
        let told = scored(&p, &[(stiction, 3.0)], 1.0);
        let cause = Asked::new(&p, Decision::default()).judged().cause(&told, 0, 1.0);
        let share = cause.sigma.expect("a sigma") / 3.0;
        assert!((0.3..0.6).contains(&share), "{share}");
    }

    #[test]
    fn an_effect_whose_interval_holds_zero_gives_its_probability_to_nothing() {
        let (robot, viscous) = (robot(), of("viscous_friction"));
        let cuts = [cut(&driven(&robot, &[viscous.dose(&[1.0], None)], 12.0), &cutting())];
        let p = problem(&robot, &cuts);
        let told = told(&p, [1e-6, 1.0].map(|size| scored(&p, &[(viscous, size)], 0.4)).to_vec(), 0.2);
        approx::assert_relative_eq!(told.none, 0.6, epsilon = 1e-12);
        assert_eq!(told.scored.iter().map(|s| s.probability).collect::<Vec<_>>(), [0.4, 0.0]);
        assert_eq!(told.scored[0].trial.fitted.point.effects, [1.0], "what stands comes first");
    }

    #[test]
    fn a_second_effect_whose_interval_holds_zero_gives_its_probability_to_the_first_alone() {
        let (robot, viscous, pull) = (robot(), of("viscous_friction"), of("constant_pull"));
        let cuts = [cut(&driven(&robot, &[viscous.dose(&[1.0], None)], 12.0), &cutting())];
        let p = problem(&robot, &cuts);
        let beside = |second: f64| {
            let both = scored(&p, &[(viscous, 1.0), (pull, second)], 0.6);
            told(&p, vec![both, scored(&p, &[(viscous, 1.0)], 0.3)], 0.1)
        };
        let none = beside(1e-6);
        assert_eq!(none.scored[0].trial.hypothesis.ids(), ["viscous_friction"]);
        approx::assert_relative_eq!(none.scored[0].probability, 0.9, epsilon = 1e-12);
        approx::assert_relative_eq!(none.none, 0.1, epsilon = 1e-12);
        assert_eq!(beside(50.0).scored[0].probability, 0.6, "a pull that is there");
    }

    #[test]
    fn the_heir_of_two_effects_is_found_in_any_order_and_fitted_where_nobody_has() {
        let (robot, viscous) = (robot(), of("viscous_friction"));
        let (pull, radius) = (of("constant_pull"), of("wheel_radius_mismatch"));
        let cuts = [cut(&driven(&robot, &[viscous.dose(&[1.0], None), pull.dose(&[50.0], None)], 12.0), &cutting())];
        let p = problem(&robot, &cuts);
        let three = |probability| scored(&p, &[(viscous, 1.0), (pull, 50.0), (radius, 1e-6)], probability);
        let turned = scored(&p, &[(pull, 50.0), (viscous, 1.0)], 0.3);
        let told_of = |scored| {
            let told = told(&p, scored, 0.0);
            { told.scored }.into_iter().map(|s| (s.trial.hypothesis.ids(), s.probability)).collect::<Vec<_>>()
        };
        let heirs = told_of(vec![three(0.7), turned]);
        assert_eq!(heirs[0].0, ["constant_pull", "viscous_friction"]);
        approx::assert_relative_eq!(heirs[0].1, 1.0, epsilon = 1e-12);
        let fitted = told_of(vec![three(1.0)]);
        assert_eq!(fitted[0], (vec!["viscous_friction", "constant_pull"], 1.0));
    }
}
