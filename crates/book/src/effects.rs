//! The catalogue of effects and causes as a page.

use std::fmt::Write as _;

use catalogue::{CauseSpec, answer, car, command_driven, odometry, speed_driven, wheeled};
use robot_model::{EffectSpec, Kind};

/// Kinds in the order of the page: kind, heading, what they have in common.
const KINDS: [(Kind, &str, &str); 3] = [
    (Kind::Physics, "Physics", "Forces on the robot, or properties of its body, its drive train and the ground."),
    (Kind::Command, "Commands", "Between the logged command and the torque that is delivered."),
    (Kind::Sensor, "Sensors", "What a sensor shows while the robot drives as before."),
];

/// `docs/effects.md`.
pub(super) fn page() -> String {
    let effects: Vec<&EffectSpec> = catalogue::effects().collect();
    let mut out = format!(
        "# Effects\n\n\
         Written by `cargo xtask book --docs` from the catalogue; do not edit. These {} effects, the causes of\n\
         [command-driven](#command-driven-robots) and [speed-driven](#speed-driven-robots) robots and\n\
         [two answers](#answers-that-name-no-cause) are what a diagnosis can name; `lacuna explain NAME` tells the same at\n\
         the command line. To add an effect:\n\
         [writing an effect](writing-an-effect.md).\n\n\
         Bounds are those within which a fit looks. \"Matters from\" is the size below which nobody would act.\n\n\
         | effect | name | kind |\n|---|---|---|\n",
        effects.len()
    );
    for (kind, ..) in KINDS {
        for spec in effects.iter().filter(|spec| spec.kind == kind) {
            put(&mut out, format_args!("| [`{0}`](#{0}) | {1} | {2} |\n", spec.id, spec.name, kind.name()));
        }
    }
    for (kind, heading, common) in KINDS {
        put(&mut out, format_args!("\n## {heading}\n\n{common}\n"));
        for spec in effects.iter().filter(|spec| spec.kind == kind) {
            section(&mut out, spec, &effects);
        }
    }

    out += "\n## Command-driven robots\n\nNeither torques nor currents are known: elements of the way from command to wheel to ground.\n";
    for cause in command_driven::ALL {
        without_law(&mut out, cause, &effects);
    }
    out += "\n## Speed-driven robots\n\nThe loads of steady driving name effects; what the body does beside its wheels names these.\n";
    for cause in speed_driven::ALL {
        without_law(&mut out, cause, &effects);
    }
    out +=
        "\n## Odometry\n\nWheel motion goes in, a measured pose comes out: what lies between a count and the pose.\n";
    for cause in odometry::ALL {
        without_law(&mut out, cause, &effects);
    }
    out += "\n## Robots of any wheels\n\nTorques of motors go in, motion of body and wheels comes out: constants of the plant that moved. Beside these, \
            those of wheel counts are named that lengths, steering, pose and gyro have.\n";
    for cause in wheeled::ALL {
        without_law(&mut out, cause, &effects);
    }
    out += "\n## Cars\n\nThrottle and steering go in, motion and what the car reports of it come out.\n";
    for cause in car::ALL {
        without_law(&mut out, cause, &effects);
    }
    out += "\n## Answers that name no cause\n";
    for cause in answer::ALL {
        without_law(&mut out, cause, &effects);
    }
    out
}

/// A cause that has no law in a plant. One whose name an effect has too gets no heading of its own: links lead there.
fn without_law(out: &mut String, cause: &CauseSpec, effects: &[&EffectSpec]) {
    if effects.iter().any(|effect| effect.id == cause.id) {
        put(out, format_args!("\n**{0}**, of these robots, is [`{0}`](#{0}) seen from the command.\n", cause.id));
    } else {
        put(out, format_args!("\n### {}\n", cause.id));
    }
    put(out, format_args!("\n{}{}. {}\n\n", cause.name[..1].to_uppercase(), &cause.name[1..], cause.meaning));

    let unit = if cause.unit == "-" { String::new() } else { format!(", {}", cause.unit) };
    let lines = [
        ("Size", if cause.size.is_empty() { String::new() } else { format!("{}{unit}", cause.size) }),
        ("Recognised", cause.recognised.to_owned()),
        ("Revealed by", cause.revealed_by.to_owned()),
        ("Resembles", linked(cause.resembles, effects)),
    ];
    bullets(out, &lines);
}

/// What is known, one line each; what is empty is left out.
fn bullets(out: &mut String, lines: &[(&str, String)]) {
    for (what, text) in lines.iter().filter(|(_, text)| !text.is_empty()) {
        put(out, format_args!("- {what}: {}\n", text.trim_end_matches('.')));
    }
}

fn section(out: &mut String, spec: &EffectSpec, effects: &[&EffectSpec]) {
    put(
        out,
        format_args!("\n### {}\n\n{}{}: `{}`\n\n", spec.id, spec.name[..1].to_uppercase(), &spec.name[1..], spec.law),
    );
    *out += "| number | unit | from | to | neutral | it is |\n|---|---|---:|---:|---:|---|\n";
    for p in spec.parameters {
        let [low, high] = p.bounds;
        put(
            out,
            format_args!("| {} | {} | {low} | {high} | {} | {} |\n", p.name, p.counted_in(), p.neutral, p.role.name()),
        );
    }
    let strength = spec.strengths().next().map_or("-", |index| spec.parameters[index].unit);
    let unit = if strength == "-" { String::new() } else { format!(" {strength}") };
    let interest = if spec.interest > 0.0 {
        format!("{}{unit}{}", spec.interest, spec.sized_by.words())
    } else {
        "any size".to_owned()
    };
    let sign = if spec.signed { ", of either sign" } else { "" };
    let forms: Vec<&str> = spec.scopes.forms().collect();
    let lines = [
        ("One sees", spec.seen.to_owned()),
        ("Looked for", forms.join("; ") + sign),
        ("On", spec.on().to_owned()),
        ("Axes", spec.axes.join(", ")),
        ("Matters from", interest),
        ("Revealed by", spec.revealed_by.to_owned()),
        ("Resembles", linked(spec.resembles, effects)),
        ("Shows in", spec.redundancy.shows_in().unwrap_or_default().to_owned()),
        ("Source", spec.source.to_owned()),
    ];
    *out += "\n";
    bullets(out, &lines);
}

/// Ids of other effects become links to them.
fn linked(text: &str, effects: &[&EffectSpec]) -> String {
    let is_id = |word: &str| effects.iter().any(|spec| spec.id == word);
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
    fn the_page_in_the_repository_is_that_of_the_catalogue() {
        let there = std::fs::read_to_string(crate::output::docs("effects.md")).unwrap_or_default();
        assert!(there == page(), "docs/effects.md is stale: run `cargo xtask book --docs`");
    }

    #[test]
    fn other_effects_are_linked() {
        let effects: Vec<&EffectSpec> = catalogue::effects().collect();
        assert_eq!(linked("grade, seen once; upgrade", &effects), "[`grade`](#grade), seen once; upgrade");
    }
}
