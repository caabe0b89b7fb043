//! Whether recordings that were left out of the fit are forecast better with another hypothesis than with the best.
//!
//! A search that went astray may rest on effects that stand for the true one: less torque per current for a load that is not in the
//! middle. Where left-out recordings are forecast no better with the best hypothesis than with the best one that has none of its
//! effects, neither is believed more than the other, but for what the robot file says of the constants that each needs.

use crate::confirmed::left_out_costs;
use crate::decision::{Decision, Scored};
use crate::judged::Judged;
use crate::leave_out::placebo;
use crate::settings::decision::{Prices, SETTINGS};
use inference::evidence::logistic;

const PRICES: Prices = SETTINGS.prices;

impl Judged<'_> {
    /// The decision in which the hypothesis that forecasts better shares the probability of the best.
    pub(crate) fn with_what_forecasts_better(&self) -> Decision {
        let mut out = self.decision.clone();
        let Some(best) = self.winner().filter(|_| self.problem.cuts.len() > 1) else { return out };
        // Where one recording alone shows all of it, the others cannot forecast it.
        if (0..best.trial.hypothesis.parts.len()).all(|part| self.shows_once(&best.trial, part)) {
            return out;
        }
        let Some(other) = placebo(self) else { return out };
        let segments: Vec<usize> = self.problem.cuts.iter().map(|cut| cut.segments.len()).collect();
        let more = left_out_costs(self, &best.trial).into_iter().zip(left_out_costs(self, &other.trial));
        if !costs_more(&segments, &more.map(|(best, other)| best - other).collect::<Vec<f64>>()) {
            return out;
        }

        let at = |scored: &Scored| {
            out.scored.iter().position(|s| s.trial.hypothesis.is_of_the_effects_of(&scored.trial.hypothesis))
        };
        let (Some(first), Some(second)) = (at(best), at(other)) else { return out };
        let both = out.scored[first].probability + out.scored[second].probability;
        let [of_best, of_other] = self.shares([best, other]);
        out.scored[first].probability = of_best * both;
        out.scored[second].probability = of_other * both;
        out.scored.sort_by(|a, b| b.probability.total_cmp(&a.probability));
        out
    }

    /// Shares of two hypotheses that forecasts do not tell apart: halves, and without references by how far each moves constants from where
    /// the robot file has them. A heavier robot and a weaker motor move alike, but not with the same frictions.
    fn shares(&self, both: [&Scored; 2]) -> [f64; 2] {
        if self.problem.has_references || !self.problem.constants_are_loose {
            return [0.5; 2];
        }
        let [best, other] = both.map(|s| -self.problem.prior(&s.trial.fitted.point));
        let of_best = logistic((best - other) / PRICES.temperature);
        [of_best, 1.0 - of_best]
    }
}

/// Whether so much more, nats, in each segment of recordings with so many segments is more in all and in most recordings: one that is
/// forecast badly by both is no verdict on either.
fn costs_more(segments: &[usize], more: &[f64]) -> bool {
    let mut rest = more;
    let of_recording = |count: &usize| {
        let (own, others) = rest.split_at(*count);
        rest = others;
        own.iter().sum::<f64>()
    };
    let all: Vec<f64> = segments.iter().map(of_recording).collect();
    all.iter().sum::<f64>() > 0.0 && 2 * all.iter().filter(|more| **more > 0.0).count() > all.len()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::{Hypothesis, Point, Problem};
    use crate::testing::{Asked, cutting, driven, problem};
    use crate::trial::Trial;
    use crate::windows::cut;
    use inference::hypothesis::{Place, Variant, variants};
    use testing::robot;

    fn of(id: &str) -> Variant {
        let is_it = |v: &Variant| v.spec().id == id && v.place == Place::Whole;
        variants(true).into_iter().find(is_it).expect("in the catalogue")
    }

    /// Probabilities of two effects about drives with quadratic drag, of which the first was found likelier.
    fn weighed(found: [&str; 2]) -> Vec<(&'static str, f64)> {
        weighed_of(found, true)
    }

    /// The same where constants are loose, as without references, or held.
    fn weighed_of(found: [&str; 2], constants_are_loose: bool) -> Vec<(&'static str, f64)> {
        let robot = robot();
        let doses = [of("quadratic_drag").dose(&[20.0], None)];
        let cuts = [8.0, 10.0, 12.0].map(|s| cut(&driven(&robot, &doses, s), &cutting()));
        let p = Problem { has_references: !constants_are_loose, constants_are_loose, ..problem(&robot, &cuts) };
        let scored = |(id, probability): (&str, f64)| {
            let hypothesis = Hypothesis::single(of(id), Vec::new());
            let size = if id == "quadratic_drag" { 20.0 } else { -0.05 };
            let point = Point { effects: vec![size], ..p.origin() };
            let fitted = p.refine(&hypothesis, p.begin(&hypothesis, point, None), 4, None);
            Scored { trial: Trial { hypothesis, fitted }, visits: None, score: 20.0, probability }
        };
        let scored = found.into_iter().zip([0.8, 0.1]).map(scored).collect();
        let decision = Decision { scored, none: 0.1, ..Decision::default() };
        let weighed = Asked::new(&p, decision).judged().with_what_forecasts_better().scored.into_iter();
        weighed.map(|s| (s.trial.hypothesis.ids()[0], s.probability)).collect()
    }

    #[test]
    fn one_recording_among_many_is_no_verdict() {
        assert!(costs_more(&[2, 1, 1], &[3.0, 2.0, -1.0, 1.0]));
        assert!(!costs_more(&[2, 1, 1], &[3.0, -4.0, -1.0, 50.0]), "one of three");
        assert!(!costs_more(&[2, 1, 1], &[1.0, 1.0, -50.0, 1.0]), "less in all");
    }

    #[test]
    fn what_forecasts_left_out_drives_no_better_than_another_is_believed_no_more() {
        let (drag, gain) = ("quadratic_drag", "torque_constant");
        assert_eq!(weighed([drag, gain]), [(drag, 0.8), (gain, 0.1)], "the true one stays");
        // A torque constant that stands for a drag needs frictions that the robot file does not state.
        let [(first, of_first), (second, of_second)] = weighed([gain, drag])[..] else { panic!("two effects") };
        assert_eq!((first, second), (drag, gain));
        assert!(of_first > 0.5 && (of_first + of_second - 0.9).abs() < 1e-12, "{of_first} {of_second}");
        let known = weighed_of([gain, drag], false);
        assert!(
            known.iter().all(|(_, p)| (p - 0.45).abs() < 1e-12),
            "constants that are held move in neither: {known:?}"
        );
    }
}
