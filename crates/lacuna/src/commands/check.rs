//! `lacuna check`: what is inside recordings, and how good it is.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};
use clap::Args as ClapArgs;
use lacuna::inputs::{self, Loaded};
use lacuna::propose::{self, Proposal};
use lacuna::{case_folder, skeleton, which_mapping};
use recordings::{BUILT_IN_MAPPINGS, Contents, Fingerprint, Mapping, Quality, TableContents, group_by_content};

use super::{Outcome, Reading};
use crate::console::{Progress, emit, emit_json};

mod as_json;
mod as_text;
mod permits;
mod stamps;
mod tables;

const EXAMPLES: &str = "\
Examples:
  lacuna check walk/                                   a rosbag2 folder: topics, fields, what is lost
  lacuna check walk_0.mcap --fields                    with every field that a mapping can name
  lacuna check walk/ --write-mapping map.toml          a mapping to look through and use with --mapping map.toml
  lacuna check FLOORING --mapping husky-open           the channels of CSV recordings
  lacuna check log.csv --write-mapping map.toml        of an unknown table a skeleton, to say which column is what

Without --mapping the built-in mappings are tried; the first that fits is used and named. Where none fits a bag, one is
proposed and used here, with all that was inferred; lacuna diagnose asks for it to be written and named.

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
    let mut bags = Vec::new();
    for path in &args.paths {
        ensure!(path.exists(), "there is no file or folder '{}'", path.display());
    }
    for path in which_mapping::bags(&args.paths)? {
        progress.stage(&path.display().to_string());
        bags.push(which_mapping::look(&path)?);
    }
    progress.stage("channels");
    let (mapping, loaded, tables) = mapped(args, &bags)?;
    let prints: Vec<Fingerprint> = loaded.reads.iter().map(|r| Fingerprint::of(&r.recording)).collect();
    let names: Vec<String> = loaded.reads.iter().map(case_folder::file_names).collect();
    let same = group_by_content(&prints).into_iter().filter(|group| group.len() > 1);
    let same = same.map(|group| group.into_iter().map(|i| names[i].clone()).collect()).collect();
    let recordings = loaded.reads.iter().zip(&names).map(|(read, name)| Mapped {
        name: name.clone(),
        channels: read.recording.channels().iter().map(measure).collect(),
        permits: permits::permits(&read.recording),
    });
    // What a mapping reads of a bag is lost there as well: told once.
    let mut lost: Vec<String> = loaded.lost().collect();
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

fn measure(channel: &recordings::Channel) -> Measured {
    Measured {
        name: channel.signal().name().to_owned(),
        column: channel.column().to_owned(),
        unit: channel.signal().unit().symbol(),
        quality: Quality::of(channel),
    }
}

/// The mapping that was used, what it read, and tables that none fits.
type Tried = (Used, Loaded, Vec<(String, TableContents)>);

/// The recordings as a mapping reads them: the one that was named, else the first built-in one that fits all, else for
/// bags one that is proposed.
fn mapped(args: &Args, bags: &[(String, Contents)]) -> Result<Tried> {
    let options = args.reading.options();
    let load = |mapping: &Mapping| inputs::load(mapping, &args.paths, &options);
    if let Some(name) = &args.mapping {
        return Ok((Used::Named(name.clone()), load(&case_folder::mapping(name)?)?, Vec::new()));
    }
    let (mut failures, mut broken) = (Vec::new(), false);
    for (name, _) in BUILT_IN_MAPPINGS {
        let mapping = case_folder::mapping(name)?;
        let of_bags = |entry: &recordings::FileMapping| entry.topic.is_some();
        let needs_fitting_bag =
            if bags.is_empty() { mapping.files.iter().all(of_bags) } else { mapping.files.iter().any(of_bags) };
        if needs_fitting_bag && !bags.iter().any(|(_, contents)| which_mapping::fits(&mapping, contents)) {
            continue;
        }
        match load(&mapping) {
            Ok(loaded) if loaded.unmatched.is_empty() => {
                return Ok((Used::BuiltIn((*name).to_owned()), loaded, Vec::new()));
            }
            Ok(_) => {}
            Err(error) => {
                broken |= !tables::is_another_ones(&error);
                failures.push(format!("{name}: {error:#}"));
            }
        }
    }
    if bags.is_empty() {
        // A table that has the right columns and is broken is no unknown table.
        let tables = if broken { Vec::new() } else { tables::look(&args.paths)? };
        ensure!(!tables.is_empty(), "no built-in mapping fits; name one with --mapping\n  {}", failures.join("\n  "));
        return Ok((Used::Nothing(None), Loaded::default(), tables));
    }
    for (bag, contents) in bags {
        let Some(Proposal { toml, inferred }) = propose::mapping("proposed", contents) else { continue };
        return Ok(match Mapping::parse("proposed", &toml).map_err(Into::into).and_then(|mapping| load(&mapping)) {
            Ok(loaded) => (Used::Proposed { bag: bag.clone(), inferred }, loaded, Vec::new()),
            Err(error) => {
                let why = format!("a mapping proposed for {bag} does not read the recordings: {error:#}");
                (Used::Nothing(Some(why)), Loaded::default(), Vec::new())
            }
        });
    }
    Ok((Used::Nothing(None), Loaded::default(), Vec::new()))
}
