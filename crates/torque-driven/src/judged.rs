//! A case whose hypotheses are weighed: what every part of an answer is made of.

use crate::calibrate::Calibration;
use crate::case::Case;
use crate::decide::{Decision, Scored};
use crate::fit::Problem;
use crate::redundancy::Redundant;
use crate::simulator::Simulator;
use crate::visit::Visit;
use crate::windows::Cut;
use inference::Options;

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
}
