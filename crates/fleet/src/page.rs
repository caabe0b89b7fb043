//! Rows as the page of a fleet.

use case_files::envelope::Program;
use report::fleet::{DiagnosedRecording, Finding, Named, render};
use verdict::Verdict;

use super::row::{Row, RowCause};

/// A cause counts as named above this.
const LIKELY: f64 = 0.5;

/// What the page needs of a row: less than the row.
pub fn diagnosed(row: &Row) -> DiagnosedRecording {
    let why = || row.limits.iter().chain(&row.sentences).next().cloned().unwrap_or_default();
    DiagnosedRecording {
        id: row.id.clone(),
        robot: row.robot_id.clone(),
        date: row.date.map(super::Date::milliseconds),
        finding: match row.verdict {
            None => Finding::Failed(row.error.clone().unwrap_or_default()),
            Some(Verdict::Withheld) => Finding::Withheld(why()),
            Some(Verdict::NoMismatch) => Finding::NoMismatch,
            Some(Verdict::Unknown) => Finding::Unknown,
            Some(Verdict::Explained) => {
                Finding::Explained(row.causes.iter().filter(|c| c.probability > LIKELY).map(named).collect())
            }
        },
    }
}

fn named(c: &RowCause) -> Named {
    Named {
        effect: c.effect.clone(),
        name: c.name.clone(),
        side: c.side.clone(),
        probability: c.probability,
        magnitude: c.magnitude,
        interval: c.low.zip(c.high).map(|(low, high)| [low, high]),
        unit: c.unit.clone(),
    }
}

/// The page of a fleet: one file that opens in any browser and needs no network.
pub fn page(seen: &[DiagnosedRecording]) -> String {
    let Program { name, version } = Program::default();
    render(seen, &format!("{name} {version}"))
}
