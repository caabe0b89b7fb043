//! What must hold before a law is told.

use law::Law;
use verdict::LawFreeRun;

use super::arbitrary::{Acts, wide};
use super::operator::Operator;
use super::refit::{Refitted, hypothesis, numbers};
use super::series;
use crate::calibrate::{of_file, problem};
use crate::candidate::{Ground, reduced};
use crate::decide::fault_free_cost;
use crate::fit::{Columns, Fitted, Hypothesis, Point, Problem, difference};
use crate::judged::Judged;
use crate::settings::fit;
use crate::settings::law::{Gates, SETTINGS};
use robot_model::tunable::COUNT as NUISANCES;

const GATES: Gates = SETTINGS.gates;

/// How a law stands before the gates.
#[derive(Debug, Clone)]
pub(crate) struct Standing {
    /// Gain of each recording, nats.
    pub(crate) gains: Vec<f64>,
    /// Share of the excess cost that is left.
    pub(crate) left: f64,
    /// The same law's coefficient in the references as a share of that in the recordings, and its evidence there, nats;
    /// `None` without references.
    pub(crate) in_references: Option<[f64; 2]>,
    /// Score less that of the best name.
    pub(crate) above_name: f64,
    /// How many times what a fault-free drive costs: by so much a difference of scores says less.
    pub(crate) misfit: f64,
}

/// Share of the excess cost of re-tuning that a cost leaves.
pub(super) fn left(cost: f64, retuned: f64, fault_free: f64) -> f64 {
    (cost - fault_free) / (retuned - fault_free).max(1.0)
}

/// Whether a law does better than re-tuning on recordings that its fit did not use, and no copy of it shifted in time
/// does better still, nor the best name by more than that; over all quantities, each by the logarithm of its error.
pub(crate) fn holds_elsewhere(rows: &[LawFreeRun]) -> bool {
    let ratio = |other: fn(&LawFreeRun) -> f64| {
        let all = rows.iter().map(|r| (r.law / other(r)).ln()).filter(|x| x.is_finite());
        all.clone().sum::<f64>() / all.count().max(1) as f64
    };
    let [retuned, shifted, named] =
        [ratio(|r| r.retuned), ratio(|r| r.shifted), ratio(|r| r.named.unwrap_or(r.retuned))];
    let above = SETTINGS.proof.above_shifted.ln_1p();
    retuned < (1.0 - SETTINGS.proof.below_retuned).ln() && shifted < above && named < above
}

impl Standing {
    pub(crate) fn new(
        judged: &Judged<'_>,
        retuned: &Fitted,
        law: &Refitted,
        references: Option<&References<'_>>,
    ) -> Self {
        let p = judged.problem;
        let runs = 0..p.cuts.len();
        let of = |f: &Fitted, run: usize| p.misfit_of_run(run, &f.response[run]);
        let fault_free = fault_free_cost(p, &judged.calibration.regimes.scatter);
        let name = judged.decision.scored.first().map_or(0.0, |s| s.score);
        Self {
            gains: runs.map(|run| of(retuned, run) - of(&law.fitted, run)).collect(),
            left: left(law.fitted.cost, retuned.cost, fault_free),
            // References that cannot tell do not permit a law.
            in_references: references.map(|r| r.coefficient(&law.law, &law.units).unwrap_or([1.0, 0.0])),
            above_name: law.score - name.max(0.0),
            misfit: (law.fitted.cost / fault_free.max(1.0)).max(1.0),
        }
    }

    /// Whether drives in which nothing is missing have the law too.
    pub(crate) fn is_in_references(&self) -> bool {
        self.in_references.is_some_and(|[share, _]| share.abs() >= GATES.in_references)
    }

    /// Whether every drive has it alike.
    pub(crate) fn is_in_every_drive(&self) -> bool {
        self.in_references
            .is_some_and(|[share, evidence]| share > GATES.in_every && evidence > GATES.evidence_in_references)
    }

    /// Whether enough recordings gain by it, and none loses.
    fn is_in_recordings(&self) -> bool {
        let gain = self.gains.iter().filter(|g| **g > GATES.recording).count();
        gain >= GATES.recordings && self.gains.iter().all(|g| *g > -GATES.recording)
    }

    /// Whether a place may be named.
    pub(crate) fn names_a_place(&self, law: &Refitted) -> bool {
        law.score > GATES.score
            && self.left < GATES.left_of_place
            && self.above_name > GATES.above_name
            && self.is_in_recordings()
            && !self.is_in_references()
    }

    /// Whether the law may be told.
    pub(crate) fn tells_a_law(&self, law: &Refitted) -> bool {
        self.names_a_place(law) && self.left < GATES.left
    }
}

/// The references as a problem of their own, fitted without any effect.
pub(crate) struct References<'a> {
    problem: Problem<'a>,
    base: Fitted,
}

impl<'a> References<'a> {
    /// `None` without references.
    pub(crate) fn new(judged: &'a Judged<'a>) -> Option<Self> {
        if judged.references.is_empty() {
            return None;
        }
        let p = judged.problem;
        let of_cuts =
            problem(p.robot, judged.case, judged.references, judged.calibration, p.largest_torque, judged.options);
        // What the references taught must not count twice: only the robot file is known before.
        let problem = Problem { information: of_file(), centre: [0.0; NUISANCES], ..of_cuts };
        let point = Point { theta: judged.calibration.theta, ..problem.origin() };
        let none = Hypothesis::default();
        let begun = problem.begin(&none, point, None);
        let base = problem.refine(&none, begun, SETTINGS.proof.steps, None);
        Some(Self { problem, base })
    }

    /// What is said of a place of the recordings that is looked at here.
    pub(super) fn at<T>(&self, like: &Acts, say: impl Fn(&series::Ground<'_>, &Acts) -> Option<T>) -> Option<T> {
        let problem = wide(&self.problem);
        let operator = Operator::of(&problem, &self.base, &like.inputs);
        let ground = series::Ground { problem: &problem, base: &self.base, operator: &operator };
        say(&ground, &Acts::new(&ground, like.place, &[like.size])?)
    }

    /// The coefficient of a law here as a share of what it is, and its evidence.
    fn coefficient(&self, law: &Law, units: &[f64]) -> Option<[f64; 2]> {
        let h = hypothesis(law, units);
        let mut effects = numbers(law);
        let share = SETTINGS.operator.pulse;
        let mut at = 0;
        for term in law.terms() {
            effects[at] *= share;
            at += 1 + term.factors().iter().map(|f| f.shapes().len()).sum::<usize>();
        }
        let point = Point { effects, ..self.base.point.clone() };
        let column = difference(&self.problem.response(&point, &h), &self.base.response, 1.0 / share);
        let ground = Ground { problem: &self.problem, base: &self.base, beside: Columns(Vec::new()) };
        let (a, b) = reduced(&ground, Columns(vec![column]))?;
        let (a, b) = (a[(0, 0)], b[(0, 0)]);
        let x = b / (a + fit::SETTINGS.fit.whiff.max(f64::MIN_POSITIVE));
        let stiff = a + 1.0;
        Some([x, 0.5 * b * b / stiff - 0.5 * stiff.ln()])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Errors of re-tuning, of a law and of its best shifted copy on a recording that was left out.
    fn row([retuned, law, shifted]: [f64; 3]) -> LawFreeRun {
        let (recording, quantity) = ("run_1".to_owned(), "wheel speed, rad/s".to_owned());
        LawFreeRun { recording, quantity, nominal: 1.0, retuned, named: None, law, shifted }
    }

    #[test]
    fn a_law_holds_where_it_beats_re_tuning_and_no_shifted_copy_beats_it() {
        assert!(holds_elsewhere(&[row([0.5, 0.2, 0.45]), row([0.5, 0.3, 0.5])]));
        // A law that hardly changes in time is its own copy.
        assert!(holds_elsewhere(&[row([0.5, 0.2, 0.2])]));
        assert!(!holds_elsewhere(&[row([0.5, 0.4, 0.2])]), "a shifted copy does better");
        let named = LawFreeRun { named: Some(0.1), ..row([0.5, 0.2, 0.45]) };
        assert!(!holds_elsewhere(&[named]), "the best name does better");
        assert!(!holds_elsewhere(&[row([0.5, 0.495, 0.5])]), "hardly better than re-tuning");
        assert!(!holds_elsewhere(&[]), "there is no proof without recordings left out");
    }
}
