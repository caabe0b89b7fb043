//! The comparison as tables and figures.

use pages::page::{Cell, Tone};

use super::outcome::{Outcome, Side, Spread};
use super::table::ROWS;
use crate::document::{Section, number, toned};
use crate::output::Figure;

/// A table for each group.
pub(super) fn all(outcomes: &[Outcome]) -> Vec<Section> {
    let mut groups: Vec<&str> = ROWS.iter().map(|r| r.group).collect();
    groups.dedup();
    groups.into_iter().map(|group| table(group, outcomes)).collect()
}

fn table(group: &str, outcomes: &[Outcome]) -> Section {
    let header = ["row", "what; beside what", "ours", "theirs", "ours / theirs", "asked", "met", "rounds"];
    let mut section = Section::new(group, "", &header);
    for row in outcomes.iter().filter(|o| o.group == group) {
        let met = match row.met {
            Some(true) => "yes".into(),
            Some(false) => toned("NO", Tone::Bad),
            None => "".into(),
        };
        section.rows.push(vec![
            row.name.as_str().into(),
            row.what.as_str().into(),
            side(&row.ours),
            side(&row.theirs),
            row.ratio().map_or_else(|| "".into(), |r| Cell::from(spread(r, ""))),
            row.asked.clone().unwrap_or_default().into(),
            met,
            row.rounds.to_string().into(),
        ]);
    }
    section
}

fn side(side: &Side) -> Cell {
    match side {
        Side::Absent => "".into(),
        Side::Ran(_) => side.spread().map_or_else(|| "".into(), |(s, unit)| Cell::from(spread(s, unit))),
        Side::Skipped(_) => "skipped".into(),
        Side::Failed(_) => toned("FAILED", Tone::Bad),
    }
}

/// `158 ns/step (156 to 161)`.
fn spread(s: Spread, unit: &str) -> String {
    let digits = |x: f64| number(Some(x));
    let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    format!("{}{unit} ({} to {})", digits(s.median), digits(s.least), digits(s.most))
}

/// What is behind the tables, in sentences.
pub(super) fn intro(outcomes: &[Outcome], machine: &str) -> String {
    let judged: Vec<bool> = outcomes.iter().filter_map(|o| o.met).collect();
    let met = judged.iter().filter(|met| **met).count();
    let mut text = format!(
        "Medians of rounds in turn (ours, theirs, ours, ...), each a process of its own on one thread, time on a processor; the \
         ratio is taken round by round; ranges in brackets. Of {} rows of which something is asked and that ran, {met} meet it. \
         {machine}",
        judged.len()
    );
    let skipped =
        outcomes.iter().filter(|o| [&o.ours, &o.theirs].iter().any(|s| matches!(s, Side::Skipped(_)))).count();
    if skipped > 0 {
        text += &[" In ", &skipped.to_string(), " rows a side was skipped: it cannot run here."].concat();
    }
    let failed: Vec<&str> = outcomes.iter().filter(|o| o.failure().is_some()).map(|o| o.name.as_str()).collect();
    if !failed.is_empty() {
        text += &[" FAILED: ", &failed.join(", "), "."].concat();
    }
    text
}

/// Figures for machines.
pub(super) fn figures(outcomes: &[Outcome]) -> Vec<Figure> {
    let mut figures = Vec::new();
    for row in outcomes {
        for (whose, side) in [("ours", &row.ours), ("theirs", &row.theirs)] {
            if let Some((s, unit)) = side.spread() {
                figures.push(Figure::free(format!("{}, {whose}", row.name), s.median, unit));
            }
        }
        if let Some(ratio) = row.ratio() {
            let mut figure = Figure::free(format!("{}, ours over theirs", row.name), ratio.median, "");
            (figure.target, figure.pass) = (row.asked.clone(), row.met);
            figures.push(figure);
        }
    }
    figures
}

#[cfg(test)]
mod tests {
    use super::super::outcome::tests::{outcome, ran};
    use super::super::table::Goal;
    use super::*;
    use crate::document::to_markdown;

    #[test]
    fn tables_tell_ranges_goals_and_what_did_not_run() {
        let met = outcome(ran(&[1.0, 3.0, 2.0], "ns"), ran(&[4.0, 4.0, 4.0], "ns")).judged(Goal::AtMost(0.75));
        let missed = outcome(ran(&[1.0], "ms"), ran(&[2.0], "ms")).judged(Goal::Faster(10.0));
        let failed = outcome(Side::Failed("exit code 1".into()), Side::Skipped("no make".into()));
        let rows = [met, missed, failed];
        let text = to_markdown("T", &intro(&rows, "A machine."), &all(&rows));
        for line in [
            "Of 2 rows of which something is asked and that ran, 1 meet it. A machine. In 1 rows a side was skipped",
            "FAILED: plant.",
            "| plant | a step | 2 ns (1 to 3) | 4 ns (4 to 4) | 0.5000 (0.2500 to 0.7500) | <= 0.75 | yes | 3 |",
            "| 0.5000 (0.5000 to 0.5000) | <= 1/10 | **NO** | 3 |",
            "| plant | a step | **FAILED** | skipped |  |  |  | 3 |",
        ] {
            assert!(text.contains(line), "no '{line}' in\n{text}");
        }
        let figures = figures(&rows);
        assert_eq!(figures.iter().filter(|f| f.pass == Some(false)).count(), 1);
    }
}
