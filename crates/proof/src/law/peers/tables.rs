//! What came out of the comparison, as a table and figures.

use inference::robust::median;

use super::{Compared, HIDDEN, OWN, Scored};
use crate::blind::Rate;
use crate::document::Section;
use crate::output::Figure;

/// What one method made of all cases.
struct Row<'a> {
    method: &'a str,
    /// With the case that each is of.
    scores: Vec<(&'a Compared, &'a Scored)>,
}

impl Row<'_> {
    fn middle(&self, of: impl Fn(&Compared, &Scored) -> Option<f64>) -> Option<f64> {
        median(self.scores.iter().filter_map(|(case, s)| of(case, s)))
    }

    fn explained(&self) -> Option<f64> {
        self.middle(|_, s| Some(s.explained))
    }

    /// Where a law is told.
    fn explained_with_law(&self) -> Option<f64> {
        self.middle(|case, s| case.has_law.then_some(s.explained))
    }

    fn of_hidden(&self) -> Option<f64> {
        self.middle(|_, s| s.of_hidden)
    }

    fn of_hidden_with_law(&self) -> Option<f64> {
        self.middle(|case, s| s.of_hidden.filter(|_| case.has_law))
    }

    /// Errs more than if nothing acted.
    fn worse_than_nothing(&self) -> Rate {
        self.scores.iter().map(|(_, s)| s.explained < 0.0).collect()
    }

    fn wrong_units(&self) -> Rate {
        self.scores.iter().filter_map(|(_, s)| s.has_wrong_units).collect()
    }
}

/// Methods in the order of the first case that has all.
fn rows<'a>(all: &[&'a Compared]) -> Vec<Row<'a>> {
    let Some(longest) = all.iter().max_by_key(|c| c.scores.len()) else { return Vec::new() };
    let of = |method: &'a str| {
        all.iter().flat_map(|c| c.scores.iter().map(|s| (*c, s))).filter(move |(_, s)| s.method == method)
    };
    longest.scores.iter().map(|s| Row { method: &s.method, scores: of(&s.method).collect() }).collect()
}

/// Flat list for machines; nothing where nothing was compared.
pub(in super::super) fn figures(all: &[&Compared]) -> Vec<Figure> {
    let mut out = Vec::new();
    for row in rows(all) {
        let values = [
            ("share of the left-out series explained, median", row.explained()),
            ("the same where a law is told, median", row.explained_with_law()),
            ("share of the hidden law explained, median", row.of_hidden()),
            ("the same of the hidden law where a law is told, median", row.of_hidden_with_law()),
            ("worse than nothing", row.worse_than_nothing().share()),
            ("formulas with wrong units", row.wrong_units().share()),
        ];
        let named =
            values.into_iter().filter_map(|(name, value)| Some((format!("peers, {}: {name}", row.method), value?)));
        out.extend(named.map(|(name, value)| Figure::free(name, value, "")));
    }
    out
}

/// Tables of the methods and of the cases; none where nothing was compared. `own_seconds`: processor time of Lacuna for a robot, s.
pub(in super::super) fn tables(all: &[&Compared], own_seconds: Option<f64>) -> Vec<Section> {
    if all.is_empty() { Vec::new() } else { vec![by_method(all, own_seconds), by_case(all)] }
}

fn share(value: Option<f64>) -> String {
    value.map_or_else(|| "-".to_owned(), |x| format!("{x:.2}"))
}

fn by_case(all: &[&Compared]) -> Section {
    let methods: Vec<&str> = rows(all).iter().map(|row| row.method).collect();
    let header = [&["hidden", "place of the series", "law told"], methods.as_slice()].concat();
    let mut s = Section::new("Peers, case by case", "Share of the left-out series explained.", &header);
    for case in all {
        let mut row: Vec<_> = vec![case.hidden.as_str().into(), case.place.as_str().into()];
        row.push((if case.has_law { "yes" } else { "no" }).into());
        row.extend(methods.iter().map(|method| {
            let own = case.scores.iter().find(|s| s.method == *method);
            share(own.map(|s| s.explained)).into()
        }));
        s.rows.push(row);
    }
    s
}

fn by_method(all: &[&Compared], own_seconds: Option<f64>) -> Section {
    let with_law = all.iter().filter(|c| c.has_law).count();
    let known = all.iter().filter(|c| c.scores.iter().any(|s| s.method == HIDDEN)).count();
    let versions = all.first().map_or_else(String::new, |c| {
        c.versions.iter().map(|(name, version)| format!("{name} {version}")).collect::<Vec<_>>().join(", ")
    });
    let note = format!(
        "{} robots; in {with_law} a law is told, in {known} the examiner knows the hidden curve. Shares of the mean square of a \
         recording left out for all, medians. {versions}.",
        all.len()
    );
    let header = [
        "method",
        "cases",
        "formulas",
        "explained: all",
        "where a law is told",
        "of the hidden curve: all",
        "where a law is told",
        "worse than nothing",
        "parts",
        "wrong units",
        "processor, s",
    ];
    let mut s = Section::new("Peers on the same residual series", &note, &header);
    for row in rows(all) {
        let formulas = row.scores.iter().filter(|(_, s)| s.formula.is_some()).count();
        let parts = row.middle(|_, s| s.parts.map(|n| n as f64));
        let seconds = row.middle(|_, s| s.seconds).or(own_seconds.filter(|_| row.method == OWN));
        let units = row.wrong_units();
        s.rows.push(vec![
            row.method.into(),
            row.scores.len().to_string().into(),
            (if formulas == 0 { "none".to_owned() } else { formulas.to_string() }).into(),
            share(row.explained()).into(),
            share(row.explained_with_law()).into(),
            share(row.of_hidden()).into(),
            share(row.of_hidden_with_law()).into(),
            row.worse_than_nothing().hits.to_string().into(),
            parts.map_or_else(|| "-".to_owned(), |n| format!("{n:.0}")).into(),
            (if units.count == 0 { "no formula".to_owned() } else { units.counted() }).into(),
            seconds.map_or_else(|| "-".to_owned(), |x| format!("{x:.1}")).into(),
        ]);
    }
    s
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scored(method: &str, explained: f64, wrong: Option<bool>) -> Scored {
        Scored {
            method: method.to_owned(),
            formula: wrong.map(|_| "x".to_owned()),
            parts: wrong.map(|_| 3),
            has_wrong_units: wrong,
            explained,
            of_hidden: None,
            seconds: None,
        }
    }

    #[test]
    fn a_row_counts_all_cases_and_those_with_a_law_apart() {
        let case = |has_law: bool, explained: f64, wrong: bool| Compared {
            hidden: "a drag".to_owned(),
            place: String::new(),
            has_law,
            scores: vec![scored(OWN, 0.0, None), scored("peer", explained, Some(wrong))],
            versions: std::collections::BTreeMap::new(),
        };
        let cases = [case(true, 0.9, true), case(false, -0.1, false), case(false, 0.3, true)];
        let all: Vec<&Compared> = cases.iter().collect();
        let tables = tables(&all, Some(4.0));
        let row = |t: usize, r: usize| tables[t].rows[r].iter().map(|c| c.text.as_str()).collect::<Vec<_>>();
        assert_eq!(row(0, 1), ["peer", "3", "3", "0.30", "0.90", "-", "-", "1", "3", "2 of 3", "-"]);
        assert_eq!(row(0, 0), [OWN, "3", "none", "0.00", "0.00", "-", "-", "0", "-", "no formula", "4.0"]);
        assert_eq!(row(1, 1), ["a drag", "", "no", "0.00", "-0.10"]);
        assert!(figures(&all).iter().any(|f| f.name.contains("peer: formulas with wrong units") && f.value > 0.6));
        assert!(figures(&[]).is_empty() && super::tables(&[], None).is_empty());
    }
}
