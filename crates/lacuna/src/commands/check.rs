//! `lacuna check`: what is inside recordings, and how good it is.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};
use clap::Args as ClapArgs;
use lacuna::{propose, skeleton};
use recordings::{Contents, Fingerprint, Quality, Survey, SurveyedChannel, TableContents, group_by_content};

use find::Found;

use super::{Outcome, Reading};
use crate::console::{Progress, emit, emit_json};

mod as_json;
mod as_text;
mod find;
mod permits;
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

/// A channel and what was measured of it.
struct Measured {
    name: String,
    column: String,
    unit: &'static str,
    quality: Quality,
}

/// A recording as a mapping reads it.
struct Mapped {
    name: String,
    channels: Vec<Measured>,
    /// Which diagnoses the signals permit, in sentences.
    permits: Vec<String>,
}

/// The mapping that was used.
enum Used {
    /// By the user.
    Named(String),
    /// Found to fit.
    BuiltIn(String),
    /// Proposed for this bag, with what was inferred.
    Proposed { bag: String, inferred: Vec<String> },
    /// None; why a proposed one does not read the recordings, if one was.
    Nothing(Option<String>),
}

/// All that was found.
struct Checked {
    /// Bags and what is inside, before anybody has said what it means.
    bags: Vec<(String, Contents)>,
    /// Tables that no mapping fits.
    tables: Vec<(String, TableContents)>,
    mapping: Used,
    recordings: Vec<Mapped>,
    /// Recordings of the same data.
    same: Vec<Vec<String>>,
    /// Where a proposed mapping was written, and what was inferred for it.
    proposed: Option<Proposed>,
    lost: Vec<String>,
}

/// A mapping that was written.
struct Proposed {
    file: String,
    inferred: Vec<String>,
    /// Which column is which signal is still to be said.
    is_skeleton: bool,
}

/// Checks recordings.
pub(crate) fn run(args: &Args, verbose: bool) -> Result<Outcome> {
    let progress = Progress::new(verbose);
    for path in &args.paths {
        ensure!(path.exists(), "there is no file or folder '{}'", path.display());
    }
    let (bags, Found { mapping, surveyed, tables }) = find::find(args, &progress)?;
    let prints: Vec<Fingerprint> = surveyed.surveys.iter().map(Survey::fingerprint).collect();
    let names: Vec<String> = surveyed.surveys.iter().map(file_names).collect();
    let same = group_by_content(&prints).into_iter().filter(|group| group.len() > 1);
    let same = same.map(|group| group.into_iter().map(|i| names[i].clone()).collect()).collect();
    let recordings = surveyed.surveys.iter().zip(&names).map(|(survey, name)| Mapped {
        name: name.clone(),
        permits: permits::permits(&survey.channels.iter().map(|channel| channel.signal).collect::<Vec<_>>()),
        channels: survey.channels.iter().map(measured).collect(),
    });
    // What a mapping reads of a bag is lost there as well: told once.
    let mut lost: Vec<String> = surveyed.lost().collect();
    for loss in bags.iter().flat_map(|(_, contents)| &contents.losses).map(ToString::to_string) {
        if !lost.contains(&loss) {
            lost.push(loss);
        }
    }
    lost.extend(tables.iter().filter_map(tables::lost));
    let proposed = args.write_mapping.as_deref().map(|target| propose_to(target, &bags, &tables)).transpose()?;
    let checked = Checked { bags, tables, mapping, recordings: recordings.collect(), same, proposed, lost };
    drop(progress);
    if let Some(target) = &args.json {
        emit_json(target, &as_json::render(&checked))?;
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
        // What was inferred of a table is told with its columns.
        (None, Some((table, contents))) => (skeleton::mapping(&name, table, contents), Vec::new(), true),
        (None, None) => bail!("--write-mapping needs a bag, or a table that no mapping fits; these have one"),
    };
    ensure!(!target.exists(), "'{file}' is there already; name another file for the mapping");
    std::fs::write(target, toml).with_context(|| format!("cannot write '{file}'"))?;
    Ok(Proposed { file, inferred, is_skeleton })
}

fn measured(channel: &SurveyedChannel) -> Measured {
    Measured {
        name: channel.signal.name().to_owned(),
        column: channel.column.clone(),
        unit: channel.signal.unit().symbol(),
        quality: channel.quality.clone(),
    }
}

/// The files of a recording.
fn file_names(survey: &Survey) -> String {
    survey.sources.iter().map(|source| source.name.as_str()).collect::<Vec<_>>().join(" + ")
}
