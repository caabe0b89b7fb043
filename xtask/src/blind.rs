//! `cargo xtask blind`: diagnoses case folders whose truth it does not see and writes answers for the scorer.

use std::fs;
use std::path::PathBuf;
use std::time::Instant;

use anyhow::{Context, Result};
use clap::Args as ClapArgs;
use lacuna::{answers, case_folder};
use recordings::ReadOptions;

/// Arguments of `cargo xtask blind`.
#[derive(Debug, ClapArgs)]
pub(crate) struct Args {
    /// Folder of unpacked cases, one folder each.
    #[arg(long)]
    cases: PathBuf,
    /// Folder for answers and held-out predictions.
    #[arg(long)]
    answers: PathBuf,
    /// Only these cases.
    #[arg(long, value_delimiter = ',')]
    only: Vec<String>,
}

/// Diagnoses every case; a case that fails is named and does not stop the others.
pub(crate) fn run(args: &Args) -> Result<bool> {
    let mut folders: Vec<PathBuf> = fs::read_dir(&args.cases)
        .with_context(|| format!("cannot list '{}'", args.cases.display()))?
        .filter_map(|e| e.ok().map(|e| e.path()))
        .filter(|p| p.is_dir())
        .collect();
    folders.sort();
    let mapping = case_folder::mapping("skid-steer-columns")?;
    let mut failed = 0;
    for folder in &folders {
        let name = folder.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
        if !args.only.is_empty() && !args.only.contains(&name) {
            continue;
        }
        let start = Instant::now();
        let outcome = (|| -> Result<diagnosis::Diagnosis> {
            let case =
                case_folder::CaseFolder::open(folder, None, &mapping, &ReadOptions::default())?.torque_driven()?;
            Ok(diagnosis::diagnose(&case, &diagnosis::Options::default(), &|_| ())?)
        })();
        let seconds = start.elapsed().as_secs_f64();
        match outcome {
            Ok(d) => {
                answers::write(&args.answers, &name, &d, seconds)?;
                let whole = args.answers.join(&name).join("diagnosis.json");
                fs::write(&whole, serde_json::to_string_pretty(&d)?)
                    .with_context(|| format!("cannot write '{}'", whole.display()))?;
                println!("{name}  {seconds:5.1} s  {}", d.sentences.first().map_or("", String::as_str));
            }
            Err(e) => {
                failed += 1;
                eprintln!("{name}: {e:#}");
            }
        }
    }
    println!("{failed} of {} cases failed", folders.len());
    Ok(failed == 0)
}
