//! `cargo xtask bag`: what `lacuna check` costs on a large bag, beside a plain iteration over the same messages.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, ensure};
use clap::Args as ClapArgs;

use crate::child::{self, Ended};
use crate::{binary, output};

mod drive;
mod iterate;
mod measured;
mod ros2;
mod write;

use measured::Measured;

const EXAMPLES: &str = "\
Examples:
  cargo xtask bag                          1 GiB of joint states, inertial unit and odometry
  cargo xtask bag --camera                 the same with a camera, which fills most of it
  cargo xtask bag --mebibytes 64 --keep    a small one that stays for other measurements

The program that is measured is `lacuna` beside this one. After a change to it:
  cargo build --release -p lacuna --bin lacuna";

/// Arguments of `cargo xtask bag`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// Size of the bag.
    #[arg(long, value_name = "MiB", default_value_t = 1024, value_parser = clap::value_parser!(u64).range(1..))]
    mebibytes: u64,
    /// Add compressed pictures of a camera, as most real bags have.
    #[arg(long)]
    camera: bool,
    /// Where to write the bag [default: target/bag/drive.mcap].
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Leave the bag where it is.
    #[arg(long)]
    keep: bool,
    /// How often each program runs.
    #[arg(long, default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..))]
    rounds: u32,
    /// Only iterate over the messages of a bag: the other program of the comparison.
    #[arg(long, hide = true, value_name = "FILE")]
    iterate: Option<PathBuf>,
}

/// Runs the command; true if the targets are met.
pub(crate) fn run(args: &Args) -> Result<bool> {
    if let Some(bag) = &args.iterate {
        let counted = iterate::iterate(bag)?;
        println!("{} messages, {} bytes", counted.messages, counted.bytes);
        return Ok(true);
    }
    let folder = output::folder("bag")?;
    let bag = args.out.clone().unwrap_or_else(|| folder.join("drive.mcap"));
    let lacuna = binary::find()?;
    ensure!(!bag.exists(), "'{}' is there already; remove it or name another file with --out", bag.display());
    let made = write::write(&bag, args.mebibytes << 20, args.camera).and_then(|written| {
        println!(
            "{}: {} MiB, {} messages of {:.0} s",
            bag.display(),
            written.bytes >> 20,
            written.messages,
            written.seconds
        );
        measure(&bag, &lacuna.path, args.rounds)
    });
    if !args.keep && bag.exists() {
        std::fs::remove_file(&bag).with_context(|| format!("cannot remove '{}'", bag.display()))?;
    }
    let measured = made?;
    print!("{}", measured.table());
    let figures = measured.figures();
    output::write(&folder, "summary.json", &serde_json::to_string_pretty(&figures)?)?;
    Ok(figures.iter().all(|figure| figure.pass != Some(false)))
}

/// Runs both programs in turn, so that a change of the machine's load meets both.
fn measure(bag: &Path, lacuna: &Path, rounds: u32) -> Result<Measured> {
    let this = std::env::current_exe().context("cannot tell where this program is")?;
    let mut measured = Measured::default();
    for _ in 0..rounds {
        measured.iteration.push(ended(Command::new(&this).args(["bag", "--iterate"]).arg(bag))?);
        measured.check.push(ended(Command::new(lacuna).arg("check").arg(bag))?);
    }
    Ok(measured)
}

/// Runs a program, which must succeed.
fn ended(command: &mut Command) -> Result<Ended> {
    let ended = child::run(command.stdin(Stdio::null()).stdout(Stdio::null()))?;
    let program = command.get_program().to_string_lossy();
    ensure!(ended.status.success(), "'{program}' ended with {}; see above", ended.status);
    Ok(ended)
}
