//! Null scores: the best effect for each reference when only the others calibrate the model, which
//! is a false alarm.

use faer::Mat;
use robot_model::tunable::COUNT as NUISANCES;

use crate::between_visits::VisitConstants;
use crate::fit::{Columns, Fitted, Hypothesis, Point, Problem};
use crate::prices::penalty;
use crate::run_numbers::UNKNOWN;
use crate::screen::screen;
use inference::algebra::solve_spd;

/// Scores that fault-free recordings of this robot reach.
#[derive(Debug, Clone, Default)]
pub(crate) struct NullScores {
    /// Of each reference left out in turn: the effect that scores best, a false alarm, and its score, nats.
    pub(crate) of_references: Vec<(String, f64)>,
    /// What each effect gains in a segment of a reference, nats: no reference lacks it, so that it stands for what the plant's laws
    /// are not.
    pub(crate) per_segment: Vec<(&'static str, f64)>,
}

/// What is learnt of a reference.
struct OfReference {
    best: (String, f64),
    /// The gain of each effect in its best form.
    gains: Vec<(&'static str, f64)>,
}

impl NullScores {
    /// Screens every reference with a calibration from which its own share is taken away.
    ///
    /// At the calibrated θ the gradients of all references and of the prior cancel, so that without reference r
    /// `θ₋ᵣ = θ − (H − Sᵣ)⁻¹ gᵣ` with prior information `H − Sᵣ`: no second calibration is needed.
    ///
    /// A reference of one of several visits is compared with the constants of its visit, `of_visits`.
    ///
    /// A lone reference cannot be left out: only gains beside its own constants are learnt of it.
    pub(crate) fn new(problem: &Problem<'_>, at: &Point, information: &Mat<f64>, of_visits: &[VisitConstants]) -> Self {
        if problem.cuts.len() < 2 {
            let none = Hypothesis::default();
            let base = problem.begin(&none, at.clone(), None);
            return Self { of_references: Vec::new(), ..Self::of(problem, &[OfReference::new(problem, &base)]) };
        }
        let left_out = |r: usize| {
            let of_visit = problem.cuts[r].visit.and_then(|visit| of_visits.get(visit));
            let (theta, information) = of_visit.map_or((&at.theta, information), |v| (&v.theta, &v.information));
            Self::left_out(problem, theta, information, r)
        };
        let of_references: Vec<OfReference> = (0..problem.cuts.len()).filter_map(left_out).collect();
        Self::of(problem, &of_references)
    }

    fn of(problem: &Problem<'_>, references: &[OfReference]) -> Self {
        let segments: usize = problem.cuts.iter().map(|cut| cut.segments.len()).sum();
        let mut per_segment: Vec<(&'static str, f64)> = Vec::new();
        for (id, gain) in references.iter().flat_map(|r| &r.gains) {
            let share = gain.max(0.0) / segments.max(1) as f64;
            match per_segment.iter_mut().find(|(known, _)| known == id) {
                Some((_, sum)) => *sum += share,
                None => per_segment.push((id, share)),
            }
        }
        let best = references.iter().map(|r| r.best.clone());
        Self { of_references: best.filter(|(_, score)| score.is_finite()).collect(), per_segment }
    }

    fn left_out(
        problem: &Problem<'_>,
        theta: &[f64; NUISANCES],
        information: &Mat<f64>,
        r: usize,
    ) -> Option<OfReference> {
        let none = Hypothesis::default();
        let mut alone = Problem {
            visits: Vec::new(),
            cuts: &problem.cuts[r..=r],
            regime: vec![problem.regime[r].clone()],
            information: information.clone(),
            centre: *theta,
            ..problem.clone()
        };
        let point = Point { theta: *theta, run: vec![UNKNOWN], visits: Vec::new(), effects: Vec::new() };
        let base = alone.begin(&none, point, None);
        let own = alone.normal(&base.point, &base.response, &base.columns, &Columns(Vec::new()))?;
        let others = information - &own.matrix;
        let (shift, _) = solve_spd(&others, &own.gradient)?;
        for k in 0..NUISANCES {
            alone.centre[k] -= shift[(k, 0)];
        }
        alone.information = others;
        Some(OfReference::new(&alone, &base))
    }

    /// What fault-free drives of so many segments gain by the effects of a hypothesis, nats.
    pub(crate) fn gain(&self, h: &Hypothesis, segments: usize) -> f64 {
        let of = |id: &str| self.per_segment.iter().find(|(known, _)| *known == id).map_or(0.0, |(_, gain)| *gain);
        h.ids().into_iter().map(of).sum::<f64>() * segments as f64
    }

    /// The highest score of a fault-free recording.
    pub(crate) fn highest(&self) -> f64 {
        self.of_references.iter().map(|a| a.1).fold(f64::NEG_INFINITY, f64::max)
    }
}

impl OfReference {
    fn new(problem: &Problem<'_>, base: &Fitted) -> Self {
        let mut out = Self { best: (String::new(), f64::NEG_INFINITY), gains: Vec::new() };
        for c in screen(problem, base, &problem.variants(), &Hypothesis::default()) {
            let h = Hypothesis::single(c.variant, c.onsets.clone());
            let score = c.evidence - penalty(&h, &c.start, &problem.sizes());
            if score > out.best.1 {
                out.best = (c.variant.label(), score);
            }
            let id = c.variant.spec().id;
            match out.gains.iter_mut().find(|(known, _)| *known == id) {
                Some((_, gain)) => *gain = gain.max(c.evidence),
                None => out.gains.push((id, c.evidence)),
            }
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::calibrate::calibrate;
    use crate::testing::{cutting, driven};
    use crate::windows::{Cut, cut};
    use inference::Options;
    use inference::hypothesis::Dose;
    use robot_model::tunable::usual_sigma;
    use testing::robot;

    /// The highest null score of three references, of which the last carries so much viscous friction, N m s/rad.
    fn highest(friction: f64) -> f64 {
        let robot = robot();
        let viscous = inference::hypothesis::variants(true)
            .into_iter()
            .find(|v| v.spec().id == "viscous_friction")
            .expect("in the catalogue");
        let dose: Vec<Dose> = vec![viscous.dose(&[friction], None)];
        let cut_of = |doses: &[Dose], seconds| cut(&driven(&robot, doses, seconds), &cutting());
        let cuts: [Cut; 3] = [cut_of(&[], 8.0), cut_of(&[], 10.0), cut_of(&dose, 12.0)];
        let calibration = calibrate(&robot, &usual_sigma(), &cuts, 5.0, &Options::default()).expect("determined");
        let null_scores = calibration.null_scores;
        assert_eq!(null_scores.of_references.len(), 3);
        assert!(null_scores.of_references.iter().all(|(_, score)| *score <= null_scores.highest()));
        null_scores.highest()
    }

    #[test]
    fn a_reference_with_an_effect_raises_the_null_score_and_fault_free_ones_do_not() {
        let (fault_free, ill) = (highest(0.0), highest(0.3));
        assert!(fault_free < 0.0 && ill > fault_free + 10.0, "fault-free {fault_free}, with friction {ill}");
    }

    #[test]
    fn a_lone_reference_has_no_null_score_and_shows_what_effects_gain_beside_its_constants() {
        assert_eq!(NullScores::default().highest(), f64::NEG_INFINITY);
        let (robot, options) = (robot(), Options::default());
        let drag = inference::hypothesis::variants(true).into_iter().find(|v| v.spec().id == "quadratic_drag");
        let drag = drag.expect("in the catalogue");
        let gain = |size: f64| {
            let cuts = [cut(&driven(&robot, &[drag.dose(&[size], None)], 12.0), &cutting())];
            let calibration = calibrate(&robot, &usual_sigma(), &cuts, 5.0, &options).expect("determined");
            assert!(calibration.null_scores.of_references.is_empty());
            let of = |segments| calibration.null_scores.gain(&Hypothesis::single(drag, Vec::new()), segments);
            approx::assert_relative_eq!(of(12), 2.0 * of(6), epsilon = 1e-12);
            of(6)
        };
        let (none, much) = (gain(0.0), gain(20.0));
        assert!((0.0..1.0).contains(&none) && much > none + 1.0, "{none} {much}");
    }
}
