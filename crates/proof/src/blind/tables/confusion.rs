//! What was hidden against what was answered.

use std::collections::{BTreeMap, BTreeSet};

use pages::page::{Cell, Tone};

use super::super::score::{Kind, Row};
use crate::document::{Section, toned};

/// What was hidden: effects first, then nothing, then outsiders.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
enum Hidden {
    Effect(String),
    Nothing,
    Outside(String),
}

/// A table of counts. Effects have numbers, which stand for them above the columns: their names would not fit.
pub(super) fn table(rows: &[&Row]) -> Section {
    let mut counts: BTreeMap<Hidden, BTreeMap<&str, usize>> = BTreeMap::new();
    for (hidden, answer) in rows.iter().filter_map(|r| Some((hidden(r)?, r.naming.answer.as_str()))) {
        *counts.entry(hidden).or_default().entry(answer).or_default() += 1;
    }
    let effects: Vec<&str> =
        counts.keys().filter_map(|h| if let Hidden::Effect(e) = h { Some(e.as_str()) } else { None }).collect();
    let others: BTreeSet<&str> =
        counts.values().flat_map(|c| c.keys().copied()).filter(|a| !effects.contains(a)).collect();
    let numbers: Vec<String> = (1..=effects.len()).map(|n| n.to_string()).collect();
    let header: Vec<&str> =
        std::iter::once("hidden").chain(others.iter().copied()).chain(numbers.iter().map(String::as_str)).collect();
    let note = "Number of cases by what was hidden (rows; cases with several effects are left out) and the answer (columns; the numbers are those of the rows).";
    let mut out = Section::new("Confusion", note, &header);
    for (row, (hidden, answers)) in counts.iter().enumerate() {
        let (name, right) = match hidden {
            Hidden::Effect(e) => (format!("{} {e}", row + 1), e.as_str()),
            Hidden::Nothing => ("nothing".to_owned(), "none"),
            Hidden::Outside(kind) => (format!("outside: {kind}"), "unknown"),
        };
        let cell = |answer: &&str| match answers.get(answer) {
            None => Cell::default(),
            Some(count) => toned(count.to_string(), if *answer == right { Tone::Good } else { Tone::Bad }),
        };
        let columns = others.iter().chain(&effects).map(cell);
        out.rows.push(std::iter::once(name.into()).chain(columns).collect());
    }
    out
}

fn hidden(row: &Row) -> Option<Hidden> {
    let first = || row.hidden.first().cloned();
    match row.kind {
        Kind::Null => Some(Hidden::Nothing),
        Kind::Single => first().map(Hidden::Effect),
        Kind::Outsider => first().map(Hidden::Outside),
        Kind::Pair | Kind::Triple => None,
    }
}
