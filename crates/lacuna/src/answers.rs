//! Answers in the form that the blind examiner's scorer reads.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};
use diagnosis::{Diagnosis, Verdict};
use serde_json::{Value, json};

use crate::predictions::{self, save};

/// Writes `OUT/<case>.json` and the predicted responses `OUT/<case>/<drive>.csv` and `<drive>.nominal.csv`.
///
/// # Errors
/// When a file cannot be written.
pub fn write(out: &Path, case: &str, diagnosis: &Diagnosis, seconds: f64) -> Result<()> {
    let verdict = match diagnosis.verdict {
        Verdict::Explained => "explained",
        Verdict::Unknown => "unknown",
        Verdict::NoMismatch | Verdict::Withheld => "no mismatch",
    };
    let ranked: Vec<Value> = diagnosis
        .ranked
        .iter()
        .map(|c| {
            json!({
                "effect": c.effect, "probability": c.probability, "magnitude": c.magnitude,
                "side": c.side, "interval_s": c.intervals,
            })
        })
        .collect();
    let answer = json!({ "case": case, "verdict": verdict, "seconds": seconds, "ranked": ranked });
    fs::create_dir_all(out).with_context(|| format!("cannot create '{}'", out.display()))?;
    save(&out.join(format!("{case}.json")), &serde_json::to_string_pretty(&answer)?)?;
    predictions::write(&out.join(case), diagnosis)
}
