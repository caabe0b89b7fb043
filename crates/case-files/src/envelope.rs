//! A diagnosis with all that it was made from, as JSON: what `lacuna diagnose --json` writes and other commands read.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Context, Result, bail, ensure};
use inference::{KnownEffects, Options};
use recordings::Spot;
use robot_file::RobotSpec;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use verdict::{Diagnosis, LawOfFile};

use crate::TextError;
use crate::case_folder::CaseFolder;
use crate::columns::ColumnsEnvelope;

/// Version of the envelopes; the diagnosis inside has its own.
pub(crate) const FORMAT: u32 = 2;

/// A diagnosis with all that it was made from. No clock and no machine in it: the same input gives the same text.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Envelope {
    /// Version of this form.
    pub format: u32,
    /// What wrote it.
    pub program: Program,
    /// The robot file in the form of [`RobotSpec::to_json`].
    pub robot: Value,
    /// Mapping that read the recordings.
    pub mapping: String,
    /// Settings that were in force.
    pub options: Settings,
    /// Files by the part they play: reference, recordings, heldout.
    pub sources: BTreeMap<String, Vec<SourceFile>>,
    /// What was lost, in sentences.
    pub lost: Vec<String>,
    /// The same by kind, file and place.
    pub losses: Vec<Lost>,
    /// Files that no entry of the mapping fits.
    pub unmatched_files: Vec<String>,
    /// Other things in the folders.
    pub ignored_files: Vec<String>,
    /// Columns that the mapping does not use.
    pub unused_columns: Vec<UnusedColumn>,
    /// The answer.
    pub diagnosis: Diagnosis,
}

/// A program and its version.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Program {
    /// Name.
    pub name: String,
    /// Version.
    pub version: String,
}

impl Default for Program {
    /// This one.
    fn default() -> Self {
        Self { name: "lacuna".to_owned(), version: env!("CARGO_PKG_VERSION").to_owned() }
    }
}

/// Settings of a diagnosis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// What was done with bad rows and cells.
    pub reading: String,
    /// Integration step, s.
    pub step_s: f64,
    /// Length of a free run, s.
    pub segment_s: f64,
    /// Share of the log-likelihood that counts.
    #[serde(alias = "temper")]
    pub likelihood_power: f64,
    /// Saturation of outliers.
    #[serde(alias = "kappa")]
    pub outlier_scale: f64,
}

/// A file that was read.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct SourceFile {
    /// Name.
    pub name: String,
    /// Length.
    pub bytes: usize,
    /// SHA-256 of its bytes.
    pub sha256: String,
}

/// Something that was lost in reading.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Lost {
    /// What.
    pub kind: String,
    /// File.
    pub file: String,
    /// Column, where it was one.
    pub column: Option<String>,
    /// Where, in words.
    pub place: String,
    /// The first few places at which it happened.
    pub lines: Vec<u64>,
    /// How many.
    pub count: usize,
}

/// A column that the mapping does not use.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct UnusedColumn {
    /// File.
    pub file: String,
    /// Column.
    pub column: String,
}

/// A diagnosis of a robot of any kind, as `lacuna diagnose --json` writes it.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub enum Answered {
    /// Of a robot whose recordings were read with a mapping.
    Mapped(Box<Envelope>),
    /// Of a robot whose file names its columns.
    Columns(Box<ColumnsEnvelope>),
}

impl Answered {
    /// Opens what `lacuna diagnose --json` wrote.
    ///
    /// # Errors
    /// When the file cannot be read, or is no such file.
    pub fn open(file: &Path) -> Result<Self> {
        let (name, text) = read(file)?;
        if Version::of(&text).is_some_and(|version| version.kind.is_some()) {
            return Ok(Self::Columns(Box::new(parsed(&name, &text)?)));
        }
        Ok(Self::Mapped(Box::new(Envelope::parse(&name, &text)?)))
    }
}

/// Name and text of a verdict's file.
fn read(file: &Path) -> Result<(String, String)> {
    let shown = file.display().to_string();
    let text = std::fs::read_to_string(file)
        .with_context(|| format!("cannot read '{shown}'; `lacuna diagnose ... --json FILE` writes such a file"))?;
    Ok((shown, text))
}

/// Reads an envelope of either form; `name` is what messages call it.
fn parsed<T: DeserializeOwned>(name: &str, text: &str) -> Result<T> {
    let refused = |e: &serde_json::Error| {
        let message = e.to_string();
        let end = message.rfind(" at line ").unwrap_or(message.len());
        TextError {
            spot: Spot { file: name.to_owned(), at: Some((e.line().max(1) as u32, e.column().max(1) as u32)) },
            message: format!(
                "this is not what `lacuna diagnose --json` of version {} writes ({}); write it again",
                Program::default().version,
                &message[..end]
            ),
        }
    };
    if let Some(version) = Version::of(text) {
        version.ensure_readable(name)?;
    }
    Ok(serde_json::from_str(text).map_err(|e| refused(&e))?)
}

/// What any version of the envelope has.
#[derive(Deserialize)]
struct Version {
    format: u32,
    program: Program,
    /// Of a robot whose file names its columns.
    kind: Option<String>,
}

impl Version {
    fn of(text: &str) -> Option<Self> {
        serde_json::from_str(text).ok()
    }

    /// The one place that decides which formats are read.
    fn ensure_readable(&self, name: &str) -> Result<()> {
        let Self { format, program, .. } = self;
        ensure!(
            *format == FORMAT,
            "'{name}' holds a verdict of format {format}, written by {} {}, but this version reads format {FORMAT}: \
             run `lacuna diagnose ... --json '{name}'` again on the same recordings",
            program.name,
            program.version
        );
        Ok(())
    }
}

impl From<&recordings::Source> for SourceFile {
    fn from(s: &recordings::Source) -> Self {
        Self { name: s.name.clone(), bytes: s.bytes, sha256: s.sha256.clone() }
    }
}

impl Envelope {
    /// Packs a diagnosis with what it was made from.
    ///
    /// # Errors
    /// When a number of the robot cannot be written.
    pub fn new(
        diagnosis: Diagnosis,
        case: &CaseFolder,
        options: &Options,
        mapping: &str,
        reading: &str,
    ) -> Result<Self> {
        let parts = case.parts();
        let lost = |l: &recordings::Loss| Lost {
            kind: format!("{:?}", l.kind),
            file: l.file.clone(),
            column: l.column.clone(),
            place: l.place.to_string(),
            lines: l.lines.clone(),
            count: l.count,
        };
        let unused = parts.iter().flat_map(|(_, l)| &l.reads).flat_map(|r| &r.unused);
        Ok(Self {
            format: FORMAT,
            program: Program::default(),
            robot: case.robot.to_json()?,
            mapping: mapping.to_owned(),
            options: Settings {
                reading: reading.to_owned(),
                step_s: options.step,
                segment_s: options.segment,
                likelihood_power: options.likelihood_power,
                outlier_scale: options.outlier_scale,
            },
            sources: parts
                .iter()
                .map(|(name, l)| ((*name).to_owned(), l.sources.iter().map(SourceFile::from).collect()))
                .collect(),
            lost: case.lost(),
            losses: parts.iter().flat_map(|(_, l)| &l.losses).map(lost).collect(),
            unmatched_files: parts.iter().flat_map(|(_, l)| l.unmatched.clone()).collect(),
            ignored_files: parts.iter().flat_map(|(_, l)| l.ignored.clone()).collect(),
            unused_columns: unused.map(|u| UnusedColumn { file: u.file.clone(), column: u.column.clone() }).collect(),
            diagnosis,
        })
    }

    /// Opens what `lacuna diagnose --json` wrote.
    ///
    /// # Errors
    /// When the file cannot be read, or is no such file.
    pub fn open(file: &Path) -> Result<Self> {
        let (name, text) = read(file)?;
        Self::parse(&name, &text)
    }

    /// Reads the text that `lacuna diagnose --json` writes; `name` is what messages call it.
    ///
    /// # Errors
    /// When it is no such text, that of another version, or of a robot whose file names its columns.
    pub fn parse(name: &str, text: &str) -> Result<Self> {
        if let Some(kind) = Version::of(text).and_then(|version| version.kind) {
            bail!(
                "'{name}' holds a verdict of kind {kind}, which has no law of what is missing and no masses; \
                 `lacuna report '{name}' -o page.html` shows it, `lacuna export '{name}' --to toml` or `--to ros2` \
                 corrects the robot"
            );
        }
        parsed(name, text)
    }

    /// The robot that was diagnosed, as its file had it.
    ///
    /// # Errors
    /// When it is not what a robot file must be.
    pub fn robot(&self) -> Result<RobotSpec> {
        self.robot_with(KnownEffects::default())
    }

    /// The same where its effects may be some of one's own.
    ///
    /// # Errors
    /// As [`Envelope::robot`].
    pub fn robot_with(&self, known: KnownEffects) -> Result<RobotSpec> {
        Ok(RobotSpec::parse_with(known, "robot.json", &serde_json::to_string_pretty(&self.robot)?)?)
    }

    /// Refuses a verdict whose correction holds effects of files that are not known.
    ///
    /// # Errors
    /// The first of them, with its formula.
    pub fn ensure_known(&self, known: KnownEffects) -> Result<()> {
        let named = |law: &&LawOfFile| self.diagnosis.correction.effects.iter().any(|e| e.effect == law.name);
        for LawOfFile { name, formula, .. } in self.diagnosis.own_effects.iter().filter(named) {
            ensure!(
                known.find(name).is_ok(),
                "this verdict names '{name}', an effect of a file ({formula}): add --effects {name}.toml, or --adopt where it was adopted"
            );
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use serde_json::{from_value, json, to_value};
    use verdict::Diagnosis;

    use super::{Envelope, Settings};

    #[test]
    fn names_that_older_verdicts_use_are_read() {
        let mut older = to_value(Diagnosis::withheld()).expect("JSON");
        let fields = older.as_object_mut().expect("an object");
        fields.remove("null_scores").expect("today's name");
        fields.insert("accusations".to_owned(), json!([["grade", 1.5]]));
        let read: Diagnosis = from_value(older).expect("reads");
        assert_eq!(read.null_scores, [("grade".to_owned(), 1.5)]);

        let older = json!({ "reading": "strict", "step_s": 0.001, "segment_s": 2.0, "temper": 0.15, "kappa": 3.0 });
        let read: Settings = from_value(older).expect("reads");
        assert_eq!((read.likelihood_power, read.outlier_scale), (0.15, 3.0));
    }

    #[test]
    fn a_verdict_of_another_format_is_refused_with_the_remedy() {
        let text = r#"{ "format": 1, "program": { "name": "lacuna", "version": "0.0.9" }, "robot": {} }"#;
        let error = Envelope::parse("old.json", text).expect_err("refused").to_string();
        assert!(error.contains("'old.json' holds a verdict of format 1, written by lacuna 0.0.9"), "{error}");
        assert!(error.contains("reads format 2: run `lacuna diagnose"), "{error}");
    }
}
