//! The fleet at a glance.

use std::collections::{BTreeMap, BTreeSet};

use super::Finding;
use super::series::{Fleet, day};
use crate::facts::Facts;
use crate::figure::{Drawing, Figure, Interval, Intervals};
use crate::page::{Cell, Page};
use crate::words::number;
use inference::robust::median;

/// Effects that are compared over robots.
const COMPARED: usize = 6;
/// Robots in such a comparison.
const ROBOTS: usize = 30;

fn plural(count: usize, word: &str) -> String {
    if count == 1 { format!("{count} {word}") } else { format!("{count} {word}s") }
}

/// What one would tell a colleague.
pub(super) fn heading(all: &Fleet<'_>) -> String {
    let ill = all.robots.iter().filter(|r| r.seen.iter().any(|s| s.finding.is_mismatch())).count();
    format!(
        "{ill} of {} {} simulation in {}.",
        plural(all.robots.len(), "robot"),
        if ill == 1 { "differs from its" } else { "differ from their" },
        plural(all.seen.len(), "recording")
    )
}

/// Adds figures, and effects over the fleet.
pub(super) fn add(page: &mut Page, all: &Fleet<'_>) {
    page.markup(&facts(all));
    let trends: Vec<String> = all
        .series()
        .filter(|s| s.trend.is_some_and(|t| t.is_clear()))
        .map(|s| format!("{}, {}", s.robot, s.name))
        .collect();
    if let Some(first) = trends.first() {
        let more = trends.len() - 1;
        let more = if more > 0 { format!(" and {more} more") } else { String::new() };
        page.lead(&format!("A size changes with time: {first}{more}."));
    }
    effects(page, all);
}

fn facts(all: &Fleet<'_>) -> String {
    let mut facts = Facts::default();
    let dates = || all.seen.iter().filter_map(|s| s.date);
    let span = match (dates().min(), dates().max()) {
        (Some(from), Some(to)) => format!("{} to {}", day(Some(from)), day(Some(to))),
        _ => "no dates".to_owned(),
    };
    facts.add("", "recordings", &all.seen.len().to_string(), &span);
    facts.add("", "robots", &all.robots.len().to_string(), "");
    let answers = all.count(Finding::is_answer);
    let mismatches = all.count(Finding::is_mismatch);
    let share = if answers > 0 { 100.0 * mismatches as f64 / answers as f64 } else { 0.0 };
    let unknown = all.count(|t| matches!(t, Finding::Unknown));
    let more = format!("{mismatches} of {answers} answers, {unknown} of them unknown");
    facts.add("before", "with a mismatch", &format!("{share:.0} %"), &more);
    let withheld = all.count(|t| matches!(t, Finding::Withheld(_)));
    let failed = all.count(|t| matches!(t, Finding::Failed(_)));
    facts.add(
        "",
        "without an answer",
        &(withheld + failed).to_string(),
        &format!("{failed} failed, {withheld} withheld"),
    );
    facts.markup()
}

/// Which effect, in how many robots; and how robots differ by it.
fn effects(page: &mut Page, all: &Fleet<'_>) {
    let mut by_effect: BTreeMap<&str, (BTreeSet<&str>, usize)> = BTreeMap::new();
    for series in all.series() {
        let (robots, count) = by_effect.entry(series.effect).or_default();
        robots.insert(series.robot);
        *count += series.points.len();
    }
    if by_effect.is_empty() {
        page.paragraph("No effect was named in any recording.");
        return;
    }
    let mut sorted: Vec<(&str, (BTreeSet<&str>, usize))> = by_effect.into_iter().collect();
    sorted.sort_by_key(|(_, (robots, count))| std::cmp::Reverse((robots.len(), *count)));
    page.section("Effects", "Effects over the fleet");
    let row = |(effect, (robots, count)): &(&str, (BTreeSet<&str>, usize))| -> Vec<Cell> {
        vec![(*effect).into(), robots.len().to_string().into(), count.to_string().into()]
    };
    page.table(&["effect", "robots", "recordings"], &sorted.iter().map(row).collect::<Vec<_>>());
    let figures: Vec<Figure> = sorted.iter().filter_map(|(effect, _)| compared(all, effect)).take(COMPARED).collect();
    if !figures.is_empty() {
        page.grid(&figures);
    }
}

/// The last size of an effect on each robot; none where there is nothing to compare.
fn compared(all: &Fleet<'_>, effect: &str) -> Option<Figure> {
    let series = all.series().filter(|s| s.effect == effect);
    let mut last: Vec<(String, [f64; 2])> = series
        .filter_map(|s| {
            let sized = s.points.iter().rev().find_map(super::series::Point::sized)?;
            let side = s.points.last()?.named.side.as_ref().map_or(String::new(), |side| format!(", {side}"));
            Some((format!("{}{side}", s.robot), sized))
        })
        .collect();
    if last.len() < 2 {
        return None;
    }
    let of = all.series().find(|s| s.effect == effect)?;
    let median = median(last.iter().map(|(_, v)| v[0]))?;
    last.sort_by(|a, b| b.1[0].abs().total_cmp(&a.1[0].abs()));
    let left = last.len().saturating_sub(ROBOTS);
    last.truncate(ROBOTS);
    let left = if left > 0 { format!(" The {ROBOTS} largest; {left} more are left out.") } else { String::new() };
    let six = |v: f64| crate::thin::six_digits(v).unwrap_or_default();
    let row = |(name, [value, half]): &(String, [f64; 2])| Interval {
        name: name.clone(),
        value: six(*value),
        low: six(value - half),
        high: six(value + half),
        stands_out: (value - median).abs() > *half,
    };
    let cells = |(name, [value, half]): &(String, [f64; 2])| -> Vec<Cell> {
        let interval = format!("{} to {}", number(value - half), number(value + half));
        vec![name.as_str().into(), number(*value).into(), interval.into()]
    };
    Some(Figure {
        title: effect.to_owned(),
        caption: format!(
            "Last size on each robot, with its 90 % interval; dashed: the median of these robots. Coloured: the interval \
             leaves out the median.{left}"
        ),
        table: (vec!["robot", "last size", "90 % interval"], last.iter().map(cells).collect()),
        drawing: Drawing::Intervals(Intervals {
            x: if of.unit == "-" { effect.to_owned() } else { format!("{effect}, {}", of.unit) },
            neutral: six(median),
            rows: last.iter().map(row).collect(),
        }),
    })
}
