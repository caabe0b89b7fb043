//! A diagnosis with all that it was made from, as JSON.

use anyhow::Result;
use diagnosis::{Diagnosis, Options};
use lacuna::case_folder::CaseFolder;
use recordings::Loss;
use serde_json::{Value, json};

use crate::commands::{Reading, program, sources};

/// Version of this envelope; the diagnosis inside has its own.
const FORMAT: u32 = 1;

/// What the diagnosis was made from.
pub(super) struct Provenance<'a> {
    pub(super) case: &'a CaseFolder,
    pub(super) lost: &'a [String],
    pub(super) options: &'a Options,
    pub(super) mapping: &'a str,
    pub(super) reading: Reading,
}

/// Everything. No clock and no machine in it: the same input gives the same text.
pub(super) fn render(diagnosis: &Diagnosis, from: &Provenance<'_>) -> Result<Value> {
    let (case, o) = (from.case, from.options);
    let parts = case.parts();
    let by_part = |f: &dyn Fn(&lacuna::inputs::Loaded) -> Value| -> Value {
        parts.iter().map(|(name, l)| ((*name).to_owned(), f(l))).collect()
    };
    let losses: Vec<Value> = parts.iter().flat_map(|(_, l)| &l.losses).map(loss).collect();
    let unmatched: Vec<&String> = parts.iter().flat_map(|(_, l)| &l.unmatched).collect();
    let ignored: Vec<&String> = parts.iter().flat_map(|(_, l)| &l.ignored).collect();
    let unused = parts.iter().flat_map(|(_, l)| &l.reads).flat_map(|r| &r.unused);
    let unused: Vec<Value> = unused.map(|u| json!({ "file": u.file, "column": u.column })).collect();
    Ok(json!({
        "format": FORMAT,
        "program": program(),
        "robot": { "name": case.robot.name, "causality": case.robot.causality.name() },
        "mapping": from.mapping,
        "options": {
            "reading": from.reading.name(),
            "step_s": o.step,
            "segment_s": o.segment,
            "temper": o.temper,
            "kappa": o.kappa,
        },
        "sources": by_part(&|l| sources(&l.sources).into()),
        "lost": from.lost,
        "losses": losses,
        "unmatched_files": unmatched,
        "ignored_files": ignored,
        "unused_columns": unused,
        "diagnosis": serde_json::to_value(diagnosis)?,
    }))
}

fn loss(l: &Loss) -> Value {
    json!({
        "kind": format!("{:?}", l.kind), "file": l.file, "column": l.column, "place": l.place.to_string(), "lines": l.lines,
        "count": l.count,
    })
}
