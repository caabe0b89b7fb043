//! What is kept of a unit: one row of the table.

use std::collections::BTreeMap;
use std::path::PathBuf;

use case_files::envelope::{Answered, Program};
use recordings::Recording;
use report::words::{NINETY, is_no_cause};
use serde::{Deserialize, Serialize};
use verdict::{Cause, Coverage, Diagnosis, Verdict};

use super::FORMAT;
use super::date::Date;
use super::unit::Unit;

/// Causes that a row has room for: the likeliest.
pub const CAUSES: usize = 3;

/// How a unit ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// There is an answer, which may be that none is permitted.
    Done,
    /// There is none; `error` says why.
    Failed,
}

impl Outcome {
    /// As in the table.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Done => "done",
            Self::Failed => "failed",
        }
    }
}

/// A cause in a row.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RowCause {
    /// Effect id.
    pub effect: String,
    /// Name for people.
    pub name: String,
    /// `left` or `right`, when it sits on one side.
    pub side: Option<String>,
    /// Probability that it is part of the truth.
    pub probability: f64,
    /// Size in `unit`.
    pub magnitude: Option<f64>,
    /// Lower end of the size's 90 % interval.
    pub low: Option<f64>,
    /// Upper end.
    pub high: Option<f64>,
    /// Unit of the size.
    pub unit: String,
    /// Where on the ground, when it is a place: x, y, radius in m.
    pub place: Option<[f64; 3]>,
    /// First and last instant at which it was present, s; none when it was there all the time.
    pub when: Option<[f64; 2]>,
}

/// A file that was read.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct RowSource {
    /// `recordings` or `reference`.
    pub part: String,
    /// Name.
    pub name: String,
    /// SHA-256 of its bytes.
    pub sha256: String,
}

/// One row of the table.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Version of this form.
    pub format: u32,
    /// Version of the program that diagnosed.
    pub version: String,
    /// Hash of all that the answer depends on.
    pub key: String,
    /// Name of the unit.
    pub id: String,
    /// Its files as they were given.
    pub recording: Vec<String>,
    /// Which vehicle.
    pub robot_id: String,
    /// Name in the robot file; empty if that could not be read.
    pub robot: String,
    /// When it was recorded, as somebody says or as its stamps tell.
    pub date: Option<Date>,
    /// When its stamps say that it was recorded.
    pub stamped: Option<Date>,
    /// What drives the robot.
    pub causality: Option<String>,
    /// Mapping that read the recording.
    pub mapping: Option<String>,
    /// From the first sample to the last, s.
    pub duration_s: Option<f64>,
    /// Samples of the channel that has most.
    pub rows: Option<u64>,
    /// How it ended.
    pub outcome: Outcome,
    /// Why there is no answer.
    pub error: Option<String>,
    /// Kind of answer.
    pub verdict: Option<Verdict>,
    /// Probability of the answer: of the likeliest cause, of "nothing is missing", or of "not in the catalogue".
    pub probability: Option<f64>,
    /// The answer in sentences.
    pub sentences: Vec<String>,
    /// The likeliest causes.
    pub causes: Vec<RowCause>,
    /// Everything that was weighed: effect ids, `none` and `unknown`, with their probabilities.
    pub probabilities: Vec<(String, f64)>,
    /// What limits the answer.
    pub limits: Vec<String>,
    /// What was lost in reading, in sentences.
    pub lost: Vec<String>,
    /// Files that were read.
    pub sources: Vec<RowSource>,
    /// The whole answer, relative to the folder of the table.
    pub json: Option<String>,
}

/// What is known of a recording beside its answer.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Measured {
    duration_s: Option<f64>,
    rows: Option<u64>,
    stamped: Option<Date>,
}

impl Measured {
    /// Of a drive of such a length, s, whose stamps tell no date.
    pub(crate) fn of_duration(duration_s: Option<f64>) -> Self {
        Self { duration_s, ..Self::default() }
    }

    /// Of a recording, or of the first stretch of a long one that was screened.
    pub(crate) fn of(recording: &Recording, screened: Option<&Coverage>) -> Self {
        let spans: Vec<(i64, i64)> = (0..recording.clocks().len()).filter_map(|c| recording.span_ns(c)).collect();
        Self {
            duration_s: match screened {
                Some(coverage) => Some(coverage.screened),
                None => spans.iter().map(|(from, to)| (to - from) as f64 * 1e-9).reduce(f64::max),
            },
            rows: recording.channels().iter().map(|c| c.len() as u64).max().filter(|_| screened.is_none()),
            stamped: spans.iter().filter_map(|(from, _)| Date::of_stamp(*from)).min(),
        }
    }
}

impl Row {
    /// A unit without an answer.
    pub(crate) fn failed(unit: &Unit, key: &str, robot: &str, error: String) -> Self {
        Self {
            format: FORMAT,
            version: Program::default().version,
            key: key.to_owned(),
            id: unit.id.clone(),
            recording: unit.recording.iter().map(|p: &PathBuf| p.display().to_string()).collect(),
            robot_id: unit.robot_id.clone().unwrap_or_else(|| robot.to_owned()),
            robot: robot.to_owned(),
            date: unit.date,
            stamped: None,
            causality: None,
            mapping: None,
            duration_s: None,
            rows: None,
            outcome: Outcome::Failed,
            error: Some(error),
            verdict: None,
            probability: None,
            sentences: Vec::new(),
            causes: Vec::new(),
            probabilities: Vec::new(),
            limits: Vec::new(),
            lost: Vec::new(),
            sources: Vec::new(),
            json: None,
        }
    }

    /// A unit with its answer.
    pub(crate) fn done(unit: &Unit, key: &str, robot: &str, measured: Measured, answered: &Answered) -> Self {
        let (d, sources) = match answered {
            Answered::Mapped(envelope) => (&envelope.diagnosis, &envelope.sources),
            Answered::Columns(envelope) => (&envelope.diagnosis, &envelope.sources),
        };
        let (causality, mapping, lost) = match answered {
            Answered::Mapped(envelope) => {
                let causality = envelope.robot.get("causality").and_then(|v| v.as_str()).map(str::to_owned);
                (causality, Some(envelope.mapping.clone()), envelope.lost.clone())
            }
            Answered::Columns(envelope) => (Some(envelope.kind.name().to_owned()), None, Vec::new()),
        };
        let sources = sources.iter().flat_map(|(part, files)| files.iter().map(move |f| (part, f)));
        Self {
            date: unit.date.or(measured.stamped),
            stamped: measured.stamped,
            causality,
            mapping,
            duration_s: measured.duration_s,
            rows: measured.rows,
            outcome: Outcome::Done,
            error: None,
            verdict: Some(d.verdict),
            probability: probability(d),
            sentences: d.sentences.clone(),
            causes: d.ranked.iter().filter(|c| !is_no_cause(c)).take(CAUSES).map(RowCause::of).collect(),
            probabilities: d.ranked.iter().map(|c| (c.effect.clone(), c.probability)).collect(),
            limits: d.limits.clone(),
            lost,
            sources: sources
                .map(|(part, f)| RowSource { part: part.clone(), name: f.name.clone(), sha256: f.sha256.clone() })
                .collect(),
            ..Self::failed(unit, key, robot, String::new())
        }
    }

    /// The same with the labels that the unit has now: they are no part of what the answer depends on.
    pub(crate) fn labelled(&self, unit: &Unit) -> Self {
        Self {
            robot_id: unit.robot_id.clone().unwrap_or_else(|| self.robot.clone()),
            date: unit.date.or(self.stamped),
            recording: unit.recording.iter().map(|p| p.display().to_string()).collect(),
            ..self.clone()
        }
    }

    /// Whether two rows of a unit say the same, wherever its files lay.
    pub(crate) fn agrees_with(&self, other: &Self) -> bool {
        self.outcome == other.outcome
            && self.verdict == other.verdict
            && self.causes == other.causes
            && self.probabilities == other.probabilities
    }
}

impl RowCause {
    fn of(c: &Cause) -> Self {
        let half = c.sigma.map(|s| NINETY * s).filter(|h| h.is_finite());
        let end = |sign: f64| Some(c.magnitude? + sign * half?);
        Self {
            effect: c.effect.clone(),
            name: c.name.clone(),
            side: c.side.as_ref().map(ToString::to_string),
            probability: c.probability,
            magnitude: c.magnitude,
            low: end(-1.0),
            high: end(1.0),
            unit: c.unit.to_string(),
            place: c.place,
            when: c.intervals.as_ref().and_then(span),
        }
    }
}

/// From the first instant to the last.
fn span(intervals: &BTreeMap<String, Vec<[f64; 2]>>) -> Option<[f64; 2]> {
    intervals.values().flatten().copied().reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
}

fn probability(d: &Diagnosis) -> Option<f64> {
    let of = |effect: &str| d.ranked.iter().find(|c| c.effect == effect).map(|c| c.probability);
    match d.verdict {
        Verdict::Explained => d.ranked.iter().find(|c| !is_no_cause(c)).map(|c| c.probability),
        Verdict::Unknown => of("unknown"),
        Verdict::NoMismatch => of("none"),
        Verdict::Withheld => None,
    }
}

/// A verdict as in the table.
pub(crate) const fn verdict_name(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Explained => "explained",
        Verdict::Unknown => "unknown",
        Verdict::NoMismatch => "no_mismatch",
        Verdict::Withheld => "withheld",
    }
}
