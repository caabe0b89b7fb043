//! What the page and the Markdown show.

use pages::page::Tone;

use super::score::{Row, bins};
use super::totals::BINS;
use crate::document::{Section, number, toned};
use crate::output::Figure;

mod breakdown;
mod confusion;
mod failures;
mod strata;

pub(super) use failures::{answered, fails, hidden};

/// Bins of the finer reliability table, which is also drawn.
pub(super) const FINE: usize = 10;

/// All tables.
pub(super) fn all(rows: &[Row], figures: &[Figure]) -> Vec<Section> {
    let every: Vec<&Row> = rows.iter().collect();
    let mut out = vec![listed(figures)];
    out.extend(breakdown::all(&every));
    out.extend(strata::table(&every));
    out.push(confusion::table(&every));
    out.extend([BINS, FINE].map(|count| reliability(&every, count)));
    out.push(failures::table(&every));
    out
}

fn listed(figures: &[Figure]) -> Section {
    let mut out = Section::new("Figures", "Shares lie between 0 and 1.", &["figure", "found", "unit", "asked", "met"]);
    for f in figures {
        let met = match f.pass {
            None => toned("", Tone::Plain),
            Some(true) => toned("yes", Tone::Good),
            Some(false) => toned("no", Tone::Bad),
        };
        let asked = f.target.clone().unwrap_or_default();
        let found = number(Some(f.value));
        out.rows.push(vec![f.name.as_str().into(), found.into(), f.unit.as_str().into(), asked.into(), met]);
    }
    out
}

fn reliability(rows: &[&Row], count: usize) -> Section {
    let mut out = Section::new(
        &format!("Reliability, {count} bins"),
        "How often the first answer is right over how probable it was said to be.",
        &["probability", "answers", "mean probability", "right", "right, 95 %"],
    );
    for b in bins(rows, count).iter().filter(|b| b.count > 0) {
        out.rows.push(vec![
            format!("{:.1} to {:.1}", b.above, b.until).into(),
            b.count.to_string().into(),
            format!("{:.3}", b.confidence).into(),
            format!("{:.3}", b.right).into(),
            format!("{:.2} to {:.2}", b.interval[0], b.interval[1]).into(),
        ]);
    }
    out
}
