//! What is left unexplained, and what limits the answer.

use verdict::Diagnosis;

use crate::page::{Cell, Page};
use crate::words::number;

/// Adds both sections.
pub(super) fn add(page: &mut Page, d: &Diagnosis, lost: &[String]) {
    unexplained(page, d);
    law(page, d);
    page.section("Limits", "What limits this answer");
    if d.limits.is_empty() && lost.is_empty() {
        page.paragraph("Nothing was lost in reading, and the diagnosis names no limit.");
    }
    if !d.limits.is_empty() {
        page.list(&d.limits);
    }
    if !lost.is_empty() {
        page.subheading("Lost in reading");
        page.list(lost);
    }
    let withheld: Vec<String> = (d.steady.iter().flat_map(|l| &l.withheld))
        .map(|w| format!("{}: {}: {}", w.recording, w.quantity.name(), w.reason))
        .collect();
    if !withheld.is_empty() {
        page.folded(
            "Answers that the recordings do not permit",
            &format!("{} of them", withheld.len()),
            false,
            |page| page.list(&withheld),
        );
    }
}

/// A law for what has no name.
fn law(page: &mut Page, d: &Diagnosis) {
    let Some(cause) = &d.law else { return };
    page.section("Law", "What has no name in the catalogue");
    let row = |(label, text): (&str, String)| -> Vec<Cell> { vec![label.into(), text.as_str().into()] };
    page.table(&["", "what was found"], &crate::law::lines(cause).into_iter().map(row).collect::<Vec<_>>());
}

fn unexplained(page: &mut Page, d: &Diagnosis) {
    let remainder = d.located.remainder.as_ref();
    let Some(share) = d.unexplained.or(remainder.map(|r| r.share)) else { return };
    page.section("Left over", "What is left unexplained");
    let mut sentences = vec![format!("{:.0} % of the mismatch is still unexplained.", 100.0 * share)];
    if let Some(r) = remainder {
        sentences.push(match &r.place {
            Some(place) => format!("Most of what is left shows {place}."),
            None => "In no signal does it clearly exceed what fault-free drives show.".to_owned(),
        });
        if let Some(g) = &r.regime {
            let [a, b] = g.range;
            let range = if b.is_finite() { format!("{a} to {b}") } else { format!("above {a}") };
            sentences.push(format!(
                "{:.0} % of it shows where {} is {range} {}, in {:.0} % of the time driven.",
                100.0 * g.share,
                g.by,
                g.unit,
                100.0 * g.time
            ));
        }
    }
    page.paragraph(&sentences.join(" "));
    if let Some(r) = remainder.filter(|r| !r.by_signal.is_empty()) {
        let row = |(signal, share): &(String, f64)| -> Vec<Cell> {
            vec![signal.as_str().into(), format!("{:.0} %", 100.0 * share).into()]
        };
        page.table(&["signal", "share of what is left"], &r.by_signal.iter().map(row).collect::<Vec<_>>());
    }
    if let Some(m) = &d.located.residual_model {
        let [without, with] = m.wheel_speed;
        page.note(&format!(
            "A network fitted to what is left ({}) lowers the wheel-speed error on left-out \
             recordings from {} to {} rad/s.",
            m.standing,
            number(without),
            number(with)
        ));
    }
}
