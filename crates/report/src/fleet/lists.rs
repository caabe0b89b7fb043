//! Recordings without an answer.

use super::recording::{DiagnosedRecording, Finding};
use super::series::{Fleet, day, natural};
use crate::page::{Cell, Page};

/// Recordings that are listed.
const MOST: usize = 100;

/// Adds the section, where there is any.
pub(super) fn add(page: &mut Page, all: &Fleet<'_>) {
    let of = |why: fn(&Finding) -> Option<&str>| -> Vec<(&DiagnosedRecording, &str)> {
        let mut out: Vec<(&DiagnosedRecording, &str)> =
            all.seen.iter().filter_map(|s| Some((s, why(&s.finding)?))).collect();
        out.sort_by(|a, b| natural(&a.0.id, &b.0.id));
        out
    };
    let failed = of(|finding| if let Finding::Failed(why) = finding { Some(why) } else { None });
    let withheld = of(|finding| if let Finding::Withheld(why) = finding { Some(why) } else { None });
    if failed.is_empty() && withheld.is_empty() {
        return;
    }
    page.section("No answer", "Recordings without an answer");
    for (name, list) in [("Failed", failed), ("Withheld", withheld)] {
        if list.is_empty() {
            continue;
        }
        let more =
            if list.len() > MOST { format!("the first {MOST} of {}", list.len()) } else { list.len().to_string() };
        let row = |(one, why): &(&DiagnosedRecording, &str)| -> Vec<Cell> {
            vec![one.id.as_str().into(), one.robot.as_str().into(), day(one.date).into(), (*why).into()]
        };
        let rows: Vec<Vec<Cell>> = list.iter().take(MOST).map(row).collect();
        page.folded(name, &more, list.len() <= MOST / 10, |page| {
            page.table_of_words(&["recording", "robot", "date", "why"], &rows);
        });
    }
}
