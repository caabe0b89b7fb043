//! Answers that name causes, against what was hidden: the rows, figures and tables of kinds whose cases hide things by name.

use examiner::{car, command, rolling, wheeled};
use serde::Serialize;

use super::drawn::{List, intervals};
use super::score::statistics::median;
use crate::document::Section;
use crate::output::Asked::{AtLeast, AtMost};
use crate::output::Figure;

/// Distance from the hidden onset within which one is told, s.
const ONSET: f64 = 2.0;

/// Something that can be hidden.
pub(super) trait Hidden: Copy + PartialEq + 'static {
    const ALL: &'static [Self];
    /// Name for people.
    fn name(self) -> &'static str;
}

macro_rules! hidden {
    ($($of:ty),*) => {
        $(impl Hidden for $of {
            const ALL: &'static [Self] = &<$of>::ALL;
            fn name(self) -> &'static str {
                <$of>::name(self)
            }
        })*
    };
}
hidden!(command::Hidden, rolling::Hidden, car::CarHidden, wheeled::WheeledHidden);

/// What came of a case.
#[derive(Debug, Clone, Serialize)]
pub(in crate::blind) struct Row<H> {
    pub(super) case: String,
    /// Kind of the robot, where there are several.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) robot: Option<&'static str>,
    pub(super) hidden: Vec<H>,
    /// As the verdict says it; "refused" without one.
    pub(super) verdict: String,
    pub(super) headline: String,
    /// Causes that are named, with the wheel that they are about.
    pub(super) named: Vec<String>,
    /// Whether each hidden thing is named, or is of the class of what is named.
    pub(super) found: Vec<bool>,
    /// Named causes that were not hidden.
    pub(super) invented: Vec<String>,
    /// Numbers that were hidden and are told: name, error over half of the 90 % interval.
    pub(super) errors: Vec<(String, f64)>,
    /// Position of what was left out, over the time of [`Asks::forecast`]: corrected over the error as stated.
    pub(super) forecast: Option<f64>,
    pub(super) processor_seconds: Option<f64>,
    /// Whether it begins while the robot drives, and how the onset was told; of kinds
    /// whose cases have such.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) onset: Option<Onset>,
}

/// An onset as it was hidden, and as it was told.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(super) struct Onset {
    /// Whether what is hidden begins while the robot drives.
    pub(super) is_hidden: bool,
    /// Whether an onset is told.
    pub(super) is_told: bool,
    /// How late it is told, s; nothing in another recording.
    pub(super) late: Option<f64>,
}

impl<H> Row<H> {
    /// Whether a cause or "unknown" is told.
    pub(super) fn is_answered(&self) -> bool {
        matches!(self.verdict.as_str(), "explained" | "unknown")
    }

    /// Alarmed without cause, something hidden that is not named, or a cause that was not hidden.
    fn is_wrong(&self) -> bool {
        if self.hidden.is_empty() {
            self.is_answered()
        } else {
            self.found.contains(&false) || !self.invented.is_empty()
        }
    }
}

/// What is asked of a kind beside what is asked of all.
pub(super) struct Asks {
    /// Name of the figure of what is named.
    pub(super) named: &'static str,
    /// Least and largest share of intervals that hold.
    pub(super) held: [f64; 2],
    /// Name of the figure of forecasts.
    pub(super) forecast: &'static str,
}

/// All figures.
pub(super) fn figures<H: Hidden>(rows: &[Row<H>], asks: &Asks) -> Vec<Figure> {
    let mut list = List::default();
    let nothing = || rows.iter().filter(|r| r.hidden.is_empty());
    let hidden = || rows.iter().filter(|r| !r.hidden.is_empty());
    list.share("nothing hidden: alarmed", Some(AtMost(0.02)), nothing().map(Row::is_answered));
    list.share("refused", Some(AtMost(0.0)), rows.iter().map(|r| r.verdict == "refused"));
    list.share(asks.named, Some(AtLeast(0.95)), hidden().flat_map(|r| r.found.iter().copied()));
    list.share("something hidden: a cause is invented", Some(AtMost(0.05)), hidden().map(|r| !r.invented.is_empty()));
    list.share("something hidden: called unknown", None, hidden().map(|r| r.verdict == "unknown"));
    let mut robots: Vec<&str> = Vec::new();
    for robot in rows.iter().filter_map(|r| r.robot) {
        if !robots.contains(&robot) {
            robots.push(robot);
        }
    }
    for robot in robots {
        let of = || hidden().filter(move |r| r.robot == Some(robot));
        let found = of().flat_map(|r| r.found.iter().copied());
        list.share(&format!("{robot}: named"), Some(AtLeast(0.95)), found);
        let invented = of().map(|r| !r.invented.is_empty());
        list.share(&format!("{robot}: a cause is invented"), None, invented);
    }
    for kind in H::ALL {
        let of = hidden().flat_map(|r| r.hidden.iter().zip(&r.found).filter(|(h, _)| *h == kind));
        list.share(&format!("{}: named", kind.name()), None, of.map(|(_, found)| *found));
    }
    let onsets: Vec<Onset> = rows.iter().filter_map(|r| r.onset).collect();
    if !onsets.is_empty() {
        let near = |o: &Onset| o.late.is_some_and(|late| late.abs() <= ONSET);
        let begun = onsets.iter().filter(|o| o.is_hidden);
        list.share("begins while driving: onset within 2 s", Some(AtLeast(0.8)), begun.map(near));
        let always = onsets.iter().filter(|o| !o.is_hidden);
        list.share("there all the time, or nothing: an onset is told", Some(AtMost(0.03)), always.map(|o| o.is_told));
    }
    let held: Vec<bool> = rows.iter().flat_map(|r| &r.errors).map(|(_, e)| e.abs() <= 1.0).collect();
    let [least, most] = asks.held;
    list.share("90 % intervals of hidden numbers that hold", Some(AtLeast(least)), held.iter().copied());
    list.share("the same, not too wide", Some(AtMost(most)), held.iter().copied());
    let forecasts: Vec<f64> = hidden().filter_map(|r| r.forecast).collect();
    list.value(asks.forecast, median(&forecasts), "", AtMost(0.5));
    let seconds: Vec<f64> = rows.iter().filter_map(|r| r.processor_seconds).collect();
    list.value("time of a case on one core, median", median(&seconds), "s", AtMost(10.0));
    list.0
}

/// Intervals by number, and every case that is not right.
pub(super) fn tables<H: Hidden>(rows: &[Row<H>]) -> Vec<Section> {
    let numbers = intervals(rows.iter().flat_map(|r| &r.errors));
    let has_robots = rows.iter().any(|r| r.robot.is_some());
    let mut head = vec!["case", "hidden", "verdict", "named"];
    if has_robots {
        head.insert(1, "robot");
    }
    let mut wrong = Section::new(
        "Cases that are not right",
        "Alarmed without cause, something hidden that is not named, or a cause that was not hidden.",
        &head,
    );
    for r in rows.iter().filter(|r| r.is_wrong()) {
        let hidden: Vec<&str> = r.hidden.iter().map(|h| h.name()).collect();
        let hidden = if hidden.is_empty() { "nothing".to_owned() } else { hidden.join(", ") };
        let mut cells = vec![r.case.clone(), hidden, r.verdict.clone(), r.named.join(", ")];
        if has_robots {
            cells.insert(1, r.robot.unwrap_or_default().to_owned());
        }
        wrong.rows.push(cells.into_iter().map(Into::into).collect());
    }
    vec![numbers, wrong]
}
