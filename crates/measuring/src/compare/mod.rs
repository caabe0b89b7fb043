//! `cargo xtask compare`: our kernels beside C, SciPy, numba, PySINDy and MuJoCo, in one run on one machine.
//!
//! ```text
//! anchors --make--> programs ──┐
//! examples --cargo--> programs ┼─ ours, theirs, ours, theirs ... --> medians, ratios round by round, goals
//! scripts, a Python ───────────┘
//! ```

use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args as ClapArgs;
use serde::{Deserialize, Serialize};

use crate::document::{to_markdown, to_text, wrapped};
use crate::output;

mod anchors;
mod figure;
pub(crate) mod machine;
mod measure;
mod outcome;
mod python;
mod table;
mod tables;

use machine::Machine;
use measure::{Bench, chosen};
use outcome::Outcome;
use table::{Of, ROWS};

const EXAMPLES: &str = "\
Examples:
  cargo xtask compare                                all rows, five rounds
  cargo xtask compare --only weak,fit-c --rounds 3   two rows, three rounds
  cargo xtask compare --docs                         and write the tables
                                                     into docs/performance.md

The programs that ours are compared with lie in a folder of their own, which
is no part of this workspace; without it our own figures are measured alone.

Exit codes: 0 all goals are met (or nothing is there to compare with), 1 a
goal is missed, a program failed or an error, 2 wrong usage.";

/// Where the tables stand in the page.
const MARKS: [&str; 2] = ["<!-- comparison -->\n", "<!-- end of comparison -->\n"];

/// Arguments of `cargo xtask compare`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// Folder of the programs to compare with [default: ../shared/anchors].
    #[arg(long, value_name = "DIR")]
    anchors: Option<PathBuf>,
    /// A Python with numpy, scipy, numba, pysindy and mujoco [default: a
    /// virtual environment that is made below target/compare].
    #[arg(long, value_name = "PYTHON")]
    python: Option<PathBuf>,
    /// How often each program runs.
    #[arg(long, default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..))]
    rounds: u32,
    /// Only these rows.
    #[arg(long, value_name = "NAME,...", value_delimiter = ',')]
    only: Vec<String>,
    /// Where to write [default: target/compare].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Write the tables into docs/performance.md.
    #[arg(long)]
    docs: bool,
}

/// Everything that was measured, as `compare.json` holds it.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
struct Comparison {
    machine: Machine,
    rows: Vec<Outcome>,
}

/// Runs the command; true if every goal is met and no program failed.
pub(crate) fn run(args: &Args) -> Result<bool> {
    let rows = chosen(ROWS, &args.only)?;
    let target = output::folder("compare")?;
    let out = args.out.clone().unwrap_or_else(|| target.clone());
    let logs = out.join("logs");
    std::fs::create_dir_all(&logs).with_context(|| format!("cannot create '{}'", logs.display()))?;
    let anchors = anchors::ready(args.anchors.as_deref(), &target.join("anchors"));
    let scripts = rows.iter().filter_map(|row| row.theirs).any(|p| matches!(p.of, Of::Script(_)));
    let python = match &anchors.sources {
        Err(why) => Err(why.clone()),
        Ok(_) if !scripts => Err("no row needs a Python".to_owned()),
        Ok(_) => python::ready(args.python.as_deref(), &target),
    };
    let mut machine = Machine::read(python.as_deref().ok(), machine::vector_unit());
    let bench = Bench::new(&rows, anchors, python, logs);
    let bar = output::progress(rows.len() as u64, "rows")?;
    let mut outcomes: Vec<Outcome> = Vec::new();
    for row in rows {
        bar.set_message(row.name);
        outcomes.push(bench.measure(row, args.rounds));
        bar.inc(1);
    }
    bar.finish_and_clear();
    machine.note_load();
    let comparison = Comparison { machine, rows: outcomes };
    write(&comparison, &out, args.docs)?;
    Ok(comparison.rows.iter().all(|o| o.met != Some(false) && o.failure().is_none()))
}

/// Prints the tables and writes them as text, Markdown and JSON.
fn write(comparison: &Comparison, out: &std::path::Path, docs: bool) -> Result<()> {
    let sections = tables::all(&comparison.rows);
    let intro = tables::intro(&comparison.rows, &comparison.machine.words());
    let text = format!("{}\n{}", wrapped(&intro), to_text(&sections));
    print!("{text}");
    let page = to_markdown("Comparison", &intro, &sections);
    output::write(out, "compare.txt", &text)?;
    output::write(out, "compare.md", &page)?;
    output::write(out, "compare.json", &serde_json::to_string_pretty(comparison)?)?;
    output::write(out, "summary.json", &serde_json::to_string_pretty(&tables::figures(&comparison.rows))?)?;
    if docs {
        output::into_docs("performance.md", MARKS, &output::below_title(&page)?)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::outcome::Side;
    use super::outcome::tests::{outcome, ran};
    use super::table::Goal;
    use super::*;

    #[test]
    fn what_is_written_reads_back() {
        let rows = vec![
            outcome(ran(&[1.25, 0.1], "ns/step"), ran(&[2.0, 1.0 / 3.0], "us")).judged(Goal::AtMost(1.0)),
            outcome(Side::Failed("exit code 1".into()), Side::Absent).judged(Goal::Ours(2.5)),
            outcome(ran(&[7.0], "ms"), Side::Skipped("no Python".into())),
        ];
        let comparison = Comparison { machine: Machine::read(None, None), rows };
        let folder = tempfile::tempdir().expect("a folder");
        write(&comparison, folder.path(), false).expect("writes");
        let text = std::fs::read_to_string(folder.path().join("compare.json")).expect("a file");
        assert_eq!(serde_json::from_str::<Comparison>(&text).expect("reads back"), comparison);
    }

    #[test]
    fn the_page_has_a_place_for_the_tables() {
        let page = std::fs::read_to_string(output::docs("performance.md")).expect("the page");
        let at = MARKS.map(|mark| page.find(mark).expect("a mark"));
        assert!(at[0] < at[1]);
    }
}
