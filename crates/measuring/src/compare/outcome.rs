//! What rounds of both programs say, and whether what is asked is met.

use serde::{Deserialize, Serialize};
use sim::statistics::median;

use super::figure::Figure;
use super::table::Goal;

/// One side of a row.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) enum Side {
    /// The row has no such side.
    Absent,
    /// It ran: the figure of every round.
    Ran(Vec<Figure>),
    /// It cannot run here, and why.
    Skipped(String),
    /// It failed, and how.
    Failed(String),
}

/// One row with what was measured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Outcome {
    pub(super) name: String,
    pub(super) group: String,
    pub(super) what: String,
    pub(super) ours: Side,
    pub(super) theirs: Side,
    /// Rounds that were meant.
    pub(super) rounds: u32,
    /// What is asked, in words; nothing if nothing is.
    pub(super) asked: Option<String>,
    /// Whether it is met, where both sides ran.
    pub(super) met: Option<bool>,
}

/// Median, smallest and largest of several values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Spread {
    pub(super) median: f64,
    pub(super) least: f64,
    pub(super) most: f64,
}

impl Spread {
    fn of(values: &[f64]) -> Option<Self> {
        let fold = |f: fn(f64, f64) -> f64| values.iter().copied().reduce(f);
        Some(Self { least: fold(f64::min)?, most: fold(f64::max)?, median: median(values.iter().copied()) })
    }
}

impl Side {
    fn figures(&self) -> &[Figure] {
        if let Self::Ran(figures) = self { figures } else { &[] }
    }

    /// The spread of its figures, and their unit.
    pub(super) fn spread(&self) -> Option<(Spread, &str)> {
        let values: Vec<f64> = self.figures().iter().map(|f| f.value).collect();
        Some((Spread::of(&values)?, &self.figures().first()?.unit))
    }
}

impl Outcome {
    /// Our times over theirs, round by round.
    pub(super) fn ratio(&self) -> Option<Spread> {
        let pairs = self.ours.figures().iter().zip(self.theirs.figures());
        Spread::of(&pairs.map(|(ours, theirs)| ours.in_si() / theirs.in_si()).collect::<Vec<_>>())
    }

    /// The same row, judged.
    pub(super) fn judged(mut self, goal: Goal) -> Self {
        (self.asked, self.met) = match goal {
            Goal::None => (None, None),
            Goal::AtMost(most) => (Some(format!("<= {most}")), self.ratio().map(|r| r.median <= most)),
            Goal::Faster(times) => (Some(format!("<= 1/{times}")), self.ratio().map(|r| r.median * times <= 1.0)),
            Goal::Ours(most) => {
                (Some(format!("itself <= {most}")), self.ours.spread().map(|(ours, _)| ours.median <= most))
            }
        };
        self
    }

    /// Whether a program of ours failed, or one of theirs that should have run.
    pub(super) fn failure(&self) -> Option<&str> {
        [&self.ours, &self.theirs].into_iter().find_map(|side| match side {
            Side::Failed(how) => Some(how.as_str()),
            _ => None,
        })
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    pub(in super::super) fn ran(values: &[f64], unit: &str) -> Side {
        Side::Ran(values.iter().map(|&value| Figure { value, unit: unit.into() }).collect())
    }

    pub(in super::super) fn outcome(ours: Side, theirs: Side) -> Outcome {
        let [name, group, what] = ["plant", "Kernels", "a step"].map(str::to_owned);
        Outcome { name, group, what, ours, theirs, rounds: 3, asked: None, met: None }
    }

    #[test]
    fn the_ratio_is_taken_round_by_round() {
        // The machine was twice as slow in the second round: medians alone would say 3/4.
        let row = outcome(ran(&[1.0, 3.0, 1.5], "us"), ran(&[2000.0, 4000.0, 1000.0], "ns"));
        let ratio = row.ratio().expect("a ratio");
        for (told, expected) in [(ratio.least, 0.5), (ratio.median, 0.75), (ratio.most, 1.5)] {
            assert!((told - expected).abs() < 1e-12, "{told} is not {expected}");
        }
        let (ours, unit) = row.ours.spread().expect("a spread");
        assert_eq!((ours.median, unit), (1.5, "us"));
    }

    #[test]
    fn goals_are_judged_where_both_sides_ran_only() {
        let both = outcome(ran(&[1.0], "ms"), ran(&[2.0], "ms"));
        let met = |goal| both.clone().judged(goal).met;
        assert_eq!(met(Goal::None), None);
        assert_eq!((met(Goal::AtMost(0.5)), met(Goal::AtMost(0.4))), (Some(true), Some(false)));
        assert_eq!((met(Goal::Faster(2.0)), met(Goal::Faster(2.5))), (Some(true), Some(false)));
        assert_eq!((met(Goal::Ours(1.0)), met(Goal::Ours(0.9))), (Some(true), Some(false)));
        let alone = outcome(ran(&[1.0], "ms"), Side::Skipped("no Python".into()));
        let judged = alone.clone().judged(Goal::AtMost(1.0));
        assert_eq!((judged.met, judged.asked.as_deref()), (None, Some("<= 1")));
        assert_eq!(alone.judged(Goal::Ours(2.0)).met, Some(true));
    }

    #[test]
    fn a_failure_is_reported_and_a_skipped_side_is_none() {
        let row = outcome(Side::Failed("exit code 1".into()), ran(&[1.0], "ms"));
        assert_eq!((row.failure(), row.ratio()), (Some("exit code 1"), None));
        assert_eq!(outcome(ran(&[1.0], "ms"), Side::Skipped("no make".into())).failure(), None);
    }
}
