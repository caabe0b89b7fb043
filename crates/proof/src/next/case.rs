//! One robot: a calm recording, its diagnosis, and what each further drive makes of it.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use anyhow::{Context, Result};
use case_files::case_folder::{self, CaseFolder};
use examiner::{Again, Course, Plan};
use inference::Options;
use recordings::ReadOptions;
use serde::Serialize;
use verdict::{Advice, Diagnosis, Verdict};

use super::follow::{advised, by_lot, calm, of_menu};

/// Length of references and of the calm recording, s, and number of references.
pub(super) const SECONDS: f64 = 12.0;
pub(super) const REFERENCES: usize = 2;
/// A cause is named when it is more probable than this.
const NAMED: f64 = 0.9;

/// What a diagnosis says of the hidden effect.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Said {
    /// The drive that was added, if one was.
    pub(super) drive: String,
    /// First cause and its probability.
    pub(super) first: (String, f64),
    /// Probability of the hidden effect.
    pub(super) of_truth: f64,
    /// The hidden effect is first, more probable than 0.9, and nothing else is left beside it.
    pub(super) resolved: bool,
    /// Entropy of the hypotheses, bits.
    pub(super) open_bits: f64,
}

/// A robot whose first diagnosis was not clear.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Tried {
    pub(super) name: String,
    pub(super) hidden: String,
    pub(super) setting: String,
    pub(super) before: Said,
    pub(super) expected_bits: f64,
    pub(super) advised: Said,
    pub(super) menu: Said,
    pub(super) lot: Said,
    /// Rivals before, with their probabilities.
    pub(super) rivals: Vec<(String, f64)>,
    /// Expected bits of the random drive of the menu.
    pub(super) menu_bits: f64,
}

/// Runs a case; `None` when the calm recording is enough.
pub(super) fn run(plan: &Plan, folder: &Path, seconds: f64) -> Result<Option<Tried>> {
    let drawn = plan.draw()?;
    let hidden = drawn.truth.effects.first().map(|e| e.id.clone()).context("nothing is hidden")?;
    if folder.exists() {
        fs::remove_dir_all(folder).with_context(|| format!("cannot remove '{}'", folder.display()))?;
    }
    drawn.write(folder)?;
    let first = calm(plan.seed, SECONDS);
    let robot = Again::new(plan.seed, &plan.settings)?;
    // Every further drive is the same run otherwise: the same friction and the same noise.
    let recorded = |then: Option<Course>| -> Result<Vec<String>> {
        let courses = std::iter::once(first.clone()).chain(then).enumerate();
        courses.map(|(i, course)| Ok(robot.record(i, &course)?)).collect()
    };
    let before = diagnosed(folder, &recorded(None)?, Some(seconds))?;
    let told = said("", &before, &hidden);
    let Some(advice) = before.next.as_ref().filter(|_| !told.resolved) else { return Ok(None) };
    let Some(best) = advice.best() else { return Ok(None) };
    let again = |name: &str, course: Course| -> Result<Said> {
        Ok(said(name, &diagnosed(folder, &recorded(Some(course))?, None)?, &hidden))
    };
    if advice.rivals.len() < 2 {
        return Ok(None);
    }
    let Some((other, lot)) = controls(advice, plan.seed, seconds) else { return Ok(None) };
    Ok(Some(Tried {
        name: plan.name.clone(),
        setting: drawn.truth.setting.clone(),
        before: told,
        expected_bits: best.expected_bits,
        advised: again(&best.name, advised(best))?,
        menu: again(&other.0, other.1.clone())?,
        lot: again("random speed profile", lot)?,
        rivals: advice.rivals.iter().map(|r| (r.effects.join("+"), r.probability)).collect(),
        menu_bits: advice.manoeuvres.iter().find(|m| m.name == other.0).map_or(0.0, |m| m.expected_bits),
        hidden,
    }))
}

fn controls(advice: &Advice, seed: u64, seconds: f64) -> Option<((String, Course), Course)> {
    let menu = of_menu(&advice.manoeuvres, seed)?;
    Some(((menu.name.clone(), advised(menu)), by_lot(&advice.manoeuvres, seed, seconds)?))
}

/// Diagnoses a case with these recordings in the place of its own.
fn diagnosed(folder: &Path, recordings: &[String], next: Option<f64>) -> Result<Diagnosis> {
    let inside = folder.join("recordings");
    fs::remove_dir_all(&inside).and_then(|()| fs::create_dir(&inside)).context("cannot empty the recordings")?;
    for (i, text) in recordings.iter().enumerate() {
        let path = inside.join(format!("run_{}.csv", i + 1));
        fs::write(&path, text).with_context(|| format!("cannot write '{}'", path.display()))?;
    }
    let mapping = case_folder::mapping("skid-steer-columns")?;
    let case = CaseFolder::open(folder, None, &mapping, &ReadOptions::default())?.torque_driven()?;
    let options = Options { next, ..Options::default() };
    Ok(torque_driven::diagnose(&case, &options, &|_| ())?)
}

fn said(drive: &str, d: &Diagnosis, hidden: &str) -> Said {
    let causes = || d.ranked.iter().filter(|c| c.effect != "unknown");
    let first = d.ranked.first().map(|c| (c.effect.clone(), c.probability)).unwrap_or_default();
    let of_truth = causes().find(|c| c.effect == hidden).map_or(0.0, |c| c.probability);
    let alone = d.indistinguishable.is_empty() && d.verdict == Verdict::Explained;
    Said {
        drive: drive.to_owned(),
        resolved: alone && first.0 == hidden && of_truth > NAMED,
        first,
        of_truth,
        open_bits: open_bits(d),
    }
}

/// Entropy of the sets of effects that were fitted and of "nothing is missing", bits.
fn open_bits(d: &Diagnosis) -> f64 {
    let none = d.ranked.iter().find(|c| c.effect == "none").map_or(0.0, |c| c.probability);
    let mut sets: BTreeMap<Vec<&str>, f64> = BTreeMap::from([(Vec::new(), none)]);
    for t in &d.trials {
        let mut ids: Vec<&str> = t.correction.effects.iter().map(|e| e.effect.as_str()).collect();
        ids.sort_unstable();
        *sets.entry(ids).or_default() += t.probability;
    }
    let sum: f64 = sets.values().sum();
    let shares = sets.values().map(|p| p / sum.max(f64::MIN_POSITIVE)).filter(|p| *p > 0.0);
    -shares.map(|p| p * p.log2()).sum::<f64>()
}
