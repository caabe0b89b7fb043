//! `cargo xtask evidence`: real recordings with the effect concealed.
//!
//! The shipped program is asked about neutral copies that hold only what it may see; every verdict is written with its
//! SHA-256 before a label or a witness is opened. The protocol is in `docs/evidence.md`.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};
use clap::Args as ClapArgs;
use rayon::prelude::*;

use crate::{binary, output};

mod ask;
mod blocks;
mod drive;
pub mod drive_layout;
mod figures;
mod find;
mod hide;
mod husky;
mod kobuki;
mod slopes;
mod tables;
mod turns;
mod witness;

use find::{DataRun, Kind};
use hide::Sight;

const EXAMPLES: &str = "\
Examples:
  cargo xtask evidence                                   all protocols on the open data, if it lies beside the project
  cargo xtask evidence --data DIR --reference DIR        other recordings; the reference runs are where nothing is missing
  cargo xtask evidence --case ASPHALT_00                 one recording
  cargo xtask evidence --judge                           fails when a target is missed

DIR holds the data sets as published, or a folder per recording with any name (case-07/pro.csv, case-07/imu.csv).";

/// Label of the runs in which the simulation is taken to be right, where none are named.
const REFERENCE: &str = "FLOORING";
/// The open data beside the project.
const OPEN: &str = "../shared/data";

/// Arguments of `cargo xtask evidence`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// Folder of recordings [default: ../shared/data].
    #[arg(long, value_name = "DIR")]
    data: Option<PathBuf>,
    /// Folder of the runs in which the simulation is right [default: those labelled FLOORING].
    #[arg(long, value_name = "DIR")]
    reference: Option<PathBuf>,
    /// Folder for everything that is written [default: target/evidence].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Only these recordings, by name.
    #[arg(long, value_name = "ID", value_delimiter = ',')]
    case: Vec<String>,
    /// Write docs/evidence.md and its pictures as well.
    #[arg(long)]
    docs: bool,
    /// Fail when a target is missed.
    #[arg(long)]
    judge: bool,
}

/// Everything that was found out.
#[derive(Default)]
struct Evidence {
    husky: Vec<husky::Examined>,
    null: Vec<blocks::Block>,
    joined: Vec<blocks::Joined>,
    kobuki: Vec<kobuki::Examined>,
    drive: Vec<drive::Examined>,
    failed: Vec<String>,
}

/// Runs the command; true if every recording was read and, when judged, no target was missed.
pub(crate) fn run(args: &Args) -> Result<bool> {
    let data = args.data.clone().unwrap_or_else(|| output::beside(OPEN));
    if args.data.is_none() && !data.is_dir() {
        println!("SKIPPED: there is no data in {OPEN}; name a folder with --data");
        return Ok(true);
    }
    let all = find::find(&data)?;
    let chosen: Vec<&DataRun> = all.iter().filter(|f| args.case.is_empty() || args.case.contains(&f.name)).collect();
    let unknown = args.case.iter().any(|name| !all.iter().any(|f| f.name == *name));
    ensure!(!chosen.is_empty() && !unknown, "{}", nothing(&all, &data, &args.case));
    let out = match &args.out {
        Some(folder) => folder.clone(),
        None => output::folder("evidence")?,
    };
    std::fs::create_dir_all(&out).with_context(|| format!("cannot create '{}'", out.display()))?;
    let references = references(args.reference.as_deref(), &all, &chosen)?;
    let named = args.reference.as_deref().map(find::find).transpose()?.unwrap_or_default();
    let evidence = examine(&chosen, &references, &named, args.case.is_empty(), &out)?;
    for failed in &evidence.failed {
        eprintln!("error: {failed}");
    }
    let figures = figures::figures(&evidence);
    tables::write(&evidence, &figures, &out, args.docs)?;

    let missed: Vec<&str> = figures.iter().filter(|f| f.pass == Some(false)).map(|f| f.name.as_str()).collect();
    if args.judge && !missed.is_empty() {
        eprintln!("targets missed: {}", missed.join("; "));
    }
    Ok(evidence.failed.is_empty() && (missed.is_empty() || !args.judge))
}

/// Why nothing can be done.
fn nothing(all: &[DataRun], data: &Path, asked: &[String]) -> String {
    let names: Vec<&str> = all.iter().map(|f| f.name.as_str()).collect();
    if names.is_empty() {
        return format!("'{}' holds no recording that is known here", data.display());
    }
    format!("asked for {}; there are {}", asked.join(", "), names.join(", "))
}

/// Runs in which the simulation is taken to be right: those named, else those labelled so in the data, else in the
/// open data.
fn references(named: Option<&Path>, all: &[DataRun], chosen: &[&DataRun]) -> Result<Vec<husky::Run>> {
    if !chosen.iter().any(|f| f.husky().is_some()) {
        return Ok(Vec::new());
    }
    let husky = |list: Vec<DataRun>| list.into_iter().filter(|f| f.husky().is_some()).collect::<Vec<_>>();
    let labelled = |list: &[DataRun]| husky(list.iter().filter(|f| f.label == REFERENCE).cloned().collect());
    let mut found = match named {
        Some(folder) => husky(find::find(folder)?),
        None => labelled(all),
    };
    let open = output::beside(OPEN);
    if found.is_empty() && named.is_none() && open.is_dir() {
        found = labelled(&find::find(&open)?);
    }
    ensure!(
        !found.is_empty(),
        "no reference runs: name the folder of the runs in which the simulation is right with --reference"
    );
    found.iter().map(husky::Run::read).collect()
}

fn examine(
    chosen: &[&DataRun],
    references: &[husky::Run],
    named: &[DataRun],
    whole: bool,
    out: &Path,
) -> Result<Evidence> {
    let binary = binary::find()?;
    let mut runs: Vec<husky::Run> = Vec::new();
    for found in chosen.iter().filter(|f| f.husky().is_some()) {
        runs.push(husky::Run::read(found)?);
    }
    for sight in [Sight::Yaw, Sight::Gyro, Sight::All, Sight::Currents] {
        husky::mapping(out, sight)?;
        for run in runs.iter().chain(references) {
            run.show(out, sight)?;
        }
    }
    let references: Vec<&husky::Run> = references.iter().collect();
    let mut evidence = Evidence::default();
    let bar = output::progress(chosen.len() as u64, "recordings")?;
    let husky: Vec<_> = runs
        .par_iter()
        .map(|run| {
            let done = husky::examine(&binary, run, &references, out).with_context(|| run.found.name.clone());
            bar.inc(1);
            done
        })
        .collect();
    sort(husky, &mut evidence.husky, &mut evidence.failed);
    let small = chosen.iter().filter(|f| matches!(f.kind, Kind::KobukiBag(_) | Kind::KobukiTable { .. }));
    let kobuki = small.map(|f| kobuki::examine(&binary, f, out).with_context(|| f.name.clone())).collect();
    sort(kobuki, &mut evidence.kobuki, &mut evidence.failed);
    let drives = chosen.iter().filter(|f| matches!(f.kind, Kind::Drive(_)));
    let drives = drives.map(|f| drive::examine(&binary, f, named, out).with_context(|| f.name.clone())).collect();
    sort(drives, &mut evidence.drive, &mut evidence.failed);
    if whole && references.len() > 1 {
        // What fails here must not cost the rest.
        let null = blocks::null(&binary, &references, out).context("blocks of the references");
        let joined = joins(&binary, &runs, &references, &evidence.husky, out).context("joined runs");
        match (null, joined) {
            (Ok(null), Ok(joined)) => (evidence.null, evidence.joined) = (null, joined),
            (null, joined) => {
                let errors = [null.err(), joined.err()].into_iter().flatten();
                evidence.failed.extend(errors.map(|e| format!("{e:#}")));
            }
        }
    }
    bar.finish_and_clear();
    Ok(evidence)
}

/// The longest reference in which nothing changes, joined with every other run.
fn joins(
    binary: &binary::Binary,
    runs: &[husky::Run],
    references: &[&husky::Run],
    examined: &[husky::Examined],
    out: &Path,
) -> Result<Vec<blocks::Joined>> {
    let changes = |r: &husky::Run| {
        let own = examined.iter().find(|e| e.name == r.found.name);
        own.is_some_and(|e| !e.open.changes("found").is_empty())
    };
    let calm = references.iter().filter(|r| !changes(r));
    let Some(first) = calm.max_by_key(|r| r.speeds.rows.len()) else { return Ok(Vec::new()) };
    runs.par_iter().filter(|r| r.id != first.id).map(|r| blocks::joined(binary, first, r, references, out)).collect()
}

/// Successes and what failed.
fn sort<T>(all: Vec<Result<T>>, good: &mut Vec<T>, failed: &mut Vec<String>) {
    for one in all {
        match one {
            Ok(x) => good.push(x),
            Err(error) => failed.push(format!("{error:#}")),
        }
    }
}
