//! `lacuna check`: what is inside recordings, and how good it is.

use std::fs::File;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};
use clap::Args as ClapArgs;
use lacuna::case_folder;
use lacuna::inputs::{self, Loaded};
use lacuna::propose;
use recordings::{BUILT_IN_MAPPINGS, Contents, Fingerprint, Quality, contents, group_by_content};

use super::{Outcome, Reading};
use crate::console::{Progress, emit, emit_json};

mod as_json;
mod as_text;
mod permits;

const EXAMPLES: &str = "\
Examples:
  lacuna check walk/                                   a rosbag2 folder: topics, fields, what is lost
  lacuna check walk_0.mcap --fields                    with every field that a mapping can name
  lacuna check walk/ --write-mapping map.toml          a mapping to look through and use with --mapping map.toml
  lacuna check FLOORING --mapping husky-open           the channels of CSV recordings

Without --mapping the built-in mappings are tried; the first that fits is used and named.

Exit codes: 0 done, 1 failed, 2 wrong usage, 3 done but some input was lost.";

/// Endings of files that are bags.
const BAGS: [&str; 4] = [".mcap", ".db3", ".mcap.zstd", ".db3.zstd"];

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
    /// Propose a mapping for the first bag, by message types and joint names, and write it to a file.
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

/// All that was found.
struct Checked {
    /// Bags and what is inside, before anybody has said what it means.
    bags: Vec<(String, Contents)>,
    /// The mapping that was used, and whether it was named or found.
    mapping: Option<(String, bool)>,
    recordings: Vec<Mapped>,
    /// Recordings of the same data.
    same: Vec<Vec<String>>,
    /// Where a proposed mapping was written, and what was inferred for it.
    proposed: Option<(String, Vec<String>)>,
    lost: Vec<String>,
}

/// Checks recordings.
pub(crate) fn run(args: &Args, verbose: bool) -> Result<Outcome> {
    let progress = Progress::new(verbose);
    let mut bags = Vec::new();
    for path in bag_files(&args.paths)? {
        let name = path.display().to_string();
        progress.stage(&name);
        let mut file = File::open(&path).with_context(|| format!("cannot read '{name}'"))?;
        bags.push((name.clone(), contents(&name, &mut file)?));
    }
    progress.stage("channels");
    let (mapping, loaded) = mapped(args, !bags.is_empty())?;
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
    let proposed = args.write_mapping.as_deref().map(|target| propose_to(target, &bags)).transpose()?;
    let checked = Checked { bags, mapping, recordings: recordings.collect(), same, proposed, lost };
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
fn propose_to(target: &Path, bags: &[(String, Contents)]) -> Result<(String, Vec<String>)> {
    let shown = target.display().to_string();
    let (bag, contents) =
        bags.first().context("--write-mapping needs a bag; of a table nobody knows what a column means")?;
    let name = target.file_stem().map_or_else(|| shown.clone(), |stem| stem.to_string_lossy().into_owned());
    let proposal = propose::mapping(&name, contents)
        .with_context(|| format!("{bag}: no topic has joints, an inertial unit or a pose that a mapping could name"))?;
    ensure!(!target.exists(), "'{shown}' is there already; name another file for the mapping");
    std::fs::write(target, proposal.toml).with_context(|| format!("cannot write '{shown}'"))?;
    Ok((shown, proposal.inferred))
}

fn measure(channel: &recordings::Channel) -> Measured {
    Measured {
        name: channel.signal().name().to_owned(),
        column: channel.column().to_owned(),
        unit: channel.signal().unit().symbol(),
        quality: Quality::of(channel),
    }
}

/// The bags among files, in folders and in the folders of these.
fn bag_files(paths: &[PathBuf]) -> Result<Vec<PathBuf>> {
    let is_bag = |path: &Path| BAGS.iter().any(|end| path.to_string_lossy().ends_with(end));
    let mut out = Vec::new();
    for path in paths {
        ensure!(path.exists(), "there is no file or folder '{}'", path.display());
        if path.is_dir() {
            let mut folders = vec![path.clone()];
            folders.extend(inputs::list(path)?.into_iter().filter(|p| p.is_dir()));
            for folder in folders {
                out.extend(inputs::list(&folder)?.into_iter().filter(|p| p.is_file() && is_bag(p)));
            }
        } else if is_bag(path) {
            out.push(path.clone());
        }
    }
    Ok(out)
}

/// The recordings as a mapping reads them: the one that was named, else the first built-in one that fits all.
fn mapped(args: &Args, some_bags: bool) -> Result<(Option<(String, bool)>, Loaded)> {
    let options = args.reading.options();
    if let Some(name) = &args.mapping {
        let loaded = inputs::load(&case_folder::mapping(name)?, &args.paths, &options)?;
        return Ok((Some((name.clone(), true)), loaded));
    }
    let mut failures = Vec::new();
    for (name, _) in BUILT_IN_MAPPINGS {
        match case_folder::mapping(name).and_then(|m| inputs::load(&m, &args.paths, &options)) {
            Ok(loaded) if loaded.unmatched.is_empty() => return Ok((Some(((*name).to_owned(), false)), loaded)),
            Ok(_) => {}
            Err(error) => failures.push(format!("{name}: {error:#}")),
        }
    }
    // Bags tell what is inside without a mapping; of a table nothing can be said.
    ensure!(some_bags, "no built-in mapping fits; name one with --mapping\n  {}", failures.join("\n  "));
    Ok((None, Loaded::default()))
}
