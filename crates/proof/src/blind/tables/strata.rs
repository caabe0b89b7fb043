//! Scores by what cases were recorded under.

use pages::page::Cell;

use super::super::score::statistics::{Rate, mean, median};
use super::super::score::{Kind, Row, STRATA};
use super::super::totals::Totals;
use crate::document::{Section, number};

/// The table of a wide set; none where all cases are of one size.
pub(super) fn table(rows: &[&Row]) -> Option<Section> {
    if rows.iter().all(|r| r.conditions.mass_kg.is_none()) {
        return None;
    }
    let header = [
        "recorded under",
        "cases",
        "nothing hidden: alarmed",
        "one hidden: right or its class",
        "outsiders: right",
        "invented cause",
        "inside the 90 % set",
        "answers in it",
        "size inside 90 %",
        "ECE",
        "worse than re-tuned: wheel, yaw",
        "core, s",
    ];
    let note = "Each stratum holds cases of all kinds; a case is in several. Invented: an effect that is not hidden is told to \
                be there more likely than not.";
    let mut out = Section::new("By robot, sensors and visit", note, &header);
    let every = ("all", rows.to_vec());
    let parts = STRATA.iter().map(|s| (s.name, rows.iter().copied().filter(|r| (s.holds)(&r.conditions)).collect()));
    for (name, part) in parts.chain([every]).filter(|(_, part): &(_, Vec<&Row>)| !part.is_empty()) {
        let t = Totals::of(&part);
        let singles = Totals::of(&part.iter().copied().filter(|r| r.kind == Kind::Single).collect::<Vec<_>>());
        let cells = [
            name.to_owned(),
            t.cases.to_string(),
            t.alarmed.counted(),
            singles.class.counted(),
            t.outsiders_unknown.counted(),
            t.invented.counted(),
            number(t.in_set.share()),
            number(mean(&t.set_sizes)),
            t.size_held.counted(),
            number(t.calibration_error),
            t.worse.map(Rate::counted).join(", "),
            number(median(&t.core_seconds)),
        ];
        out.rows.push(cells.map(Cell::from).to_vec());
    }
    Some(out)
}
