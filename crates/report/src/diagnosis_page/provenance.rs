//! Where a diagnosis comes from.

use crate::page::{Cell, Page};

/// What a diagnosis was made from.
#[derive(Debug, Clone, Default)]
pub struct Provenance {
    /// Program and version.
    pub program: String,
    /// Name of the robot.
    pub robot: String,
    /// How it is driven.
    pub causality: String,
    /// Mapping that read the recordings.
    pub mapping: String,
    /// Settings in force: name and value.
    pub options: Vec<(String, String)>,
    /// Files that were read.
    pub inputs: Vec<Input>,
    /// What was lost in reading, in sentences.
    pub lost: Vec<String>,
    /// What was there and was not used, in sentences.
    pub unused: Vec<String>,
}

/// A file that was read.
#[derive(Debug, Clone, Default)]
pub struct Input {
    /// What it was used as.
    pub part: String,
    /// Name.
    pub name: String,
    /// Length.
    pub bytes: usize,
    /// SHA-256 of its bytes.
    pub sha256: String,
}

/// Adds the section.
pub(super) fn add(page: &mut Page, from: &Provenance) {
    page.section("Provenance", "Where this comes from");
    page.note("The same files and settings give the same answer, on any machine.");
    let own = [
        ("program", &from.program),
        ("robot", &from.robot),
        ("causality", &from.causality),
        ("mapping", &from.mapping),
    ];
    let mut rows: Vec<Vec<Cell>> =
        own.iter().map(|(name, value)| vec![(*name).into(), value.as_str().into()]).collect();
    rows.extend(from.options.iter().map(|(name, value)| vec![name.as_str().into(), value.as_str().into()]));
    page.table_of_words(&["", ""], &rows);
    let row = |i: &Input| -> Vec<Cell> {
        vec![i.part.as_str().into(), i.name.as_str().into(), i.bytes.to_string().into(), i.sha256.as_str().into()]
    };
    let rows: Vec<Vec<Cell>> = from.inputs.iter().map(row).collect();
    if !rows.is_empty() {
        page.folded("Input files", &format!("{}, with SHA-256", rows.len()), false, |page| {
            page.table_of_words(&["used as", "file", "bytes", "SHA-256"], &rows);
        });
    }
    if !from.unused.is_empty() {
        page.folded("Not used", "columns and files that nothing asked for", false, |page| page.list(&from.unused));
    }
}
