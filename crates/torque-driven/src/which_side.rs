//! Whether left-out recordings tell on which side an effect is.
//!
//! Less torque on the right is about more on the left of a robot whose constants are a little others. With references these are
//! known; without, what one side costs more than the other may be what the laws of the plant lack, which left-out recordings tell
//! (as in [`confirmed`](crate::confirmed)).

use crate::confirmed::{gain, left_out_costs};
use crate::decision::{Decision, Scored};
use crate::judged::Judged;
use crate::settings::decision::{Confirmation, SETTINGS};
use crate::{other_side, stand_in};

const RULES: Confirmation = SETTINGS.confirmation;

impl Judged<'_> {
    /// The decision in which both sides of the best hypothesis' effect are as likely where left-out recordings do not tell which
    /// it is, and the other takes its place where they are forecast better with it.
    pub(crate) fn with_either_side(&self) -> Decision {
        let mut out = self.decision.clone();
        if self.problem.has_references || self.problem.cuts.len() < 2 || out.finds_nothing() {
            return out;
        }
        let Some(best) = out.scored.first().cloned() else { return out };
        // Of what no constant scales on both sides the pose tells the side.
        let parts = best.trial.hypothesis.parts.iter().enumerate();
        let shared = parts.filter(|(_, (variant, _))| stand_in::of_both_sides(variant).is_some());
        for (part, _) in shared {
            let fits = other_side::fits(self.problem, &best.trial, part).into_iter();
            let Some(mirrored) = fits.min_by(|a, b| a.fitted.cost.total_cmp(&b.fitted.cost)) else { continue };
            let [more, error] = gain(&left_out_costs(self, &mirrored), &left_out_costs(self, &best.trial));
            // What either side asks of constants beyond what the file states is paid for as well.
            let [asked, of_best] = [&mirrored, &best.trial].map(|trial| self.problem.prior(&trial.fitted.point));
            let is_less_likely = mirrored.fitted.cost > best.trial.fitted.cost;
            let share = share([more + asked - of_best, error], is_less_likely);
            if share == 1.0 {
                continue;
            }

            let is_it = |s: &Scored| s.trial.hypothesis.is_of_the_effects_of(&mirrored.hypothesis);
            let at = out.scored.iter().position(is_it).unwrap_or_else(|| {
                out.scored.push(Scored { trial: mirrored.clone(), probability: 0.0, ..best.clone() });
                out.scored.len() - 1
            });
            let of_both = out.scored[0].probability + out.scored[at].probability;
            out.scored[0].probability = share * of_both;
            out.scored[at].probability = (1.0 - share) * of_both;
            out.scored.sort_by(|a, b| b.probability.total_cmp(&a.probability));
            return out;
        }
        out
    }
}

/// Share of the probability of both sides that the first keeps where left-out recordings cost so much more with the other, with this
/// standard error, nats: what is better beyond the errors takes all, but of two of which the drives that were fitted say the contrary
/// neither does.
fn share([more, error]: [f64; 2], is_other_less_likely: bool) -> f64 {
    match more / (RULES.errors * error) {
        beyond if beyond > 1.0 => 1.0,
        beyond if beyond < -1.0 && !is_other_less_likely => 0.0,
        _ => 0.5,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::{Hypothesis, Point, Problem};
    use crate::testing::{Asked, cutting, driven, problem};
    use crate::trial::Trial;
    use crate::windows::cut;
    use inference::hypothesis::{Place, Variant};
    use testing::robot;

    /// The sides that a decision lists about drives of a robot with more torque on the left, which was found on one side.
    fn sides(seconds: &[f64], has_references: bool, found: usize) -> Vec<(Option<usize>, f64)> {
        let robot = robot();
        let blank = problem(&robot, &[]);
        let of = |side: usize| {
            let is_it = |v: &Variant| v.spec().id == "torque_constant_side" && v.place == Place::Side(side);
            blank.variants().into_iter().find(is_it).expect("in the catalogue")
        };
        let doses = [of(0).dose(&[0.15], None)];
        let cuts: Vec<_> = seconds.iter().map(|s| cut(&driven(&robot, &doses, *s), &cutting())).collect();
        let p = Problem { has_references, constants_are_loose: !has_references, ..problem(&robot, &cuts) };
        let hypothesis = Hypothesis::single(of(found), Vec::new());
        let point = Point { effects: vec![[0.15, -0.13][found]], ..p.origin() };
        let fitted = p.refine(&hypothesis, p.begin(&hypothesis, point, None), 6, None);
        let scored = vec![Scored { trial: Trial { hypothesis, fitted }, visits: None, score: 20.0, probability: 0.9 }];
        let decision = Decision { scored, none: 0.1, ..Decision::default() };
        let told = Asked::new(&p, decision).judged().with_either_side().scored.into_iter();
        told.map(|s| (s.trial.hypothesis.parts[0].0.side(), s.probability)).collect()
    }

    #[test]
    fn sides_within_two_standard_errors_are_as_likely() {
        // The first is what a robot of another hand gave, whose left motor was told as its right.
        let of = |is_other_less_likely| {
            [[73.4, 59.8], [-73.4, 59.8], [200.0, 59.8], [-200.0, 59.8]].map(|more| share(more, is_other_less_likely))
        };
        assert_eq!(of(false), [0.5, 0.5, 1.0, 0.0]);
        assert_eq!(of(true), [0.5, 0.5, 1.0, 0.5], "fits and forecasts contradict each other");
    }

    #[test]
    fn a_side_that_left_out_drives_tell_stays_and_one_that_they_refuse_goes() {
        let drives = [10.0, 12.0, 14.0];
        assert_eq!(sides(&drives, false, 0), [(Some(0), 0.9)], "the true side");
        let wrong = sides(&drives, false, 1);
        assert_eq!(wrong, [(Some(0), 0.9), (Some(1), 0.0)]);
        assert_eq!(sides(&drives, true, 1), [(Some(1), 0.9)], "references know the constants");
        assert_eq!(sides(&drives[..1], false, 1), [(Some(1), 0.9)], "nothing is left out of one drive");
    }
}
