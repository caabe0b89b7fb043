//! A diagnosis with its provenance as a page.

use report::diagnosis_page::{Input, Provenance, render};
use serde_json::Value;

use crate::envelope::{Envelope, SourceFile};

/// The page: one file that opens in any browser and needs no network.
pub fn page(envelope: &Envelope) -> String {
    render(&envelope.diagnosis, &provenance(envelope))
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
    let input = |part: &String, s: &SourceFile| Input {
        part: part.clone(),
        name: s.name.clone(),
        bytes: s.bytes,
        sha256: s.sha256.clone(),
    };
    let files = |all: &[String], why: &str| all.iter().map(|f| format!("{f}: {why}")).collect::<Vec<_>>();
    let mut unused = files(&e.unmatched_files, "no entry of the mapping fits");
    unused.extend(files(&e.ignored_files, "no recording"));
    unused.extend(e.unused_columns.iter().map(|u| format!("{}: column {}", u.file, u.column)));
    Provenance {
        program: format!("{} {}", e.program.name, e.program.version),
        robot: of_robot("name"),
        causality: of_robot("causality"),
        mapping: e.mapping.clone(),
        options,
        inputs: e.sources.iter().flat_map(|(part, all)| all.iter().map(move |s| input(part, s))).collect(),
        lost: e.lost.clone(),
        unused,
    }
}
