//! Peers of a law: what other methods make of the same residual series.
//!
//! ```text
//! place where the law acts --> arbitrary input in every window of 0.1 s, and its deviation
//!     all recordings but one --> the law that is told (structure and numbers), fits of the peers
//!     the one left out       --> all of them predict it
//! ```
//!
//! * `place`: where a hidden law acts, and at which place all are compared.
//! * `job`: the series as the script reads it, and what it writes.
//! * `python`: the Python that has the packages.
//! * `score`: which share of what acted each explains.
//! * `units`: whether the units of a formula close.
//! * `tables`: what came out.

use anyhow::{Result, ensure};
use examiner::DrawnCase;
use inference::Options;
use law::{Law, Variable};
use serde::Serialize;
use torque_driven::{Calibrated, Case, ResidualWindow};
use verdict::{Claim, Diagnosis, FoundLaw};

use super::judge::Judged;
use job::Job;
pub(super) use place::true_place;
pub(super) use python::Python;
pub(super) use tables::{figures, tables};

mod job;
mod place;
mod python;
mod score;
mod tables;
mod units;

/// The name under which the law that Lacuna tells stands in the table.
const OWN: &str = "Lacuna";
/// The name of the hidden law's own curve: what the series holds beside its noise.
const HIDDEN: &str = "the hidden law itself";

/// What all methods made of one case.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Compared {
    /// The hidden effect, or kind of law.
    hidden: String,
    /// Where the series was taken.
    place: String,
    /// Whether Lacuna told a law.
    has_law: bool,
    scores: Vec<Scored>,
    /// Versions of the packages, by their names.
    versions: std::collections::BTreeMap<String, String>,
}

/// What one method made of it.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Scored {
    method: String,
    /// The formula; `None` of a black box, and where no law is told.
    formula: Option<String>,
    /// Terms or nodes of the formula.
    parts: Option<usize>,
    /// Whether the units of the formula cannot close; `None` without a formula.
    has_wrong_units: Option<bool>,
    /// Share of the mean square of the left-out series that it explains, windows weighted by their deviations.
    explained: f64,
    /// The same of what the hidden law did there, which has no noise; `None` where the examiner does not know it.
    of_hidden: Option<f64>,
    /// Processor time, s.
    seconds: Option<f64>,
}

/// The case without its last recording, which is left out for all.
pub(super) fn without_last(case: &Case) -> Case {
    let used = case.recordings.split_last().map_or(&[][..], |(_, used)| used);
    Case { recordings: used.to_vec(), ..case.clone() }
}

/// Compares the law that was told of a case without its last recording with its peers. `folder` is one for files.
pub(super) fn compare(
    python: &Python,
    folder: &std::path::Path,
    (drawn, case): (&DrawnCase, &Case),
    options: &Options,
    (told, judged): (&Diagnosis, &Judged),
) -> Result<Compared> {
    let place = place::of(drawn.truth.effects.first(), judged);
    let found = told.law.as_ref().filter(|l| l.claim == Claim::Law).and_then(|l| l.law.as_ref());
    let law = found.map(as_law).transpose()?;
    let windows = Calibrated::new(case, options)?.residual(case, options, place, law.as_ref())?;
    let last = case.recordings.last().map_or("", |run| run.name.as_str());
    let (left_out, fit): (Vec<ResidualWindow>, _) = windows.into_iter().partition(|w| w.recording == last);
    ensure!(!left_out.is_empty() && !fit.is_empty(), "there is no residual series at the {}", place.name());

    let hidden = score::hidden(&left_out, &drawn.law_rows);
    let scored = |method: &str, predicted: &[f64]| Scored {
        method: method.to_owned(),
        formula: None,
        parts: None,
        has_wrong_units: None,
        explained: score::of_series(&left_out, predicted),
        of_hidden: hidden.as_ref().map(|h| score::of_curve(h, predicted)),
        seconds: None,
    };
    let own: Vec<f64> = left_out.iter().map(|w| w.law).collect();
    let mut scores = vec![Scored {
        formula: found.map(|l| l.formula.clone()),
        parts: law.as_ref().map(|l| l.terms().len()),
        // A law whose units do not close cannot be written.
        has_wrong_units: law.as_ref().map(|_| false),
        ..scored(OWN, &own)
    }];
    let answer = python.fit(folder, &Job::new(&fit, &left_out))?;
    for peer in answer.peers {
        ensure!(peer.predicted.len() == left_out.len(), "{} predicts another number of windows", peer.name);
        let wrong = peer.trees.as_ref().map(|trees| trees.iter().any(|t| !units::close(t, &job::dimensions())));
        scores.push(Scored {
            formula: peer.text,
            parts: peer.parts,
            has_wrong_units: wrong,
            seconds: Some(peer.seconds),
            ..scored(&peer.name, &peer.predicted)
        });
    }
    scores.extend(hidden.as_ref().map(|h| scored(HIDDEN, h)));
    let hidden = judged.hidden.clone().unwrap_or_default();
    Ok(Compared { hidden, place: place.name().to_owned(), has_law: law.is_some(), scores, versions: answer.versions })
}

/// A told law, held within the ranges in which it was seen.
fn as_law(told: &FoundLaw) -> Result<Law> {
    let law: Law = told.formula.parse()?;
    let seen = told.seen.iter().map(|(symbol, range)| Ok((Variable::seen(symbol, *range)?, *range)));
    Ok(law.seen_within(&seen.collect::<Result<Vec<_>>>()?))
}
