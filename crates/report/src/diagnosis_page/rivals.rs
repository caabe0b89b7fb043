//! How probable each answer is, and what cannot be told apart.

use std::fmt::Write;

use catalogue::for_people;
use inference::words::listed;
use verdict::{Cause, Diagnosis};

use crate::page::Page;
use crate::words::{is_no_cause, probability, size_in_words as size, where_and_when};
use pages::escape::escape;

/// Causes that are shown at once; "nothing" and "not in the catalogue" are always.
const SHOWN: usize = 6;

/// Adds the section.
pub(super) fn add(page: &mut Page, d: &Diagnosis) {
    if d.ranked.is_empty() {
        return;
    }
    page.section("Rivals", "How probable each answer is");
    page.note(
        "Probability that a cause is part of what is missing; of two causes both may be near 1. \"Nothing\" and \
         \"not in the catalogue\" are answers too.",
    );
    let causes = d.ranked.iter().filter(|c| !is_no_cause(c));
    let rest: Vec<&Cause> = causes.skip(SHOWN).collect();
    let shown: Vec<&Cause> = d.ranked.iter().filter(|c| !rest.iter().any(|r| std::ptr::eq(*r, *c))).collect();
    page.markup(&bars(&shown));
    if let Some(sentence) = apart(d) {
        page.aside(&sentence);
    }
    if !rest.is_empty() {
        page.folded("Less probable", &format!("{} further causes", rest.len()), false, |page| {
            page.markup(&bars(&rest));
        });
    }
}

/// What cannot be told apart, in a sentence.
fn apart(d: &Diagnosis) -> Option<String> {
    let names = |class: &Vec<String>| {
        let name = |id: &String| {
            d.ranked.iter().find(|c| c.effect == *id).map_or_else(|| for_people(id), |c| for_people(&c.name))
        };
        listed(&class.iter().map(name).collect::<Vec<_>>())
    };
    let classes: Vec<String> = d.indistinguishable.iter().filter(|c| c.len() > 1).map(names).collect();
    (!classes.is_empty()).then(|| format!("These recordings cannot tell apart: {}.", classes.join("; nor: ")))
}

fn bars(causes: &[&Cause]) -> String {
    let mut out = "<ul class=\"rivals\">\n".to_owned();
    for c in causes {
        let class = if is_no_cause(c) { " class=\"other\"" } else { "" };
        let [value, interval] = size(c);
        let magnitude = if interval.is_empty() { value } else { format!("{value}, {interval}") };
        let more: Vec<String> = [magnitude, where_and_when(c)].into_iter().filter(|s| !s.is_empty()).collect();
        let more = if more.is_empty() {
            String::new()
        } else {
            format!("<span class=\"more\">{}</span>", escape(&more.join("; ")))
        };
        let percent = 100.0 * c.probability.clamp(0.0, 1.0);
        // Writing to a string cannot fail.
        let _ = writeln!(
            out,
            "<li{class}><b>{}</b><span class=\"p\">{}</span><span class=\"bar\"><i style=\"width:{percent:.2}%\"></i></span>{more}</li>",
            escape(&for_people(&c.name)),
            probability(c.probability)
        );
    }
    out + "</ul>\n"
}
