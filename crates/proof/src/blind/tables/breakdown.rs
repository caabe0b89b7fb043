//! The same scores for parts of the set.

use std::collections::BTreeSet;

use pages::page::Cell;

use super::super::figures::QUANTITIES;
use super::super::score::statistics::{Rate, mean, median};
use super::super::score::{Kind, Row};
use super::super::totals::Totals;
use crate::document::{Section, number};

/// Names of severities by their number.
const SEVERITIES: [&str; 3] = ["mild", "medium", "strong"];

/// Tables by kind, by difficulty, by effect, by outsider, and of held-out drives.
pub(super) fn all(rows: &[&Row]) -> Vec<Section> {
    vec![by_kind(rows), by_difficulty(rows), by_effect(rows), outsiders(rows), held_out(rows)]
}

fn cells(texts: impl IntoIterator<Item = String>) -> Vec<Cell> {
    texts.into_iter().map(Cell::from).collect()
}

fn of_kind<'a>(rows: &[&'a Row], kind: Kind) -> Vec<&'a Row> {
    rows.iter().copied().filter(|r| r.kind == kind).collect()
}

fn by_kind(rows: &[&Row]) -> Section {
    let header = ["hidden", "cases", "right", "inside the 90 % set", "answers in it", "Brier", "ECE", "core, s"];
    let note = "Right: of singles and pairs, the first effect named is hidden; of pairs see also the figures. \
                Shares with 95 % intervals after Wilson.";
    let mut out = Section::new("By kind", note, &header);
    let kinds = Kind::ALL.map(|k| (k.name(), of_kind(rows, k)));
    for (name, part) in kinds.into_iter().chain([("all", rows.to_vec())]).filter(|(_, part)| !part.is_empty()) {
        let t = Totals::of(&part);
        out.rows.push(cells([
            name.to_owned(),
            t.cases.to_string(),
            t.right.to_string(),
            t.in_set.to_string(),
            number(mean(&t.set_sizes)),
            number(mean(&t.briers)),
            number(t.calibration_error),
            number(median(&t.core_seconds)),
        ]));
    }
    out
}

fn by_difficulty(rows: &[&Row]) -> Section {
    let header = ["cases with effects", "cases", "top-1", "both of a pair", "called unknown", "missed", "size error"];
    let mut out = Section::new("By difficulty", "One effect or more.", &header);
    let hidden: Vec<&Row> = rows.iter().copied().filter(|r| r.kind.in_catalogue()).collect();
    let names = |f: fn(&Row) -> &str| hidden.iter().map(|r| f(r).to_owned()).collect::<BTreeSet<_>>();
    let mut parts: Vec<(String, Vec<&Row>)> = Vec::new();
    for (number, name) in (0_u8..).zip(SEVERITIES) {
        let part = hidden.iter().copied().filter(|r| r.severity == Some(number));
        parts.push((name.to_owned(), part.collect()));
    }
    for field in [(|r| r.setting.as_str()) as fn(&Row) -> &str, |r| r.law.as_str()] {
        for name in names(field) {
            let part = hidden.iter().copied().filter(|r| field(r) == name);
            parts.push((name.clone(), part.collect()));
        }
    }
    parts.push(("below the noise".to_owned(), hidden.iter().copied().filter(|r| r.below_noise).collect()));
    for (name, part) in parts.iter().filter(|(_, part)| !part.is_empty()) {
        let t = Totals::of(part);
        out.rows.push(cells([
            name.clone(),
            t.cases.to_string(),
            t.right.to_string(),
            t.both_of_pair.to_string(),
            t.called_unknown.to_string(),
            t.missed.to_string(),
            number(median(&t.size_errors)),
        ]));
    }
    out
}

fn by_effect(rows: &[&Row]) -> Section {
    let header = ["effect", "cases", "top-1", "in its class", "size error, median", "size inside 90 %", "overlap"];
    let mut out = Section::new("By effect", "Singles.", &header);
    let singles = of_kind(rows, Kind::Single);
    for effect in singles.iter().filter_map(|r| r.hidden.first()).collect::<BTreeSet<_>>() {
        let part: Vec<&Row> = singles.iter().copied().filter(|r| r.hidden.first() == Some(effect)).collect();
        let t = Totals::of(&part);
        out.rows.push(cells([
            effect.clone(),
            t.cases.to_string(),
            t.right.counted(),
            t.class.counted(),
            number(median(&t.size_errors)),
            t.size_held.counted(),
            number(mean(&t.overlaps)),
        ]));
    }
    out
}

fn outsiders(rows: &[&Row]) -> Section {
    let header = ["outsider", "cases", "called unknown", "other answers"];
    let mut out = Section::new("Causes outside the vocabulary", "", &header);
    let all = of_kind(rows, Kind::Outsider);
    for outsider in all.iter().filter_map(|r| r.hidden.first()).collect::<BTreeSet<_>>() {
        let part = || all.iter().filter(|r| r.hidden.first() == Some(outsider));
        let unknown: Rate = part().map(|r| r.naming.right).collect();
        let others: Vec<&str> = part().filter(|r| !r.naming.right).map(|r| r.naming.answer.as_str()).collect();
        out.rows.push(cells([outsider.clone(), unknown.count.to_string(), unknown.counted(), others.join(", ")]));
    }
    out
}

fn held_out(rows: &[&Row]) -> Section {
    let header = [
        "rms error, rad/s",
        "cases",
        "user's values",
        "true values, no effect",
        "own model",
        "corrected",
        "perfect",
        "closed, median",
        "closed, mean",
        "from own, median",
        "worse than own",
    ];
    let note = "Medians over singles and pairs in which what is hidden makes a difference (error 1.5 times that of a \
                perfect model, and more than 0.05 or 0.01 rad/s above it). Worse: by more than 5 %, of all cases.";
    let mut out = Section::new("Held-out drives", note, &header);
    let all = Totals::of(rows);
    for (of, quantity) in QUANTITIES.iter().enumerate() {
        let gap: Vec<&Row> = rows.iter().copied().filter(|r| r.kind.in_catalogue() && r.heldout.has_gap(of)).collect();
        if gap.is_empty() {
            continue;
        }
        let middle = |f: &dyn Fn(&Row) -> Option<[f64; 2]>| {
            number(median(&gap.iter().filter_map(|r| f(r)).map(|e| e[of]).collect::<Vec<_>>()))
        };
        out.rows.push(cells([
            (*quantity).to_owned(),
            gap.len().to_string(),
            middle(&|r| Some(r.heldout.nominal)),
            middle(&|r| Some(r.heldout.calibrated)),
            middle(&|r| r.heldout.own),
            middle(&|r| r.heldout.tool),
            middle(&|r| Some(r.heldout.oracle)),
            number(median(&all.closed[of])),
            number(mean(&all.closed[of])),
            number(median(&all.closed_from_own[of])),
            all.worse[of].counted(),
        ]));
    }
    out
}
