//! `cargo xtask growth`: what `lacuna` costs as recordings become longer and more, and with how many cores.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, ensure};
use clap::Args as ClapArgs;

use crate::child::{self, Ended};
use crate::document::{Section, number, to_markdown, to_text};
use crate::output::{Asked, Figure};
use crate::{binary, output};

mod data;

use data::Fleet;

const EXAMPLES: &str = "\
Examples:
  cargo xtask growth             up to 10 h at 1 kHz, 10 000 recordings screened
                                 and 1000 diagnosed: some 15 minutes and 6 GB
  cargo xtask growth --quick     a tenth of everything
  cargo xtask growth --docs      and write the tables into docs/performance.md

The program that is measured is `lacuna` beside this one. After a change to it:
  cargo build --release -p lacuna --bin lacuna

Exit codes: 0 all goals are met, 1 a goal is missed or an error, 2 wrong usage.";

/// Where the tables stand in the page.
const MARKS: [&str; 2] = ["<!-- growth -->\n", "<!-- end of growth -->\n"];
/// Bytes of the memory that nothing may exceed.
const MOST_MEMORY: f64 = 128.0;
/// Recordings on which one core is compared with two.
const ON_CORES: usize = 40;

/// Arguments of `cargo xtask growth`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// A tenth of everything.
    #[arg(long)]
    quick: bool,
    /// Write the tables into docs/performance.md.
    #[arg(long)]
    docs: bool,
}

/// One run of the program.
struct Run {
    what: String,
    ended: Ended,
}

/// Runs the command; true if the goals are met.
pub(crate) fn run(args: &Args) -> Result<bool> {
    let folder = output::folder("growth")?;
    let lacuna = binary::find()?.path;
    let share = if args.quick { 10 } else { 1 };
    let fleet = Fleet::new(&folder)?;
    let mut figures = Vec::new();

    let one = fleet.case_of(4)?;
    let single = |threads: &str, command: &mut Command| ended(command.env("RAYON_NUM_THREADS", threads));
    let first = single("1", Command::new(&lacuna).arg("screen").arg(&one))?;
    let full = single("1", Command::new(&lacuna).arg("diagnose").arg(&one))?;
    figures
        .push(Figure::free("case of 4 recordings, screened on one core", first.seconds, "s").asked(Asked::AtMost(0.5)));
    figures
        .push(Figure::free("case of 4 recordings, diagnosed on one core", full.seconds, "s").asked(Asked::AtMost(3.0)));
    let case = vec![Run { what: "screened".into(), ended: first }, Run { what: "diagnosed".into(), ended: full }];

    let mut lengths = Vec::new();
    for minutes in [1, 10, 60, 600 / share] {
        let file = fleet.long(minutes)?;
        let run = ended(Command::new(&lacuna).arg("screen").args(fleet.against()).arg("--recordings").arg(&file));
        std::fs::remove_file(&file).with_context(|| format!("cannot remove '{}'", file.display()))?;
        lengths.push(Run { what: words(minutes), ended: run? });
    }
    if let Some(longest) = lengths.last() {
        let name = format!("{} at 1 kHz, screened from CSV on all cores", longest.what);
        figures
            .push(Figure::free(name, longest.ended.seconds, "s").asked(Asked::AtMost(15.0 / f64::from(share as u32))));
    }

    let mut screened = Vec::new();
    for count in [100, 1000, 10_000 / share] {
        let many = fleet.many(count)?;
        let run = ended(Command::new(&lacuna).arg("screen").args(fleet.against()).arg("--recordings").arg(&many))?;
        screened.push(Run { what: count.to_string(), ended: run });
    }
    if let Some(most) = screened.last() {
        let name = format!("{} recordings of 30 s, screened on all cores", most.what);
        figures.push(Figure::free(name, most.ended.seconds, "s").asked(Asked::AtMost(30.0 / f64::from(share as u32))));
    }

    let batch = |count: usize, threads: Option<&str>| -> Result<Run> {
        let many = fleet.many(count)?;
        let out = folder.join("batch");
        if out.exists() {
            std::fs::remove_dir_all(&out).with_context(|| format!("cannot remove '{}'", out.display()))?;
        }
        let mut command = Command::new(&lacuna);
        command.arg("batch").arg(&many).args(fleet.against()).arg("-o").arg(&out);
        command.args(threads.into_iter().flat_map(|n| ["--threads", n]));
        Ok(Run { what: count.to_string(), ended: ended(&mut command)? })
    };
    let cores = vec![
        Run { what: "1".into(), ..batch(ON_CORES, Some("1"))? },
        Run { what: "2".into(), ..batch(ON_CORES, Some("2"))? },
    ];
    let gain = cores[0].ended.seconds / cores[1].ended.seconds;
    figures.push(Figure::free("two cores over one, 40 recordings diagnosed", gain, "").asked(Asked::AtLeast(1.8)));
    let mut diagnosed = Vec::new();
    for count in [10, 100, 1000 / share] {
        diagnosed.push(batch(count, None)?);
    }
    if let Some(most) = diagnosed.last() {
        let name = format!("{} recordings of 30 s, diagnosed on all cores", most.what);
        figures.push(Figure::free(name, most.ended.seconds, "s").asked(Asked::AtMost(600.0 / f64::from(share as u32))));
    }
    let all = [&case, &lengths, &screened, &diagnosed, &cores];
    let memory = all.iter().flat_map(|runs| runs.iter()).filter_map(|run| run.ended.memory).max().unwrap_or(0);
    let memory = Figure::free("largest memory of any of these", memory as f64 / f64::from(1 << 20), "MiB");
    figures.push(memory.asked(Asked::AtMost(MOST_MEMORY)));

    let titles = [
        ("One case: 4 recordings of 30 s and 3 references, one core", "what"),
        ("Length of one recording, CSV of 15 columns at 1 kHz, screened on all cores", "length"),
        ("Number of recordings of 30 s at 100 Hz, screened on all cores", "recordings"),
        ("The same, each diagnosed in full by `lacuna batch`", "recordings"),
        ("Threads of `lacuna batch`, 40 recordings", "threads"),
    ];
    let mut sections: Vec<Section> =
        titles.iter().zip(all).map(|((title, what), runs)| table(title, what, runs)).collect();
    sections.push(goals(&figures));
    tell(&folder, &sections, args.docs)?;
    output::write(&folder, "summary.json", &serde_json::to_string_pretty(&figures)?)?;
    Ok(figures.iter().all(|figure| figure.pass != Some(false)))
}

/// Prints the tables and writes them.
fn tell(folder: &Path, sections: &[Section], docs: bool) -> Result<()> {
    print!("{}", to_text(sections));
    let page = to_markdown("Growth", "", sections);
    output::write(folder, "growth.md", &page)?;
    if docs {
        output::into_docs("performance.md", MARKS, &output::below_title(&page)?)?;
    }
    Ok(())
}

fn table(title: &str, what: &str, runs: &[Run]) -> Section {
    let mut section = Section::new(title, "", &[what, "s", "s on processors", "MiB at most"]);
    for Run { what, ended } in runs {
        let memory = ended.memory.map(|bytes| (bytes >> 20) as f64);
        let cells = [Some(ended.seconds), ended.processor, memory].map(|x| number(x).into());
        section.rows.push(std::iter::once(what.as_str().into()).chain(cells).collect());
    }
    section
}

fn goals(figures: &[Figure]) -> Section {
    let mut section = Section::new("What is asked of these", "", &["figure", "measured", "asked", "met"]);
    for f in figures {
        let measured = format!("{} {}", number(Some(f.value)), f.unit);
        let met = if f.pass == Some(false) { "NO" } else { "yes" };
        let cells = [f.name.as_str(), measured.trim(), f.target.as_deref().unwrap_or(""), met];
        section.rows.push(cells.map(Into::into).to_vec());
    }
    section
}

fn words(minutes: usize) -> String {
    if minutes < 60 { format!("{minutes} min") } else { format!("{} h", minutes / 60) }
}

/// Runs the program, which must not fail.
fn ended(command: &mut Command) -> Result<Ended> {
    let ended = child::run(command.stdin(Stdio::null()).stdout(Stdio::null()))?;
    ensure!(ended.status.success(), "lacuna ended with {}; see above", ended.status);
    Ok(ended)
}

/// A folder that is made anew.
fn fresh(path: PathBuf) -> Result<PathBuf> {
    if path.exists() {
        std::fs::remove_dir_all(&path).with_context(|| format!("cannot remove '{}'", path.display()))?;
    }
    std::fs::create_dir_all(&path).with_context(|| format!("cannot create '{}'", path.display()))?;
    Ok(path)
}
