//! `cargo xtask mujoco`: exported models in MuJoCo itself, against the truth of drawn cases.
//!
//! ```text
//! blind --draw-only --> cases, truth --lacuna diagnose, export--> models --MuJoCo on held-out inputs--> distances from the truth
//! ```

use std::path::Path;
use std::process::{Command, Stdio};

use anyhow::{Context, Result, ensure};
use clap::Args as ClapArgs;

use crate::blind::layout::Layout;
use crate::blind::seal::Seals;
use crate::document::{to_markdown, to_text};
use crate::{binary, child, output};

mod case;
mod python;
mod tables;

use case::Proved;

const EXAMPLES: &str = "\
Examples:
  cargo xtask mujoco                12 cases
  cargo xtask mujoco --docs         and write the table into docs/export.md

Python with MuJoCo: LACUNA_MUJOCO_PYTHON names one, else a virtual environment is made below target/mujoco.
The program that is examined is `lacuna` beside this one. After a change to it:
  cargo build --release -p lacuna --bin lacuna";

/// Shares of cases with nothing hidden, one effect, two, and an unknown cause.
const MIX: &str = "0,0.75,0.25,0";
/// Where the table stands in the page.
const MARKS: [&str; 2] = ["<!-- proof -->\n", "<!-- end of proof -->\n"];

/// Arguments of `cargo xtask mujoco`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// Number of cases.
    #[arg(long, default_value_t = 12, value_parser = clap::value_parser!(u32).range(1..))]
    count: u32,
    /// Seed of the cases.
    #[arg(long, default_value_t = 11)]
    seed: u64,
    /// Write the table into docs/export.md.
    #[arg(long)]
    docs: bool,
}

/// Runs the command; true if the corrected model is closer in most cases whose causes the engine holds.
pub(crate) fn run(args: &Args) -> Result<bool> {
    let folder = output::folder("mujoco")?;
    let Some(python) = python::ready(&folder) else {
        return Ok(true);
    };
    let set = folder.join(format!("set-{}-{}", args.seed, args.count));
    draw(args, &set)?;
    let layout = Layout::new(set);
    let seals = Seals::open(&layout)?;
    let lacuna = binary::find()?;
    let bar = output::progress(u64::from(args.count), "cases")?;
    let mut proved: Vec<Proved> = Vec::new();
    for name in seals.names() {
        proved.push(case::prove(name, &layout, &seals, &lacuna.path, &python).with_context(|| format!("case {name}"))?);
        bar.inc(1);
    }
    bar.finish_and_clear();
    let sections = tables::all(&proved);
    let intro = tables::intro(args.seed, &proved);
    print!("{intro}\n{}", to_text(&sections));
    let figures = tables::figures(&proved);
    output::write(&folder, "summary.json", &serde_json::to_string_pretty(&figures)?)?;
    let page = to_markdown("Exported models in MuJoCo", &intro, &sections);
    output::write(&folder, "mujoco.md", &page)?;
    if args.docs {
        // The page has a title of its own.
        let (_, below) = page.split_once("\n\n").context("a page without a title")?;
        output::into_docs("export.md", MARKS, below)?;
    }
    Ok(figures.iter().all(|f| f.pass != Some(false)))
}

/// Draws the cases as anybody would.
fn draw(args: &Args, set: &Path) -> Result<()> {
    let this = std::env::current_exe().context("cannot tell where this program is")?;
    let mut command = Command::new(this);
    command.args(["blind", "--draw-only", "--setting", "normal", "--mix", MIX]);
    command.args(["--seed", &args.seed.to_string(), "--count", &args.count.to_string(), "--out"]).arg(set);
    let ended = child::run(command.stdin(Stdio::null()).stdout(Stdio::null()))?;
    ensure!(ended.status.success(), "the cases could not be drawn ({}); see above", ended.status);
    Ok(())
}
