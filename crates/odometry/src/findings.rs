//! What the drives of a case say, as plain data.

use std::sync::Arc;

use crate::constants::Measured;
use crate::diagnose::Solved;
use crate::drive::Drive;
use crate::left_out::Table;
use crate::motion::Laws;
use crate::settings::SETTINGS;
use crate::traces::predicted;
use crate::wheel::WheeledRobot;
use catalogue::odometry::LOST_COUNTS;
use hierarchical_fit::telling::gains;
use hierarchical_fit::{Answer, Estimate, NamedCause, Unconfirmed, is_beyond_references};
use inference::experiment::Standing;
use verdict::{Advice, PredictedPath, Trace};

/// What the drives of a case say.
#[derive(Debug, Clone)]
pub struct Findings {
    /// Kind of answer.
    pub answer: Answer,
    /// Causes that were named, the one that the data would miss most first.
    pub named: Vec<NamedCause>,
    /// Causes that were not, with their probabilities.
    pub others: Vec<(String, f64)>,
    /// All constants with the named causes.
    pub constants: Vec<Estimate>,
    /// Constants re-tuned within what is known, with no cause.
    pub retuned: Vec<Estimate>,
    /// The cause that is little less probable than the first.
    pub rival: Option<String>,
    /// Sigma of a window's error, m.
    pub noise: f64,
    /// What was named and is not told, for sessions that were left out do not need it.
    pub unconfirmed: Option<Unconfirmed>,
    /// Factor on the usual scatter of constants between sessions.
    pub scatter: f64,
    /// Root mean square error of windows over their way: as given, re-tuned, with the named causes.
    pub shares: [f64; 3],
    /// The same that the best answer leaves of the references; `None` without any.
    pub left_of_references: Option<f64>,
    /// Sessions, drives, windows.
    pub counts: [usize; 3],
    /// What the drives measure of the body's motion.
    pub measured: Measured,
    /// What was done to the recordings, for people.
    pub told: Vec<String>,
    /// The recordings beside the simulations that were fitted to them.
    pub traces: Vec<Trace>,
    /// Advice on the next drive, where it was asked for.
    pub next: Option<Advice>,
    /// As stated, re-tuned, with the named causes.
    pub(crate) laws: [Laws; 3],
    /// The same without causes that little shows, where there are some.
    pub(crate) plainer: Option<Box<Self>>,
    /// The fit that says all this, from which those start that leave sessions out; `None` of a plainer answer.
    pub(crate) solved: Option<Arc<Solved>>,
}

impl Findings {
    /// What stands once sessions were left out: causes that explain little, only where those are forecast better with them; none with
    /// which they are forecast worse than as stated and which leave most of the error, nor with which they are forecast no better, or worse
    /// than re-tuned.
    #[must_use]
    pub fn after(self, table: &Table) -> Self {
        let rules = SETTINGS.doubt;
        // What sessions that were left out need more than the answer without it has passed that test.
        let (mut out, confirmed) = match self.plainer {
            Some(plainer) if table.is_plainer => (*plainer, rules.confirmed),
            Some(_) => (self, 1.0),
            None => (self, rules.confirmed),
        };
        let [_, tuned, best] = out.shares;
        let leaves_most = best > rules.leaves_most * tuned;
        // Counts that were lost are seen by themselves, and no law of the constants.
        let labels: Vec<String> =
            out.named.iter().filter(|c| *c.spec != LOST_COUNTS).map(|c| c.label.clone()).collect();
        let standing = Standing::new(&table.free_runs()).filter(|_| out.answer == Answer::Named && !labels.is_empty());
        let Some(standing) = standing else { return out };
        let is_worse = standing.over_retuned > rules.worse && out.retuned.iter().all(Estimate::is_believable);
        if leaves_most && standing.over_nominal > rules.refuted {
            out.take_back();
        } else if (standing.over_nominal > confirmed || is_worse) && !out.named.iter().any(NamedCause::is_in_one_drive)
        {
            out.take_back();
            out.unconfirmed = Some(Unconfirmed { labels, standing });
        }
        out
    }

    /// Takes back what was named: it is listed, and what is left is as re-tuning leaves it.
    fn take_back(&mut self) {
        let listed = SETTINGS.doubt.listed;
        let (lost, laws): (Vec<_>, Vec<_>) = self.named.drain(..).partition(|cause| *cause.spec == LOST_COUNTS);
        self.others.extend(laws.into_iter().map(|cause| (cause.label, cause.probability.min(listed))));
        self.named = lost;
        self.others.sort_by(|a, b| b.1.total_cmp(&a.1));
        self.constants.clone_from(&self.retuned);
        self.laws[2] = self.laws[1].clone();
        self.shares[2] = self.shares[1];
        self.rival = None;
        let is_left = self.shares[2] > SETTINGS.unexplained.share
            || is_beyond_references(self.shares[2], self.left_of_references);
        self.answer = if is_left {
            Answer::Unknown
        } else if !self.named.is_empty() {
            Answer::Named
        } else if self.retuned.iter().any(Estimate::is_moved) {
            Answer::Retune
        } else {
            Answer::Nothing
        };
    }

    /// The pose of a drive from its counts alone. It begins in the first row of each stretch in which the pose was seen, and anew
    /// in the last one where rows follow in which it was not; at the origin where it was never seen.
    pub fn predict(&self, robot: &WheeledRobot, drive: &Drive) -> PredictedPath {
        let [_, retuned, corrected] = &self.laws;
        let path = |laws: &Laws| predicted(robot, drive, laws);
        PredictedPath {
            name: drive.name.clone(),
            time: drive.time.clone(),
            corrected: path(corrected),
            retuned: path(retuned),
        }
    }
}

/// Whether several slips below zero are named: a body that gets ahead of its wheels by one law and falls behind by another has neither. Of
/// a slip below zero each further number of its law that clearly is counts, too.
pub(crate) fn is_nothing_that_slips(named: &[NamedCause]) -> bool {
    let below = |cause: &NamedCause| {
        let further = cause.estimates.iter().skip(1).filter(|e| e.value + e.half_width < 0.0);
        1 + further.count()
    };
    named.iter().filter(|cause| gains(cause)).map(below).sum::<usize>() > 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use catalogue::CauseSpec;
    use catalogue::odometry::{SLIP_IN_TURNS, SLIP_WITH_SPEED, SLIP_WITH_TURNING};

    #[test]
    fn one_slip_below_zero_is_remarked_and_several_are_none() {
        let of = |spec: &'static CauseSpec, value: f64| NamedCause {
            spec,
            label: spec.id.to_owned(),
            probability: 1.0,
            alike: Vec::new(),
            estimates: vec![Estimate {
                name: "slip".to_owned(),
                unit: "1",
                given: 0.0,
                value,
                half_width: 0.01,
                sigmas: 5.0,
            }],
            intervals: Vec::new(),
            onset: None,
        };
        let named =
            |speed, turning| [of(&SLIP_WITH_SPEED, speed), of(&SLIP_WITH_TURNING, turning), of(&SLIP_IN_TURNS, 0.1)];
        assert!(is_nothing_that_slips(&named(-0.1, -0.2)));
        assert!(!is_nothing_that_slips(&named(-0.1, 0.2)));

        let mut own = of(&SLIP_WITH_SPEED, -0.1);
        for (value, is_nothing) in [(0.1, false), (-0.005, false), (-0.1, true)] {
            own.estimates.truncate(1);
            own.estimates.push(Estimate { value, ..own.estimates[0].clone() });
            assert_eq!(is_nothing_that_slips(std::slice::from_ref(&own)), is_nothing, "{value}");
        }
    }
}
