//! Given case folders, whose truth is elsewhere: diagnoses them and writes answers for a scorer.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{Context, Result};
use case_files::answers::Answer;
use case_files::{case_folder, predictions};
use recordings::ReadOptions;

use crate::output::{self, Figure};

/// Diagnoses every case; a case that fails is named and does not stop the others.
pub(super) fn run(cases: &Path, answers: &Path, only: &[String]) -> Result<bool> {
    let mut folders: Vec<PathBuf> = fs::read_dir(cases)
        .with_context(|| format!("cannot list '{}'", cases.display()))?
        .filter_map(|e| e.ok().map(|e| e.path()))
        .filter(|p| p.is_dir())
        .collect();
    folders.sort();
    let mapping = case_folder::mapping("skid-steer-columns")?;
    let mut failed = 0;
    let mut times = Vec::new();
    for folder in &folders {
        let name = folder.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
        if !only.is_empty() && !only.contains(&name) {
            continue;
        }
        let start = Instant::now();
        let outcome = (|| -> Result<verdict::Diagnosis> {
            let case =
                case_folder::CaseFolder::open(folder, None, &mapping, &ReadOptions::default())?.torque_driven()?;
            Ok(torque_driven::diagnose(&case, &inference::Options::default(), &|_| ())?)
        })();
        let seconds = start.elapsed().as_secs_f64();
        times.push(seconds);
        match outcome {
            Ok(d) => {
                Answer::of(&d)?.write(answers, &name, seconds)?;
                predictions::write(&answers.join(&name), &d)?;
                let whole = answers.join(&name).join("diagnosis.json");
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
    println!("{failed} of {} cases failed", times.len());
    times.sort_by(f64::total_cmp);
    let folder = output::folder("blind")?;
    output::write(&folder, "summary.json", &serde_json::to_string_pretty(&summary(&times, failed))?)?;
    Ok(failed == 0)
}

/// What the run itself measured; right and wrong are the scorer's.
fn summary(times: &[f64], failed: usize) -> Vec<Figure> {
    let mut out = vec![Figure::free("cases", times.len() as f64, "")];
    out.push(Figure {
        target: Some("0".to_owned()),
        pass: Some(failed == 0),
        ..Figure::free("cases that failed", failed as f64, "")
    });
    if let (Some(median), Some(longest)) = (times.get(times.len() / 2), times.last()) {
        out.push(Figure::free("time of a case, median", *median, "s"));
        out.push(Figure::free("time of a case, longest", *longest, "s"));
    }
    out
}
