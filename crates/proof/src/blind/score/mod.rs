//! Compares the answer to a case with its truth.

use anyhow::Result;
use case_files::answers::{Answer, AnswerCause};
use examiner::{Plan, Truth};
use serde::Serialize;
use verdict::Verdict;

use super::diagnose::{self, Record};
use super::layout::Layout;
use super::seal::Seals;
use super::truth;

mod belief;
mod calibration;
mod conditions;
mod heldout;
mod naming;
mod sizes;
pub(super) mod statistics;
#[cfg(test)]
mod testing;

pub(super) use belief::Belief;
pub(super) use calibration::{bins, expected_error};
pub(super) use conditions::{Conditions, STRATA};
pub(super) use heldout::HeldOut;
pub(super) use naming::Naming;
pub(super) use sizes::Part;

/// Answers that are no effects.
const NONE: &str = "none";
const UNKNOWN: &str = "unknown";
/// Effects that a person would look at.
const FIRST: usize = 3;

/// What is hidden in a case.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Kind {
    /// Nothing.
    Null,
    /// One effect of the vocabulary.
    Single,
    /// Two of them.
    Pair,
    /// Three of them.
    Triple,
    /// Something outside the vocabulary.
    Outsider,
}

impl Kind {
    pub(super) const ALL: [Self; 5] = [Self::Null, Self::Single, Self::Pair, Self::Triple, Self::Outsider];

    /// Its name for people, in the plural.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Null => "nothing hidden",
            Self::Single => "singles",
            Self::Pair => "pairs",
            Self::Triple => "three at once",
            Self::Outsider => "outsiders",
        }
    }

    fn of(truth: &Truth) -> Self {
        match truth.effects.as_slice() {
            [] => Self::Null,
            _ if truth.verdict == UNKNOWN => Self::Outsider,
            [_] => Self::Single,
            [_, _] => Self::Pair,
            _ => Self::Triple,
        }
    }

    /// Whether effects of the vocabulary are hidden.
    pub(super) fn in_catalogue(self) -> bool {
        matches!(self, Self::Single | Self::Pair | Self::Triple)
    }
}

/// A case with all that is scored of it.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Row {
    pub(super) case: String,
    pub(super) kind: Kind,
    /// Tyre law of the true robot.
    pub(super) law: String,
    pub(super) setting: String,
    /// Severity of the first effect.
    pub(super) severity: Option<u8>,
    /// Whether the noise drowns an effect.
    pub(super) below_noise: bool,
    /// What the case was recorded under.
    pub(super) conditions: Conditions,
    /// Ids of the hidden effects, or the kind of outsider.
    pub(super) hidden: Vec<String>,
    /// The verdict in the scorer's words; `None` if there is no answer.
    pub(super) verdict: Option<&'static str>,
    pub(super) naming: Naming,
    pub(super) belief: Belief,
    /// Each hidden effect of the vocabulary.
    pub(super) parts: Vec<Part>,
    pub(super) heldout: HeldOut,
    /// By the clock.
    pub(super) seconds: Option<f64>,
    /// On a processor.
    pub(super) processor_seconds: Option<f64>,
    /// Bytes.
    pub(super) peak_memory: Option<u64>,
}

/// An answer as far as it is scored; a case without one has no causes in it.
#[derive(Debug, Clone, Copy)]
struct RankedAnswer<'a> {
    verdict: Option<Verdict>,
    /// By falling probability.
    ranked: &'a [&'a AnswerCause],
    classes: &'a [Vec<String>],
}

impl<'a> RankedAnswer<'a> {
    /// Effects that it names, the most probable first.
    fn named(self) -> Vec<&'a str> {
        self.ranked.iter().map(|c| c.effect.as_str()).filter(|e| ![NONE, UNKNOWN].contains(e)).collect()
    }
}

/// Causes outside the examiner's vocabulary that the catalogue has a name for, by the kind of outsider: that name is as right
/// as "unknown" is. A load that shifts, a cable, gusts and the like have none.
const NAMESAKES: [(&str, &str); 2] = [("voltage_sag", "battery_sag"), ("contact_loss", "contact_loss")];

/// The name that the catalogue has for a hidden outsider.
fn namesake(truth: &Truth) -> Option<&'static str> {
    let kind = truth.effects.first()?.kind.as_deref()?;
    NAMESAKES.iter().find(|(outsider, _)| *outsider == kind).map(|(_, name)| *name)
}

/// What the answer should be: ids of effects, "none" or "unknown"; `first` is the effect that an answer explains by.
fn wanted<'a>(kind: Kind, truth: &'a Truth, first: Option<&str>) -> Vec<&'a str> {
    match kind {
        Kind::Null => vec![NONE],
        Kind::Outsider => vec![namesake(truth).filter(|name| first == Some(*name)).unwrap_or(UNKNOWN)],
        Kind::Single | Kind::Pair | Kind::Triple => truth.effects.iter().map(|e| e.id.as_str()).collect(),
    }
}

/// Opens the truth of a case and scores the answer to it, if there is one.
pub(super) fn row(layout: &Layout, plan: &Plan, seals: &Seals, record: Option<&Record>) -> Result<Row> {
    let name = &plan.name;
    let opened = truth::open(layout, name, seals)?;
    let answer = record.map(|_| diagnose::answer(&layout.diagnosis(name))).transpose()?;
    let predictions = record.map(|_| layout.predictions(name));
    let heldout = HeldOut::of(&opened, predictions.as_deref())?;
    let row = scored(&opened.truth, plan.settings.duration_s, answer.as_ref(), heldout);
    Ok(Row {
        conditions: Conditions::of(&plan.settings),
        seconds: record.map(|r| r.seconds),
        processor_seconds: record.and_then(|r| r.processor_seconds),
        peak_memory: record.and_then(|r| r.peak_memory),
        ..row
    })
}

fn scored(truth: &Truth, duration: f64, answer: Option<&Answer>, heldout: HeldOut) -> Row {
    let kind = Kind::of(truth);
    let mut ranked: Vec<&AnswerCause> = answer.iter().flat_map(|t| &t.ranked).collect();
    ranked.sort_by(|a, b| b.probability.total_cmp(&a.probability));
    let ranked_answer = RankedAnswer {
        verdict: answer.map(|t| t.verdict),
        ranked: &ranked,
        classes: answer.map_or(&[], |t| t.indistinguishable.as_slice()),
    };
    let explained = ranked_answer.verdict == Some(Verdict::Explained);
    let wanted = wanted(kind, truth, ranked_answer.named().first().copied().filter(|_| explained));
    Row {
        case: truth.case.clone(),
        kind,
        law: truth.generator.clone(),
        setting: truth.setting.clone(),
        severity: truth.effects.first().map(|e| e.severity),
        below_noise: truth.below_noise,
        conditions: Conditions::default(),
        hidden: truth.effects.iter().map(|e| e.kind.clone().unwrap_or_else(|| e.id.clone())).collect(),
        verdict: answer.map(Answer::verdict),
        naming: Naming::of(kind, &wanted, ranked_answer),
        belief: Belief::of(&wanted, &ranked),
        parts: if kind.in_catalogue() { sizes::parts(truth, duration, ranked_answer) } else { Vec::new() },
        heldout,
        seconds: None,
        processor_seconds: None,
        peak_memory: None,
    }
}
