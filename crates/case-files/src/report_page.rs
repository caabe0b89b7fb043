//! A diagnosis with its provenance as a page: one file that opens in any browser and needs no network.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::Result;
use report::diagnosis_page::{Input, Provenance, render};
use serde_json::Value;

use crate::columns::ColumnsEnvelope;
use crate::envelope::{Answered, Envelope, Program, SourceFile};

/// The page of what `lacuna diagnose --json` wrote, of a robot of any kind.
///
/// # Errors
/// When the file cannot be read, or is no such file.
pub fn page_of_file(file: &Path) -> Result<String> {
    Ok(match Answered::open(file)? {
        Answered::Mapped(envelope) => page(&envelope),
        Answered::Columns(envelope) => page_of_columns(&envelope),
    })
}

/// The page of a diagnosis.
pub fn page(envelope: &Envelope) -> String {
    render(&envelope.diagnosis, &provenance(envelope))
}

/// The page of a diagnosis of a robot whose file names its columns.
pub fn page_of_columns(e: &ColumnsEnvelope) -> String {
    let from = Provenance {
        program: version(&e.program),
        robot: e.robot.clone(),
        causality: e.kind.compares().to_owned(),
        mapping: format!("[columns] of {}", e.robot),
        inputs: inputs(&e.sources),
        unused: unused(&e.ignored_files, NO_RECORDING),
        ..Provenance::default()
    };
    render(&e.diagnosis, &from)
}

/// Why a file in a folder of recordings was not read.
const NO_RECORDING: &str = "no recording";

fn version(program: &Program) -> String {
    format!("{} {}", program.name, program.version)
}

fn inputs(sources: &BTreeMap<String, Vec<SourceFile>>) -> Vec<Input> {
    let input = |part: &String, s: &SourceFile| Input {
        part: part.clone(),
        name: s.name.clone(),
        bytes: s.bytes,
        sha256: s.sha256.clone(),
    };
    sources.iter().flat_map(|(part, all)| all.iter().map(move |s| input(part, s))).collect()
}

fn unused(files: &[String], why: &str) -> Vec<String> {
    files.iter().map(|f| format!("{f}: {why}")).collect()
}

fn provenance(e: &Envelope) -> Provenance {
    let of_robot = |key: &str| e.robot.get(key).and_then(Value::as_str).unwrap_or_default().to_owned();
    let o = &e.options;
    let numbers = [
        ("integration step, s", o.step_s),
        ("length of a free run, s", o.segment_s),
        ("likelihood_power", o.likelihood_power),
        ("outlier_scale", o.outlier_scale),
    ];
    let mut options = vec![("reading of bad rows".to_owned(), o.reading.clone())];
    options.extend(numbers.map(|(name, value)| (name.to_owned(), value.to_string())));
    let mut not_used = unused(&e.unmatched_files, "no entry of the mapping fits");
    not_used.extend(unused(&e.ignored_files, NO_RECORDING));
    not_used.extend(e.unused_columns.iter().map(|u| format!("{}: column {}", u.file, u.column)));
    Provenance {
        program: version(&e.program),
        robot: of_robot("name"),
        causality: of_robot("causality"),
        mapping: e.mapping.clone(),
        options,
        inputs: inputs(&e.sources),
        lost: e.lost.clone(),
        unused: not_used,
    }
}
