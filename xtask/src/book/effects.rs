//! The catalogue of effects as a page, from the cards.

use std::fmt::Write as _;

use robot_model::effects::catalogue;
use robot_model::{Card, Kind};

/// Kinds in the order of the page: kind, heading, what they have in common.
const KINDS: [(Kind, &str, &str); 3] = [
    (Kind::Physics, "Physics", "Forces on the robot, or properties of its body, its drive train and the ground."),
    (Kind::Command, "Commands", "Between the logged command and the torque that is delivered."),
    (Kind::Sensor, "Sensors", "What a sensor shows while the robot drives as before."),
];

/// `docs/effects.md`.
pub(super) fn page() -> String {
    let cards: Vec<&Card> = catalogue::<f64>().iter().map(|effect| effect.card()).collect();
    let mut out = format!(
        "# Effects\n\n\
         Written by `cargo xtask book --docs` from the cards of the catalogue; do not edit. These {} effects are what a\n\
         diagnosis can name; `lacuna explain EFFECT` tells the same at the command line. To add one:\n\
         [writing an effect](writing-an-effect.md).\n\n\
         Bounds are those within which a fit looks. \"Matters from\" is the size below which nobody would act.\n\n\
         | effect | name | kind |\n|---|---|---|\n",
        cards.len()
    );
    for (kind, ..) in KINDS {
        for card in cards.iter().filter(|card| card.kind == kind) {
            put(&mut out, format_args!("| [`{0}`](#{0}) | {1} | {2} |\n", card.id, card.name, kind.name()));
        }
    }
    for (kind, heading, common) in KINDS {
        put(&mut out, format_args!("\n## {heading}\n\n{common}\n"));
        for card in cards.iter().filter(|card| card.kind == kind) {
            section(&mut out, card, &cards);
        }
    }
    out
}

fn section(out: &mut String, card: &Card, cards: &[&Card]) {
    put(
        out,
        format_args!("\n### {}\n\n{}{}: `{}`\n\n", card.id, card.name[..1].to_uppercase(), &card.name[1..], card.law),
    );
    *out += "| number | unit | from | to | neutral | it is |\n|---|---|---:|---:|---:|---|\n";
    for p in card.parameters {
        let [low, high] = p.bounds;
        put(
            out,
            format_args!("| {} | {} | {low} | {high} | {} | {} |\n", p.name, p.counted_in(), p.neutral, p.role.name()),
        );
    }
    let strength = card.strengths().next().map_or("-", |index| card.parameters[index].unit);
    let unit = if strength == "-" { String::new() } else { format!(" {strength}") };
    let interest = if card.interest > 0.0 { format!("{}{unit}", card.interest) } else { "any size".to_owned() };
    let sign = if card.signed { ", of either sign" } else { "" };
    let forms: Vec<&str> = card.wears.forms().collect();
    let lines = [
        ("One sees", card.seen.to_owned()),
        ("Looked for", forms.join("; ") + sign),
        ("Axes", card.axes.join(", ")),
        ("Matters from", interest),
        ("Revealed by", card.revealed_by.to_owned()),
        ("Resembles", linked(card.resembles, cards)),
        ("Shows in", card.redundancy.shows_in().unwrap_or_default().to_owned()),
        ("Source", card.source.to_owned()),
    ];
    *out += "\n";
    for (what, text) in lines.iter().filter(|(_, text)| !text.is_empty()) {
        put(out, format_args!("- {what}: {}\n", text.trim_end_matches('.')));
    }
}

/// Ids of other effects become links to them.
fn linked(text: &str, cards: &[&Card]) -> String {
    let is_id = |word: &str| cards.iter().any(|card| card.id == word);
    let words = text.split_inclusive(|c: char| !(c.is_alphanumeric() || c == '_'));
    let link = |part: &str| {
        let word = part.trim_end_matches(|c: char| !(c.is_alphanumeric() || c == '_'));
        if is_id(word) { format!("[`{word}`](#{word}){}", &part[word.len()..]) } else { part.to_owned() }
    };
    words.map(link).collect()
}

/// Writing to a string cannot fail.
fn put(out: &mut String, text: std::fmt::Arguments<'_>) {
    let _ = out.write_fmt(text);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_in_the_repository_is_that_of_the_cards() {
        let there = std::fs::read_to_string(crate::output::docs("effects.md")).unwrap_or_default();
        assert!(there == page(), "docs/effects.md is stale: run `cargo xtask book --docs`");
    }

    #[test]
    fn other_effects_are_linked() {
        let cards: Vec<&Card> = catalogue::<f64>().iter().map(|effect| effect.card()).collect();
        assert_eq!(linked("grade, seen once; upgrade", &cards), "[`grade`](#grade), seen once; upgrade");
    }
}
