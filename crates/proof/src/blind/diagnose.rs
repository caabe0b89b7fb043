//! Diagnoses drawn cases with the shipped program, each in a process of its own.

use std::fs::{self, File};
use std::path::Path;
use std::process::{Command, Stdio};

use anyhow::{Context, Result, bail};
use case_files::answers::Answer;
use examiner::Plan;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::draw::clear;
use super::layout::Layout;
use super::seal::{Seal, Seals};
use crate::binary::Binary;
use crate::child;
use crate::output;

/// Exit codes of `lacuna diagnose` with an answer: done, and done although some input was lost.
const ANSWERED: [i32; 2] = [0, 3];
/// File in the folder of a run that says how it went; written last.
const RECORD: &str = "run.json";
/// File for what the program says on standard error.
const COMPLAINTS: &str = "stderr.txt";

/// How a case was diagnosed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Record {
    /// What was diagnosed.
    seal: String,
    /// SHA-256 of the program that did.
    binary: String,
    /// Time that it took by the clock, s.
    pub(super) seconds: f64,
    /// The part of it that the program was on its core, s, where the system tells; the rest is the load of the machine.
    pub(super) processor_seconds: Option<f64>,
    /// Most memory that it held, bytes, where the system tells.
    pub(super) peak_memory: Option<u64>,
}

/// Diagnoses what was not diagnosed before. A case that fails is named and does not stop the others.
pub(super) fn all(
    plans: &[&Plan],
    layout: &Layout,
    seals: &Seals,
    binary: &Binary,
    fresh: bool,
) -> Result<Vec<Result<Record>>> {
    let bar = output::progress(plans.len() as u64, "cases diagnosed")?;
    let outcomes = plans
        .par_iter()
        .map(|plan| {
            let name = plan.name.as_str();
            let outcome = seals.of(name).and_then(|seal| one(name, seal, layout, binary, fresh));
            if let Err(e) = &outcome {
                bar.suspend(|| eprintln!("{name}: {e:#}"));
            }
            bar.inc(1);
            outcome
        })
        .collect();
    bar.finish_and_clear();
    Ok(outcomes)
}

fn one(name: &str, seal: &Seal, layout: &Layout, binary: &Binary, fresh: bool) -> Result<Record> {
    let digest = seal.digest();
    let folder = layout.run(name);
    let same = |record: &Record| record.seal == digest && record.binary == binary.sha256;
    if let Some(record) = before(name, layout).filter(same).filter(|_| !fresh) {
        return Ok(record);
    }
    seal.check_case(layout, name)?;
    // Nothing of an earlier diagnosis may stand beside this one, should it fail.
    for stale in [&folder, &layout.predictions(name), &layout.answer(name)] {
        clear(stale)?;
    }
    fs::create_dir_all(&folder).with_context(|| format!("cannot create '{}'", folder.display()))?;
    let complaints = folder.join(COMPLAINTS);
    let stderr = File::create(&complaints).with_context(|| format!("cannot write '{}'", complaints.display()))?;
    let diagnosis = layout.diagnosis(name);
    let ended = child::run(
        Command::new(&binary.path)
            .arg("diagnose")
            .arg(layout.case(name))
            .arg("--json")
            .arg(&diagnosis)
            .arg("--predictions")
            .arg(layout.predictions(name))
            // One core each, and no more processes than cores.
            .env("RAYON_NUM_THREADS", "1")
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(stderr),
    )?;
    if !ended.status.code().is_some_and(|code| ANSWERED.contains(&code)) {
        let said = fs::read_to_string(&complaints).unwrap_or_default();
        bail!("lacuna ended with {}: {}", ended.status, said.trim());
    }
    answer(&diagnosis)?.write(&layout.answers(), name, ended.seconds)?;
    let record = Record {
        seal: digest,
        binary: binary.sha256.clone(),
        seconds: ended.seconds,
        processor_seconds: ended.processor,
        peak_memory: ended.memory,
    };
    output::write(&folder, RECORD, &serde_json::to_string_pretty(&record)?)?;
    Ok(record)
}

/// How the case was diagnosed before, if all that it left is there.
fn before(name: &str, layout: &Layout) -> Option<Record> {
    let there = layout.answer(name).is_file() && layout.predictions(name).is_dir() && layout.diagnosis(name).is_file();
    let text = fs::read_to_string(layout.run(name).join(RECORD)).ok().filter(|_| there)?;
    serde_json::from_str(&text).ok()
}

/// What a diagnosis says.
pub(super) fn answer(path: &Path) -> Result<Answer> {
    let text = fs::read_to_string(path).with_context(|| format!("cannot read '{}'", path.display()))?;
    Answer::read(&text).with_context(|| format!("'{}'", path.display()))
}
