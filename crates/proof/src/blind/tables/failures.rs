//! The cases that are answered wrongly.

use super::super::score::{Kind, Row};
use crate::document::Section;

/// Whether the answer is wrong; of several effects all are asked for.
pub(in crate::blind) fn fails(row: &Row) -> bool {
    !row.naming.right || matches!(row.kind, Kind::Pair | Kind::Triple) && !row.naming.all_in_three
}

/// What was hidden, in a word.
pub(in crate::blind) fn hidden(row: &Row) -> String {
    match row.kind {
        Kind::Null => "nothing".to_owned(),
        Kind::Outsider => format!("outside: {}", row.hidden.join(" + ")),
        Kind::Single | Kind::Pair | Kind::Triple => row.hidden.join(" + "),
    }
}

/// What was answered; with a verdict that names effects, those that come first.
pub(in crate::blind) fn answered(row: &Row) -> String {
    if row.verdict == Some("explained") { row.naming.first.join(", ") } else { row.naming.answer.clone() }
}

pub(super) fn table(rows: &[&Row]) -> Section {
    let header =
        ["case", "hidden", "severity", "setting", "law", "answered", "effects by rank", "probability of the first"];
    let mut out = Section::new("Wrong answers", "Of two or three effects all must be among the first three.", &header);
    for r in rows.iter().filter(|r| fails(r)) {
        let noise = if r.below_noise { ", below the noise" } else { "" };
        out.rows.push(vec![
            r.case.as_str().into(),
            hidden(r).into(),
            r.severity.map_or(String::new(), |s| s.to_string()).into(),
            format!("{}{noise}", r.setting).into(),
            r.law.as_str().into(),
            r.naming.answer.as_str().into(),
            r.naming.first.join(", ").into(),
            format!("{:.2}", r.belief.confidence).into(),
        ]);
    }
    out
}
