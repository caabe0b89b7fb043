//! Rows counted: what is reported at the end.

use std::collections::BTreeMap;

use verdict::Verdict;

use super::row::{Outcome, Row};

/// Units that failed and that are named one by one.
const NAMED: usize = 20;
/// A cause counts as found above this.
const LIKELY: f64 = 0.5;

/// Counts over rows; takes them one by one and keeps none.
#[derive(Debug, Clone, Default)]
pub struct Overview {
    /// Rows.
    pub rows: usize,
    /// By verdict: explained, unknown, no mismatch, withheld.
    pub verdicts: [usize; 4],
    /// Rows without an answer.
    pub failed: usize,
    /// Rows of which some input was lost.
    pub lost: usize,
    /// By vehicle.
    pub robots: BTreeMap<String, RobotCount>,
    /// The first that failed, with the reason.
    pub failures: Vec<(String, String)>,
}

/// Counts of one vehicle.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct RobotCount {
    /// Rows.
    pub rows: usize,
    /// Rows with a mismatch.
    pub mismatches: usize,
    /// Rows without an answer.
    pub failed: usize,
    /// Effects that are more likely than not, with how often.
    pub effects: BTreeMap<String, usize>,
}

impl Overview {
    /// Counts a row.
    pub fn add(&mut self, row: &Row) {
        self.rows += 1;
        self.lost += usize::from(!row.lost.is_empty());
        let robot = self.robots.entry(row.robot_id.clone()).or_default();
        robot.rows += 1;
        if row.outcome == Outcome::Failed {
            self.failed += 1;
            robot.failed += 1;
            if self.failures.len() < NAMED {
                self.failures.push((row.id.clone(), row.error.clone().unwrap_or_default()));
            }
        }
        let Some(verdict) = row.verdict else { return };
        self.verdicts[verdict as usize] += 1;
        robot.mismatches += usize::from(matches!(verdict, Verdict::Explained | Verdict::Unknown));
        if verdict == Verdict::Explained {
            for cause in row.causes.iter().filter(|c| c.probability > LIKELY) {
                *robot.effects.entry(cause.effect.clone()).or_default() += 1;
            }
        }
    }
}
