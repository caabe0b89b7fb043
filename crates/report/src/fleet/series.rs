//! Recordings sorted by robot, and the sizes of each effect in their order.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use chrono::DateTime;

use super::recording::{DiagnosedRecording, Finding, Named};
use super::since::{Since, since};
use super::trend::{Trend, trend};

/// Milliseconds of a day.
const DAY_MS: f64 = 86_400_000.0;

/// All recordings of a fleet.
pub(super) struct Fleet<'a> {
    pub(super) seen: &'a [DiagnosedRecording],
    /// By name, in its natural order.
    pub(super) robots: Vec<RobotHistory<'a>>,
}

/// The recordings of one robot.
pub(super) struct RobotHistory<'a> {
    pub(super) name: &'a str,
    /// In the order of time; of ids where a date is missing.
    pub(super) seen: Vec<&'a DiagnosedRecording>,
    pub(super) series: Vec<Series<'a>>,
}

/// The sizes of one effect on one side of one robot.
pub(super) struct Series<'a> {
    pub(super) robot: &'a str,
    pub(super) effect: &'a str,
    /// The name that the last recording gives it.
    pub(super) name: &'a str,
    pub(super) unit: &'a str,
    /// Whether all recordings with an answer have a date.
    pub(super) dated: bool,
    /// Recordings in which it is named.
    pub(super) points: Vec<Point<'a>>,
    /// Recordings with an answer.
    pub(super) answers: Vec<&'a DiagnosedRecording>,
    pub(super) trend: Option<Trend>,
    pub(super) since: Since,
}

/// An effect in a recording.
pub(super) struct Point<'a> {
    /// Days since 1970, or the number of the recording from 1.
    pub(super) x: f64,
    pub(super) seen: &'a DiagnosedRecording,
    pub(super) named: &'a Named,
}

impl Point<'_> {
    /// Size and half of its interval.
    pub(super) fn sized(&self) -> Option<[f64; 2]> {
        let [low, high] = self.named.interval?;
        Some([self.named.magnitude?, 0.5 * (high - low)])
    }
}

impl<'a> Fleet<'a> {
    pub(super) fn new(seen: &'a [DiagnosedRecording]) -> Self {
        let mut by_robot: BTreeMap<&str, Vec<&DiagnosedRecording>> = BTreeMap::new();
        for one in seen {
            by_robot.entry(&one.robot).or_default().push(one);
        }
        let mut robots: Vec<RobotHistory<'_>> =
            by_robot.into_iter().map(|(name, seen)| RobotHistory::new(name, seen)).collect();
        robots.sort_by(|a, b| natural(a.name, b.name));
        Self { seen, robots }
    }

    pub(super) fn series(&self) -> impl Iterator<Item = &Series<'a>> {
        self.robots.iter().flat_map(|r| &r.series)
    }

    /// How many recordings are of a kind.
    pub(super) fn count(&self, is: impl Fn(&Finding) -> bool) -> usize {
        self.seen.iter().filter(|s| is(&s.finding)).count()
    }
}

impl<'a> RobotHistory<'a> {
    fn new(name: &'a str, mut seen: Vec<&'a DiagnosedRecording>) -> Self {
        // What could not be read tells no date, and has no size to be dated.
        let dated = seen.iter().all(|s| s.date.is_some() || !s.finding.is_answer());
        seen.sort_by(|a, b| {
            let date = |one: &DiagnosedRecording| (one.date.is_none(), one.date);
            let by_date = if dated { date(a).cmp(&date(b)) } else { Ordering::Equal };
            by_date.then_with(|| natural(&a.id, &b.id))
        });
        let answers: Vec<&DiagnosedRecording> = seen.iter().copied().filter(|s| s.finding.is_answer()).collect();
        let mut points: BTreeMap<(&str, Option<&str>), Vec<Point<'_>>> = BTreeMap::new();
        for (number, &one) in answers.iter().enumerate() {
            let Finding::Explained(all) = &one.finding else { continue };
            let x = one.date.filter(|_| dated).map_or((number + 1) as f64, |ms| ms as f64 / DAY_MS);
            for named in all {
                let key = (named.effect.as_str(), named.side.as_deref());
                points.entry(key).or_default().push(Point { x, seen: one, named });
            }
        }
        let series = points.into_iter().filter_map(|((effect, _), points)| {
            let last = points.last()?.named;
            let is_here = |one: &DiagnosedRecording| points.iter().any(|p| std::ptr::eq(p.seen, one));
            let named: Vec<bool> = answers.iter().map(|one| is_here(one)).collect();
            let sized: Vec<[f64; 3]> =
                points.iter().filter_map(|p| p.sized().map(|[value, half]| [p.x, value, half])).collect();
            Some(Series {
                robot: name,
                effect,
                name: &last.name,
                unit: &last.unit,
                dated,
                trend: trend(&sized),
                since: since(&named),
                answers: answers.clone(),
                points,
            })
        });
        let series = series.collect();
        Self { name, seen, series }
    }
}

/// Names in the order of people: digits count as numbers.
pub(super) fn natural(a: &str, b: &str) -> Ordering {
    parts(a).cmp(&parts(b)).then_with(|| a.cmp(b))
}

/// Stretches of letters, and of digits by their length and value.
fn parts(text: &str) -> Vec<(bool, usize, &str)> {
    let mut out = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let digits = first.is_ascii_digit();
        let end = rest.find(|c: char| c.is_ascii_digit() != digits).unwrap_or(rest.len());
        let part = &rest[..end];
        let value = part.trim_start_matches('0');
        out.push(if digits { (false, value.len(), value) } else { (true, 0, part) });
        rest = &rest[end..];
    }
    out
}

/// The date of an instant, in UTC; empty where there is none.
pub(super) fn day(ms: Option<i64>) -> String {
    ms.and_then(DateTime::from_timestamp_millis).map_or_else(String::new, |t| t.format("%Y-%m-%d").to_string())
}
