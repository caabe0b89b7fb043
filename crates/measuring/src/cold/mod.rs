//! `cargo xtask cold`: what a fresh clone costs on two cores, measured in fresh target folders.
//!
//! ```text
//! fetch (not counted) --> first command | the program | the tests: build, run
//!   each: crates built, seconds, seconds on processors, goals
//! ```

use anyhow::Result;
use clap::{Args as ClapArgs, ValueEnum};

use crate::document::{Section, number, to_markdown, to_text};
use crate::output::{self, Asked, Figure};

mod step;

use step::{Fresh, Step};

const EXAMPLES: &str = "\
Examples:
  cargo xtask cold                   the first command, the program and the tests
  cargo xtask cold --only program    one of them
  cargo xtask cold --docs            and write the table into docs/performance.md

Every part builds into a folder of its own below target/cold, which is made
anew and removed afterwards: some 6 GB. Crates are fetched before the clock
starts. Cargo gets two jobs and tests two threads, on any machine.

Exit codes: 0 done (with --judge: all goals are met), 1 with --judge a goal is
missed, or an error, 2 wrong usage.";

/// Where the table stands in the page.
const MARKS: [&str; 2] = ["<!-- cold -->\n", "<!-- end of cold -->\n"];

/// What is asked on two free cores, from a fresh clone with its crates fetched: the first command, s.
const FIRST_COMMAND: f64 = 90.0;
/// Building the program, s.
const PROGRAM: f64 = 180.0;
/// The size of the program, MB (millions of bytes).
const SIZE: f64 = 20.0;
/// All tests with their build, s.
const TESTS: f64 = 720.0;
/// Running them, s.
const RUNNING: f64 = 240.0;

/// Arguments of `cargo xtask cold`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// Only these parts.
    #[arg(long, value_name = "PART,...", value_delimiter = ',', value_enum)]
    only: Vec<Part>,
    /// Fail when a goal is missed. Times are those of a machine that does nothing else.
    #[arg(long)]
    judge: bool,
    /// Write the table into docs/performance.md.
    #[arg(long)]
    docs: bool,
}

/// What is built and run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Part {
    /// `cargo xtask reproduce`.
    Reproduce,
    /// `cargo build --release -p lacuna`.
    Program,
    /// `cargo test --workspace`.
    Tests,
}

/// Runs the command; true if, when judged, all goals are met.
pub(crate) fn run(args: &Args) -> Result<bool> {
    let wanted = |part: Part| args.only.is_empty() || args.only.contains(&part);
    step::fetch()?;

    let (mut steps, mut figures) = (Vec::new(), Vec::new());
    if wanted(Part::Reproduce) {
        let fresh = Fresh::new("reproduce")?;
        let step = fresh.cargo(&["run", "--package", "xtask", "--", "reproduce"])?;
        goal(&mut figures, "first command, `cargo xtask reproduce`", &[&step], FIRST_COMMAND);
        steps.push(step);
    }
    if wanted(Part::Program) {
        let fresh = Fresh::new("program")?;
        let step = fresh.cargo(&["build", "--release", "--locked", "--package", "lacuna"])?;
        goal(&mut figures, "building `lacuna`", &[&step], PROGRAM);
        steps.push(step);
        let size = fresh.size_of("release", "lacuna")? as f64 / 1e6;
        figures.push(Figure::free("size of `lacuna`", size, "MB").asked(Asked::AtMost(SIZE)));
    }
    if wanted(Part::Tests) {
        let fresh = Fresh::new("tests")?;
        let build = fresh.cargo(&["test", "--workspace", "--locked", "--no-run"])?;
        let run = fresh.cargo(&["test", "--workspace", "--locked"])?;
        goal(&mut figures, "all tests, with their build", &[&build, &run], TESTS);
        goal(&mut figures, "all tests, once built", &[&run], RUNNING);
        steps.extend([build, run]);
    }

    write(&steps, &figures, args.docs)?;
    Ok(!args.judge || figures.iter().all(|f| f.pass != Some(false)))
}

/// Adds the seconds of some steps with what is asked of them, and half of their time on processors.
fn goal(figures: &mut Vec<Figure>, name: &str, steps: &[&Step], most: f64) {
    let seconds = steps.iter().map(|step| step.seconds).sum();
    figures.push(Figure::free(name, seconds, "s").asked(Asked::AtMost(most)));
    if let Some(processor) = steps.iter().map(|step| step.processor).sum::<Option<f64>>() {
        // What two cores would take at least that do nothing else: other programs make seconds more, not this.
        figures.push(Figure::free(format!("{name}: time on processors / 2"), processor / 2.0, "s"));
    }
}

/// Prints the tables and writes them.
fn write(steps: &[Step], figures: &[Figure], docs: bool) -> Result<()> {
    let folder = output::folder("cold")?;
    let sections = [table(steps), goals(figures)];
    print!("{}", to_text(&sections));
    output::write(&folder, "summary.json", &serde_json::to_string_pretty(figures)?)?;
    let page = to_markdown("Cold start", "", &sections);
    output::write(&folder, "cold.md", &page)?;
    if docs {
        output::into_docs("performance.md", MARKS, &output::below_title(&page)?)?;
    }
    Ok(())
}

fn table(steps: &[Step]) -> Section {
    let header = ["command", "crates built", "s", "s on processors", "the same / 2"];
    let mut section = Section::new("Steps, two jobs", "", &header);
    for step in steps {
        let numbers = [Some(step.seconds), step.processor, step.processor.map(|s| s / 2.0)];
        let cells = numbers.map(|n| number(n.map(f64::round)).into());
        let names = [format!("`{}`", step.command), step.crates.to_string()].map(Into::into);
        section.rows.push(names.into_iter().chain(cells).collect());
    }
    section
}

fn goals(figures: &[Figure]) -> Section {
    let mut section = Section::new("What is asked of these", "", &["figure", "measured", "asked", "met"]);
    for f in figures {
        let met = f.pass.map_or("", |met| if met { "yes" } else { "NO" });
        let measured = format!("{:.1} {}", f.value, f.unit);
        section
            .rows
            .push([f.name.as_str(), &measured, f.target.as_deref().unwrap_or(""), met].map(Into::into).to_vec());
    }
    section
}

#[cfg(test)]
mod tests {
    use super::{MARKS, Step, goal};
    use crate::output;

    #[test]
    fn a_goal_is_judged_by_the_sum_of_its_steps() {
        let step = |seconds, processor| Step { command: String::new(), crates: 0, seconds, processor };
        let mut figures = Vec::new();
        goal(&mut figures, "a", &[&step(50.0, Some(80.0)), &step(30.0, Some(40.0))], 79.0);
        assert_eq!((figures[0].value, figures[0].pass), (80.0, Some(false)));
        assert_eq!((figures[1].value, figures[1].pass), (60.0, None));
        goal(&mut figures, "b", &[&step(50.0, None)], 79.0);
        assert_eq!((figures.len(), figures[2].pass), (3, Some(true)));
    }

    #[test]
    fn the_page_has_a_place_for_the_table() {
        let page = std::fs::read_to_string(output::docs("performance.md")).expect("the page");
        let at = MARKS.map(|mark| page.find(mark).expect("a mark"));
        assert!(at[0] < at[1]);
    }
}
