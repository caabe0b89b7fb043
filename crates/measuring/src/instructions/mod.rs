//! `cargo xtask instructions`: instructions of the hot kernels, against those on record.
//!
//! Times on a shared machine cannot fail a build; instructions can. They are those of one compiler and of the vector unit that
//! `pulp` finds inside valgrind: where either differs from the record's, nothing is compared.
//!
//! Of gungraun, which starts callgrind too, its runner would have to be installed by hand in the version of the library;
//! what is counted here are the examples that the benchmarks race, as they are.

use std::collections::BTreeMap;
use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args as ClapArgs;
use rayon::prelude::*;

use crate::{compare, examples, output};

mod callgrind;
mod kernels;
mod record;

use kernels::{KERNELS, Kernel};
use record::Record;

const EXAMPLES: &str = "\
Examples:
  cargo xtask instructions           compare with benches/instructions.json
  cargo xtask instructions --write   put the present counts there

Exit codes: 0 no kernel takes over 5 % more than on record (or valgrind is
missing, or compiler or vector unit differ: then nothing is compared), 1 one
does, or an error, 2 wrong usage.";

/// The counts on record, from the workspace.
const FILE: &str = "benches/instructions.json";

/// Arguments of `cargo xtask instructions`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// Put the present counts on record.
    #[arg(long)]
    write: bool,
}

/// Runs the command; true if no kernel takes too many instructions.
pub(crate) fn run(args: &Args) -> Result<bool> {
    if !callgrind::is_there() {
        eprintln!("SKIPPED: there is no valgrind, so that instructions cannot be counted; install valgrind");
        return Ok(true);
    }
    let folder = output::folder("instructions")?;
    let weak_form = examples::built("weak-form", "kernel").map_err(anyhow::Error::msg)?;
    let here = Record {
        compiler: compare::machine::rust_version().context("rustc does not tell its version")?,
        vector_unit: callgrind::vector_unit(&weak_form, &folder)?,
        kernels: BTreeMap::new(),
    };
    let path = output::beside(FILE);
    let record = if args.write { Record::default() } else { read(&path)? };
    if !args.write
        && let Some(why) = record.unlike(&here.compiler, &here.vector_unit)
    {
        eprintln!(
            "SKIPPED: instructions are not compared: {why}; `cargo xtask instructions --write` makes a new record"
        );
        return Ok(true);
    }
    println!("{}; in valgrind pulp takes {}", here.compiler, here.vector_unit);
    let mut programs: BTreeMap<&str, Result<PathBuf, String>> = BTreeMap::new();
    for kernel in KERNELS {
        programs.entry(kernel.example).or_insert_with(|| examples::built(kernel.package, kernel.example));
    }

    // Other programs beside it change no program's instructions.
    let count = |kernel: &Kernel| {
        let program = programs[kernel.example].clone()?;
        callgrind::per_step(kernel, &program, &folder).map_err(|e| format!("{e:#}"))
    };
    let counts: Vec<Result<f64, String>> = KERNELS.par_iter().map(count).collect();
    let mut counted: BTreeMap<String, f64> = BTreeMap::new();
    let mut passes = true;
    for (kernel, count) in KERNELS.iter().zip(counts) {
        passes &= told(kernel, &record, &count, args.write);
        counted.extend(count.ok().map(|count| (kernel.name.to_owned(), (10.0 * count).round() / 10.0)));
    }
    if args.write {
        let text = serde_json::to_string_pretty(&Record { kernels: counted, ..here })? + "\n";
        std::fs::write(&path, text).with_context(|| format!("cannot write '{}'", path.display()))?;
        println!("written to {FILE}");
    }
    Ok(passes)
}

/// Prints what a count says; true if the build may go on.
fn told(kernel: &Kernel, record: &Record, count: &Result<f64, String>, write: bool) -> bool {
    match (write, count) {
        (true, Ok(count)) => {
            println!("  {:<18} {count:.1} per step", kernel.name);
            true
        }
        (true, Err(why)) => {
            eprintln!("  {:<18} NOT WRITTEN: {why}", kernel.name);
            false
        }
        (false, _) => {
            let said = record.judge(kernel.name, count);
            println!("  {:<18} {said}", kernel.name);
            said.passes()
        }
    }
}

fn read(path: &std::path::Path) -> Result<Record> {
    let text = std::fs::read_to_string(path)
        .with_context(|| format!("cannot read '{}'; `cargo xtask instructions --write` makes it", path.display()))?;
    serde_json::from_str(&text).with_context(|| {
        format!("'{}' is no record; `cargo xtask instructions --write` makes a new one", path.display())
    })
}
