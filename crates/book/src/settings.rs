//! The tuned numbers of all rooms as a page.

use std::fmt::Write as _;

use ::settings::Setting;

/// A crate, what it does, and its numbers in the order of the source.
type Room = (&'static str, &'static str, Vec<&'static Setting>);

/// Crates in the order of the page.
fn rooms() -> Vec<Room> {
    vec![
        ("inference", "what all kinds of robots share", inference::settings().collect()),
        ("law", "laws for what has no name", law::settings().collect()),
        ("torque-driven", "robots whose torques are known", torque_driven::settings().collect()),
        ("speed-driven", "robots whose wheel speeds and currents are known", speed_driven::settings().collect()),
        ("command-driven", "robots of which only commands and motion are known", command_driven::settings().collect()),
        (
            "hierarchical-fit",
            "fits with a deviation of every drive, and the causes that they name",
            hierarchical_fit::settings().collect(),
        ),
        ("odometry", "wheel motion against a measured pose", odometry::settings().collect()),
        ("wheeled", "robots of any wheels: torques of motors against motion", wheeled::settings().collect()),
        ("single-track", "cars: throttle and steering against motion", single_track::settings().collect()),
        ("model-import", "robot files from models of simulators", model_import::settings().collect()),
        ("weak-form", "screening without simulation", weak_form::settings().collect()),
        ("rehearsal", "what a diagnosis would find on given inputs", rehearsal::settings().collect()),
        ("diagnosis", "which minutes of a long recording are diagnosed", diagnosis::settings().collect()),
    ]
}

/// `docs/settings.md`.
pub(super) fn page() -> String {
    printed(&rooms())
}

/// A section for each room, a subsection with a table for each group.
fn printed(rooms: &[Room]) -> String {
    let mut out = String::from(
        "# Settings\n\n\
         A setting is a number that was chosen, not derived: a threshold, a prior, a length of window. It stands in\n\
         `settings.rs` of its crate with its unit (1 of a share, a factor or a count), its meaning and its source: data, a\n\
         paper, a formula. \"guess\" is a source too. This page is printed by `cargo xtask book --docs` from these files; do not\n\
         edit it. Defaults of the solver that all fits share stand in `inference::least_squares::Settings`.\n",
    );
    for (name, title, settings) in rooms {
        put(&mut out, format_args!("\n## {name}: {title}\n"));
        for group in settings.chunk_by(|a, b| a.group == b.group) {
            put(&mut out, format_args!("\n### {}\n\n{}\n\n", group[0].group, on_one_line(group[0].about)));
            out += "| name | default | unit | meaning | source |\n|---|---:|---|---|---|\n";
            for setting in group {
                put(&mut out, format_args!("{}\n", row(setting)));
            }
        }
    }
    out
}

fn row(s: &Setting) -> String {
    let [default, unit, meaning, source] = [s.default, s.unit, s.meaning, s.source].map(cell);
    format!("| `{}` | {default} | {unit} | {} | {source} |", s.name, meaning.trim_end_matches('.'))
}

/// A text in a table: what would end its cell is escaped.
fn cell(text: &str) -> String {
    on_one_line(text).replace('|', "\\|")
}

fn on_one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Writing to a string cannot fail.
fn put(out: &mut String, text: std::fmt::Arguments<'_>) {
    let _ = out.write_fmt(text);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_in_the_repository_is_that_of_the_crates() {
        let there = std::fs::read_to_string(crate::output::docs("settings.md")).unwrap_or_default();
        assert!(there == page(), "docs/settings.md is stale: run `cargo xtask book --docs`");
    }

    #[test]
    fn groups_become_tables_and_what_would_end_a_cell_is_escaped() {
        let distance = Setting {
            group: "stopping",
            about: " Stopping at\n a wall.",
            name: "distance",
            default: "[0.3,\n    1.2]",
            unit: "m",
            meaning: " Where |v| is zero.",
            source: "guess",
        };
        let rooms = [distance, Setting { group: "start", ..distance }].map(|s| &*Box::leak(Box::new(s)));
        let page = printed(&[("brakes", "how they work", rooms.to_vec())]);
        let below = page.split_once("## brakes: how they work\n").expect("a section").1;
        let table = "| name | default | unit | meaning | source |\n|---|---:|---|---|---|\n\
                     | `distance` | [0.3, 1.2] | m | Where \\|v\\| is zero | guess |\n";
        assert_eq!(
            below,
            format!("\n### stopping\n\nStopping at a wall.\n\n{table}\n### start\n\nStopping at a wall.\n\n{table}")
        );
    }
}
