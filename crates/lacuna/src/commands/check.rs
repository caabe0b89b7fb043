//! `lacuna check`: what is inside recordings, and how good it is.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};
use case_files::check::{Listener, Proposed, Request, check};
use case_files::columns::Kind;
use case_files::{columns_case, propose, skeleton};
use clap::Args as ClapArgs;
use recordings::{Contents, TableContents};

use super::{Outcome, Reading};
use crate::console::{Progress, emit, emit_json};

mod as_text;
mod of_robot;
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
  lacuna check walk/ --robot my-robot.toml --write-mapping new-robot.toml
                                         of a robot of wheel counts or a car,
                                         whose file names its columns: the file
                                         with columns that the bag has
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
    /// Robot of wheel counts, car or robot of any wheels, whose file names its columns itself: the recordings are read by these.
    #[arg(long, value_name = "NAME|FILE", conflicts_with = "mapping")]
    robot: Option<String>,
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
    let robot =
        args.robot.as_deref().map(|robot| anyhow::Ok((robot, columns_case::needed_kind(robot)?))).transpose()?;
    let request =
        Request { paths: &args.paths, mapping: args.mapping.as_deref(), robot, options: args.reading.options() };
    let (stage, bytes) = (|what: &str| progress.stage(what), |done, of| progress.bytes(done, of));
    let listener = Listener { stage: &stage, bytes: &bytes };
    let mut checked = check(&request, &listener)?;
    if let Some(target) = &args.write_mapping {
        let proposed = propose_to(target, robot, &checked.bags, &checked.tables)?;
        // What the new file reads is what its owner wants to see.
        if let Some((_, kind)) = robot {
            checked = check(&Request { robot: Some((&proposed.file, kind)), ..request }, &listener)?;
        }
        checked.proposed = Some(proposed);
    }
    drop(progress);
    if let Some(target) = &args.json {
        emit_json(target, &checked.to_json())?;
    }
    if args.json.as_deref() != Some("-") {
        emit(&as_text::render(&checked, args.fields))?;
    }
    Ok(Outcome::of(&checked.lost))
}

/// Writes a proposed mapping, or the file of a robot that names its columns itself.
fn propose_to(
    target: &Path,
    robot: Option<(&str, Kind)>,
    bags: &[(String, Contents)],
    tables: &[(String, TableContents)],
) -> Result<Proposed> {
    let file = target.display().to_string();
    let name = target.file_stem().map_or_else(|| file.clone(), |stem| stem.to_string_lossy().into_owned());
    let (toml, inferred, is_skeleton) = match (bags.first(), tables.first()) {
        (Some((bag, contents)), _) if let Some((robot, kind)) = robot => {
            let proposal = propose::columns(robot, kind, contents).with_context(|| bag.clone())?;
            (proposal.toml, proposal.inferred, false)
        }
        (None, _) if robot.is_some() => bail!(
            "--write-mapping with --robot needs a bag; of tables name the columns in the robot file, as their first lines do"
        ),
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
