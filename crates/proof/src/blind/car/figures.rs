//! Figures of a set with what is asked of them.

use examiner::car::CarHidden;

use super::score::Row;
use crate::blind::drawn::{List, intervals};
use crate::blind::score::statistics::median;
use crate::document::Section;
use crate::output::Asked::{AtLeast, AtMost};
use crate::output::Figure;

/// All figures.
pub(super) fn figures(rows: &[Row]) -> Vec<Figure> {
    let mut list = List::default();
    let nothing = || rows.iter().filter(|r| r.hidden.is_empty());
    let hidden = || rows.iter().filter(|r| !r.hidden.is_empty());
    list.share("nothing hidden: alarmed", Some(AtMost(0.02)), nothing().map(Row::is_answered));
    list.share("refused", Some(AtMost(0.0)), rows.iter().map(|r| r.verdict == "refused"));
    list.share("hidden: named, or its class", Some(AtLeast(0.95)), hidden().flat_map(|r| r.found.iter().copied()));
    list.share("something hidden: a cause is invented", Some(AtMost(0.05)), hidden().map(|r| !r.invented.is_empty()));
    list.share("something hidden: called unknown", None, hidden().map(|r| r.verdict == "unknown"));
    for kind in CarHidden::ALL {
        let of = hidden().flat_map(move |r| r.hidden.iter().zip(&r.found).filter(move |(h, _)| **h == kind));
        list.share(&format!("{}: named", kind.name()), None, of.map(|(_, found)| *found));
    }
    let held: Vec<bool> = rows.iter().flat_map(|r| &r.errors).map(|(_, e)| e.abs() <= 1.0).collect();
    list.share("90 % intervals of hidden numbers that hold", Some(AtLeast(0.87)), held.iter().copied());
    list.share("the same, not too wide", Some(AtMost(0.93)), held.iter().copied());
    let forecasts: Vec<f64> = hidden().filter_map(|r| r.forecast).collect();
    list.value("position after 2 s, left out: corrected over stated, median", median(&forecasts), "", AtMost(0.5));
    let seconds: Vec<f64> = rows.iter().filter_map(|r| r.processor_seconds).collect();
    list.value("time of a case on one core, median", median(&seconds), "s", AtMost(10.0));
    list.0
}

/// Intervals by number, and every case that is not right.
pub(super) fn tables(rows: &[Row]) -> Vec<Section> {
    let numbers = intervals(rows.iter().flat_map(|r| &r.errors));
    let mut wrong = Section::new(
        "Cases that are not right",
        "Alarmed without cause, something hidden that is not named, or a cause that was not hidden.",
        &["case", "hidden", "verdict", "named"],
    );
    let is_wrong = |r: &&Row| {
        if r.hidden.is_empty() { r.is_answered() } else { r.found.contains(&false) || !r.invented.is_empty() }
    };
    for r in rows.iter().filter(is_wrong) {
        let hidden: Vec<&str> = r.hidden.iter().map(|h| h.name()).collect();
        let hidden = if hidden.is_empty() { "nothing".to_owned() } else { hidden.join(", ") };
        let cells = [r.case.clone(), hidden, r.verdict.clone(), r.named.join(", ")];
        wrong.rows.push(cells.map(Into::into).to_vec());
    }
    vec![numbers, wrong]
}
