//! Asks the shipped program, and seals what it said before anything is opened.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result};
use serde_json::{Value, json};

use crate::binary::Binary;

/// What the program is given.
pub(super) struct Question<'a> {
    pub(super) robot: &'a str,
    pub(super) mapping: &'a Path,
    pub(super) references: &'a [PathBuf],
    pub(super) recordings: &'a [PathBuf],
    /// Recordings that no fit may see.
    pub(super) held_out: &'a [PathBuf],
}

/// What the program said.
#[derive(Debug, Clone)]
pub(super) struct Answer {
    /// Its sentences; why it refused, where it did.
    pub(super) sentences: Vec<String>,
    /// The diagnosis as JSON; null where it refused.
    pub(super) diagnosis: Value,
    /// SHA-256 of the file of the verdict.
    pub(super) sha256: String,
}

impl Answer {
    /// For the summary.
    pub(super) fn seal(&self) -> Value {
        json!({ "sentences": self.sentences, "verdict_sha256": self.sha256 })
    }

    /// A list inside the diagnosis of steady loads.
    pub(super) fn steady(&self, what: &str) -> &[Value] {
        self.diagnosis["steady"][what].as_array().map_or(&[], Vec::as_slice)
    }

    /// A list of the changes in time.
    pub(super) fn changes(&self, what: &str) -> &[Value] {
        self.diagnosis["steady"]["changes"][what].as_array().map_or(&[], Vec::as_slice)
    }
}

/// An interval in JSON.
pub(super) fn interval(v: &Value) -> [f64; 2] {
    [v[0].as_f64().unwrap_or(f64::NAN), v[1].as_f64().unwrap_or(f64::NAN)]
}

/// Runs `lacuna diagnose`, writes `verdict` and its SHA-256 beside it.
pub(super) fn ask(binary: &Binary, question: &Question<'_>, verdict: &Path) -> Result<Answer> {
    if let Some(folder) = verdict.parent() {
        fs::create_dir_all(folder).with_context(|| format!("cannot create '{}'", folder.display()))?;
    }
    let mut command = Command::new(&binary.path);
    command.args(["diagnose", "--robot", question.robot, "--mapping"]).arg(question.mapping);
    if !question.references.is_empty() {
        command.arg("--reference").args(question.references);
    }
    command.arg("--recordings").args(question.recordings);
    if !question.held_out.is_empty() {
        command.arg("--heldout").args(question.held_out);
    }
    command.arg("--json").arg(verdict);
    let ended = command.output().with_context(|| format!("cannot start '{}'", binary.path.display()))?;
    if !verdict.is_file() || !matches!(ended.status.code(), Some(0 | 3)) {
        // A refusal is an answer, too.
        let why = String::from_utf8_lossy(&ended.stderr).trim().to_owned();
        let text = serde_json::to_string_pretty(&json!({ "refused": why }))? + "\n";
        fs::write(verdict, text).with_context(|| format!("cannot write '{}'", verdict.display()))?;
    }
    let text = fs::read(verdict).with_context(|| format!("cannot read '{}'", verdict.display()))?;
    let sha256 = examiner::sha256(&text);
    let beside = verdict.with_extension("json.sha256");
    fs::write(&beside, format!("{sha256}\n")).with_context(|| format!("cannot write '{}'", beside.display()))?;
    let value: Value = serde_json::from_slice(&text).with_context(|| format!("'{}'", verdict.display()))?;
    let strings = |v: &Value| -> Vec<String> {
        v.as_array().map_or_else(Vec::new, |all| all.iter().filter_map(Value::as_str).map(str::to_owned).collect())
    };
    let sentences = match value["refused"].as_str() {
        Some(why) => vec![why.to_owned()],
        None => strings(&value["diagnosis"]["sentences"]),
    };
    Ok(Answer { sentences, diagnosis: value["diagnosis"].clone(), sha256 })
}
