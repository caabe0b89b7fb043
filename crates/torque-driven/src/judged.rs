//! A case whose hypotheses are weighed: what every part of an answer is made of.

use crate::calibrate::Calibration;
use crate::case::Case;
use crate::decision::{Decision, Scored};
use crate::fit::Problem;
use crate::redundancy::Redundant;
use crate::settings::decision::SETTINGS;
use crate::simulator::Simulator;
use crate::visit::Visit;
use crate::windows::Cut;
use inference::Options;
use inference::robust::NINETY;

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
    /// may have moved, so that its probability is that of "nothing is missing".
    pub(crate) fn without_sizes_of_zero(&self) -> Decision {
        let mut out = self.decision.clone();
        let is_zero = |s: &Scored| {
            let is_single = s.trial.hypothesis.parts.len() == 1;
            let cause = (is_single && s.probability >= SETTINGS.answer.listed).then(|| self.cause(s, 0, s.probability));
            cause.is_some_and(|c| c.magnitude.zip(c.sigma).is_some_and(|(size, sigma)| size.abs() < NINETY * sigma))
        };
        let (zero, mut scored): (Vec<Scored>, Vec<Scored>) = out.scored.into_iter().partition(is_zero);
        out.none += zero.iter().map(|s| s.probability).sum::<f64>();
        scored.extend(zero.into_iter().map(|s| Scored { probability: 0.0, ..s }));
        out.scored = scored;
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::{Hypothesis, Point};
    use crate::testing::{calibration, cutting, driven, problem};
    use crate::trial::Trial;
    use crate::windows::cut;
    use inference::hypothesis::Place;
    use testing::robot;

    #[test]
    fn an_effect_whose_interval_holds_zero_gives_its_probability_to_nothing() {
        let robot = robot();
        let forms = inference::hypothesis::variants(true).into_iter();
        let form = { forms }.find(|v| v.spec().id == "viscous_friction" && v.place == Place::Whole);
        let form = form.expect("in the catalogue");
        let cuts = [cut(&driven(&robot, &[form.dose(&[1.0], None)], 12.0), &cutting())];
        let p = problem(&robot, &cuts);
        let scored = |size: f64| {
            let h = Hypothesis::single(form, Vec::new());
            let fitted = p.begin(&h, Point { effects: vec![size], ..p.origin() }, None);
            Scored { trial: Trial { hypothesis: h, fitted }, visits: None, score: 10.0, probability: 0.4 }
        };
        let calibration = calibration(&p);
        let case = Case::new(robot);
        let decision = Decision { scored: vec![scored(1e-6), scored(1.0)], none: 0.2, ..Decision::default() };
        let told = Judged {
            case: &case,
            options: &Options::default(),
            problem: &p,
            references: &[],
            visits: &[],
            calibration: &calibration,
            sensors: &Redundant::default(),
            simulator: None,
            decision: &decision,
        }
        .without_sizes_of_zero();
        approx::assert_relative_eq!(told.none, 0.6, epsilon = 1e-12);
        assert_eq!(told.scored.iter().map(|s| s.probability).collect::<Vec<_>>(), [0.4, 0.0]);
        assert_eq!(told.scored[0].trial.fitted.point.effects, [1.0], "what stands comes first");
    }
}
