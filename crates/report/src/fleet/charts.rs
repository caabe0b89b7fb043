//! Every effect of every robot over time.

use super::series::{Fleet, Point, Series, day};
use super::since::{Change, FEWEST, Since};
use crate::chart::{Chart, Line};
use crate::figure::{Drawing, Figure, Role};
use crate::page::{Cell, Page};
use crate::words::{NINETY, number};

/// Charts on a page.
const MOST: usize = 24;
/// Points of a chart: beyond, neighbours are joined.
const POINTS: usize = 200;
/// Rows of the numbers below a chart.
const ROWS: usize = 50;
/// Slopes of longer histories are reported per 30 days.
const LONG_DAYS: f64 = 60.0;

/// Adds the section.
pub(super) fn add(page: &mut Page, all: &Fleet<'_>) {
    let mut series: Vec<&Series<'_>> = all.series().filter(|s| sized(s).count() > 1).collect();
    let count = series.len();
    if count == 0 {
        return;
    }
    // First what changes, then what is known best.
    series.sort_by_key(|s| std::cmp::Reverse((s.trend.is_some_and(|t| t.is_clear()), s.points.len())));
    series.truncate(MOST);
    page.section("Over time", "Sizes over time");
    page.grid(&series.iter().map(|s| figure(s)).collect::<Vec<_>>());
    if count > MOST {
        page.note(&format!(
            "{MOST} of {count} effects on robots are drawn: first those with a trend, then those with most recordings. The \
             table of rows has all."
        ));
    }
}

fn sized<'s, 'a>(s: &'s Series<'a>) -> impl Iterator<Item = (&'s Point<'a>, [f64; 2])> {
    s.points.iter().filter_map(|p| p.sized().map(|sized| (p, sized)))
}

/// Points of the chart: abscissa, value, half of its interval; neighbours joined so that no more than so many are left.
fn joined(all: &[[f64; 3]]) -> (Vec<[f64; 3]>, usize) {
    let size = all.len().div_ceil(POINTS).max(1);
    let join = |part: &[[f64; 3]]| {
        let weight = |p: &[f64; 3]| (NINETY / p[2].max(f64::MIN_POSITIVE)).powi(2);
        let sum: f64 = part.iter().map(weight).sum();
        let mean = |i: usize| part.iter().map(|p| weight(p) * p[i]).sum::<f64>() / sum;
        // By their own intervals, or by how they scatter: the larger one.
        let scatter = part.iter().map(|p| weight(p) * (p[1] - mean(1)).powi(2)).sum::<f64>();
        let excess = if part.len() > 1 { (scatter / (part.len() - 1) as f64).max(1.0) } else { 1.0 };
        [mean(0), mean(1), NINETY * (excess / sum).sqrt()]
    };
    (if size == 1 { all.to_vec() } else { all.chunks(size).map(join).collect() }, size)
}

fn figure(s: &Series<'_>) -> Figure {
    let origin = if s.dated { s.points.first().map_or(0.0, |p| p.x.floor()) } else { 0.0 };
    let all: Vec<[f64; 3]> = sized(s).map(|(p, [value, half])| [p.x - origin, value, half]).collect();
    let (shown, size) = joined(&all);
    let six = |v: f64| crate::thin::six_digits(v).unwrap_or_default();
    let of = |i: usize| -> Vec<f64> { shown.iter().map(|p| p[i]).collect() };
    let sizes = Line {
        role: Some(Role::Recorded),
        intervals: shown.iter().map(|p| [six(p[1] - p[2]), six(p[1] + p[2])]).collect(),
        ..Line::new("size, 90 % interval", &of(0), &of(1))
    };
    let mut lines = vec![sizes];
    if let (Some(trend), Some(first), Some(last)) = (s.trend, shown.first(), shown.last()) {
        let x = [first[0], last[0]];
        let name = if trend.is_clear() { "trend" } else { "line, no clear trend" };
        let line = Line::new(name, &x, &x.map(|x| trend.at(x + origin)));
        let role = Some(if trend.is_clear() { Role::Before } else { Role::Placebo });
        lines.push(Line { role, ..line.dashed() });
    }
    let unit = if s.unit == "-" { String::new() } else { format!(", {}", s.unit) };
    let x_label = if s.dated {
        format!("days after {}", day(s.points.first().and_then(|p| p.seen.date)))
    } else {
        "number of the recording".to_owned()
    };
    let mut caption = vec![trend_in_words(s), format!("Since: {}.", since_in_words(s))];
    if !s.dated {
        caption.push("Dates are missing: the recordings are in the order of their names.".to_owned());
    }
    if size > 1 {
        caption.push(format!("Each point is the weighted mean of {size} recordings."));
    }
    let row = |(p, [value, half]): (&Point<'_>, [f64; 2])| -> Vec<Cell> {
        let interval = format!("{} to {}", number(value - half), number(value + half));
        vec![p.seen.id.as_str().into(), day(p.seen.date).into(), number(value).into(), interval.into()]
    };
    let skipped = all.len().saturating_sub(ROWS);
    if skipped > 0 {
        caption.push(format!("The numbers are those of the last {ROWS} recordings."));
    }
    Figure {
        title: format!("{}: {}", s.robot, s.name),
        caption: caption.join(" "),
        table: (vec!["recording", "date", "size", "90 % interval"], sized(s).skip(skipped).map(row).collect()),
        drawing: Drawing::Lines(Chart { x_label, y_label: format!("{}{unit}", s.effect), lines, ..Chart::default() }),
    }
}

/// What the line through the sizes says.
fn trend_in_words(s: &Series<'_>) -> String {
    let Some(trend) = s.trend else {
        let count = sized(s).count();
        let why = if count < FEWEST {
            format!("{count} sizes are too few")
        } else {
            "the sizes lie at one instant, or an interval is missing".to_owned()
        };
        return format!("Whether it changes cannot be judged: {why}.");
    };
    let days = s.points.last().map_or(0.0, |p| p.x) - s.points.first().map_or(0.0, |p| p.x);
    let (factor, per) = match (s.dated, days > LONG_DAYS) {
        (true, true) => (30.0, "30 days"),
        (true, false) => (1.0, "day"),
        (false, _) => (1.0, "recording"),
    };
    let unit = if s.unit == "-" { String::new() } else { format!("{} ", s.unit) };
    let [slope, half] = [trend.slope, trend.half].map(|v| factor * v);
    let change = format!("{} ± {} {unit}per {per} (90 %)", number(slope), number(half));
    if trend.is_clear() {
        format!("It {} by {change}.", if slope > 0.0 { "rises" } else { "falls" })
    } else {
        format!("No clear trend: {change}.")
    }
}

/// Since when, in words.
pub(super) fn since_in_words(s: &Series<'_>) -> String {
    let name = |i: usize| {
        let one = s.answers.get(i);
        one.map_or(String::new(), |one| if s.dated { day(one.date) } else { one.id.clone() })
    };
    match s.since {
        Since::TooFew => format!("cannot be determined from {} recordings", s.answers.len()),
        Since::Always => "before the first recording: it is named in all".to_owned(),
        Since::Unclear(p) => format!("cannot be determined: a change has probability {p:.2}"),
        Since::Changed(Change { came, first_after: [from, to], best, .. }) => {
            let verb = if came { "came" } else { "went" };
            // It came after the last recording without it.
            let (earliest, latest) = (name(from.saturating_sub(1)), name(to));
            format!("{verb} between {earliest} and {latest} (90 %), likeliest just before {}", name(best))
        }
    }
}
