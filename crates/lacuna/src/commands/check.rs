//! `lacuna check`: what is inside recordings, and how good it is.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};
use case_files::check::{Listener, Proposed, Request, check};
use case_files::{propose, skeleton};
use clap::Args as ClapArgs;
use recordings::{Contents, TableContents};

use super::{Outcome, Reading};
use crate::console::{Progress, emit, emit_json};

mod as_text;
mod stamps;
mod tables;

const EXAMPLES: &str = "\
Examples:
  lacuna check walk/                     a rosbag2 folder: topics, what is lost
  lacuna check walk_0.mcap --fields      every field that a mapping can name
  lacuna check walk/ --write-mapping map.toml
                                         a mapping to look through, then to use
                                         with --mapping map.toml
  lacuna check FLOORING --mapping husky-open
                                         the channels of CSV recordings
  lacuna check log.csv --write-mapping map.toml
                                         of an unknown table a skeleton, to say
                                         which column is what

Without --mapping the built-in mappings are tried; the first that fits is used
and named. Where none fits a bag, one is proposed and used here, with all that
was inferred; lacuna diagnose asks for it to be written and named.

Exit codes: 0 done, 1 failed, 2 wrong usage, 3 done but some input was lost.";

/// Arguments of `lacuna check`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// Files, or folders of recordings.
    #[arg(required = true, num_args = 1..)]
    paths: Vec<PathBuf>,
    /// Mapping file (column -> signal, unit, sign), or name of a built-in mapping.
    #[arg(long, value_name = "NAME|FILE")]
    mapping: Option<String>,
    /// List the numeric fields of every topic.
    #[arg(long)]
    fields: bool,
    /// Propose a mapping for the first bag, by message types and joint names, and write it to a file; of a table that no
    /// built-in mapping fits, its skeleton.
    #[arg(long, value_name = "FILE")]
    write_mapping: Option<PathBuf>,
    /// What to do with bad rows and cells of recordings.
    #[arg(long, value_enum, default_value_t)]
    reading: Reading,
    /// Write everything as JSON to a file; `-` is standard output, instead of the text.
    #[arg(long, value_name = "FILE|-")]
    json: Option<String>,
}

/// Checks recordings.
pub(crate) fn run(args: &Args, verbose: bool) -> Result<Outcome> {
    let progress = Progress::new(verbose);
    let request = Request { paths: &args.paths, mapping: args.mapping.as_deref(), options: args.reading.options() };
    let (stage, bytes) = (|what: &str| progress.stage(what), |done, of| progress.bytes(done, of));
    let mut checked = check(&request, &Listener { stage: &stage, bytes: &bytes })?;
    let target = args.write_mapping.as_deref();
    checked.proposed = target.map(|target| propose_to(target, &checked.bags, &checked.tables)).transpose()?;
    drop(progress);
    if let Some(target) = &args.json {
        emit_json(target, &checked.to_json())?;
    }
    if args.json.as_deref() != Some("-") {
        emit(&as_text::render(&checked, args.fields))?;
    }
    Ok(Outcome::of(&checked.lost))
}

/// Writes a proposed mapping.
fn propose_to(target: &Path, bags: &[(String, Contents)], tables: &[(String, TableContents)]) -> Result<Proposed> {
    let file = target.display().to_string();
    let name = target.file_stem().map_or_else(|| file.clone(), |stem| stem.to_string_lossy().into_owned());
    let (toml, inferred, is_skeleton) = match (bags.first(), tables.first()) {
        (Some((bag, contents)), _) => {
            let nothing =
                || format!("{bag}: no topic has joints, an inertial unit or a pose that a mapping could name");
            let proposal = propose::mapping(&name, contents).with_context(nothing)?;
            (proposal.toml, proposal.inferred, false)
        }
        // What was inferred of a table is reported with its columns.
        (None, Some((table, contents))) => (skeleton::mapping(&name, table, contents), Vec::new(), true),
        (None, None) => bail!("--write-mapping needs a bag, or a table that no mapping fits; these have one"),
    };
    ensure!(!target.exists(), "'{file}' is there already; name another file for the mapping");
    std::fs::write(target, toml).with_context(|| format!("cannot write '{file}'"))?;
    Ok(Proposed { file, inferred, is_skeleton })
}
