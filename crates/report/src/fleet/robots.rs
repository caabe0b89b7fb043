//! Robots by effects: what is there, how large, since when.

use super::charts::since_in_words;
use super::recording::Finding;
use super::series::{Fleet, RobotHistory, Series, day};
use crate::page::{Cell, Page, Tone};
use crate::words::{number, probability};

/// Rows of a table.
const MOST: usize = 200;

/// Adds both tables.
pub(super) fn add(page: &mut Page, all: &Fleet<'_>) {
    page.section("Robots", "Robots and what they have");
    let mut series: Vec<&Series<'_>> = all.series().collect();
    let left = series.len().saturating_sub(MOST);
    if left > 0 {
        // Those with most recordings, in the order of the robots.
        let mut counts: Vec<usize> = series.iter().map(|s| s.points.len()).collect();
        counts.sort_unstable_by_key(|count| std::cmp::Reverse(*count));
        series.retain(|s| s.points.len() >= counts[MOST - 1]);
        series.truncate(MOST);
    }
    if !series.is_empty() {
        let header = ["robot", "effect", "last size (90 %)", "probability", "named in", "first seen", "since"];
        page.table_of_words(&header, &series.iter().map(|s| effect(s)).collect::<Vec<_>>());
    }
    if left > 0 {
        page.note(&format!("The {MOST} with most recordings; {left} more are in the table of rows."));
    }
    let rows: Vec<Vec<Cell>> = all.robots.iter().take(MOST).map(robot).collect();
    let more = if all.robots.len() > MOST {
        format!("the first {MOST} of {}", all.robots.len())
    } else {
        format!("{} in all", rows.len())
    };
    page.folded("All robots", &more, series.is_empty(), |page| {
        let header = ["robot", "recordings", "explained", "unknown", "no mismatch", "withheld", "failed", "from", "to"];
        page.table(&header, &rows);
    });
}

fn effect(s: &Series<'_>) -> Vec<Cell> {
    let Some(last) = s.points.last() else { return Vec::new() };
    let unit = if s.unit == "-" { String::new() } else { format!(" {}", s.unit) };
    let size = match (last.named.magnitude, last.named.interval) {
        (Some(m), Some([low, high])) => format!("{}{unit} [{}, {}]", number(m), number(low), number(high)),
        (Some(m), None) => number(m) + &unit,
        (None, _) => String::new(),
    };
    let first = s.points.first().map(|p| &p.seen);
    let first = first.map_or(String::new(), |one| if s.dated { day(one.date) } else { one.id.clone() });
    vec![
        s.robot.into(),
        s.name.into(),
        size.into(),
        probability(last.named.probability).into(),
        format!("{} of {}", s.points.len(), s.answers.len()).into(),
        first.into(),
        since_in_words(s).into(),
    ]
}

fn robot(r: &RobotHistory<'_>) -> Vec<Cell> {
    let count = |is: &dyn Fn(&Finding) -> bool| r.seen.iter().filter(|s| is(&s.finding)).count();
    let plain = |n: usize| Cell::from(n.to_string());
    let bad = |n: usize| Cell { text: n.to_string(), tone: if n > 0 { Tone::Bad } else { Tone::Plain } };
    let dates = || r.seen.iter().filter_map(|s| s.date);
    vec![
        r.name.into(),
        plain(r.seen.len()),
        plain(count(&|t| matches!(t, Finding::Explained(_)))),
        plain(count(&|t| matches!(t, Finding::Unknown))),
        plain(count(&|t| matches!(t, Finding::NoMismatch))),
        plain(count(&|t| matches!(t, Finding::Withheld(_)))),
        bad(count(&|t| matches!(t, Finding::Failed(_)))),
        day(dates().min()).into(),
        day(dates().max()).into(),
    ]
}
