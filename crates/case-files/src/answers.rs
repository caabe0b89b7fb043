//! Answers in the form that the blind examiner's scorer reads.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use anyhow::{Context, Result};
use serde::Deserialize;
use serde_json::{Value, json};
use verdict::{Diagnosis, Verdict};

use crate::predictions::save;

/// What an answer is made of: a part of the JSON of a diagnosis.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Answer {
    /// The kind of answer.
    #[serde(with = "VerdictForm")]
    pub verdict: Verdict,
    /// Causes, "none" and "unknown" by probability.
    pub ranked: Vec<AnswerCause>,
    /// Classes of effects that the recordings cannot tell apart.
    #[serde(default)]
    pub indistinguishable: Vec<Vec<String>>,
}

/// A cause in an answer.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct AnswerCause {
    /// Effect id, "none" or "unknown".
    pub effect: String,
    /// Probability that it is part of the truth.
    pub probability: f64,
    /// Size, signed.
    pub magnitude: Option<f64>,
    /// One sigma of the size.
    #[serde(default)]
    pub sigma: Option<f64>,
    /// `left` or `right`, when it sits on one side.
    pub side: Option<String>,
    /// When it was present in each recording, s; `None` when it was there all the time.
    pub intervals: Option<BTreeMap<String, Vec<[f64; 2]>>>,
}

/// How a diagnosis writes its verdict.
#[derive(Deserialize)]
#[serde(remote = "Verdict", rename_all = "snake_case")]
enum VerdictForm {
    Explained,
    Unknown,
    NoMismatch,
    Withheld,
}

impl Answer {
    /// From a diagnosis at hand.
    ///
    /// # Errors
    /// When a number of it that must be there is not finite.
    pub fn of(diagnosis: &Diagnosis) -> Result<Self> {
        serde_json::from_value(serde_json::to_value(diagnosis)?).context("a diagnosis that makes no answer")
    }

    /// From the text that `lacuna diagnose --json` writes.
    ///
    /// # Errors
    /// When it is no such text.
    pub fn read(json: &str) -> Result<Self> {
        /// The envelope; what the diagnosis was made from does not matter here.
        #[derive(Deserialize)]
        struct Envelope {
            diagnosis: Answer,
        }
        let envelope: Envelope =
            serde_json::from_str(json).context("this is not what `lacuna diagnose --json` writes")?;
        Ok(envelope.diagnosis)
    }

    /// The verdict in the scorer's words.
    pub fn verdict(&self) -> &'static str {
        match self.verdict {
            Verdict::Explained => "explained",
            Verdict::Unknown => "unknown",
            Verdict::NoMismatch | Verdict::Withheld => "no mismatch",
        }
    }

    /// The answer as the scorer reads it.
    fn form(&self, case: &str, seconds: f64) -> Value {
        let ranked: Vec<Value> = self
            .ranked
            .iter()
            .map(|c| {
                json!({
                    "effect": c.effect, "probability": c.probability, "magnitude": c.magnitude,
                    "side": c.side, "interval_s": c.intervals,
                })
            })
            .collect();
        json!({ "case": case, "verdict": self.verdict(), "seconds": seconds, "ranked": ranked })
    }

    /// Writes `OUT/<case>.json`.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn write(&self, out: &Path, case: &str, seconds: f64) -> Result<()> {
        fs::create_dir_all(out).with_context(|| format!("cannot create '{}'", out.display()))?;
        save(&out.join(format!("{case}.json")), &serde_json::to_string_pretty(&self.form(case, seconds))?)
    }
}

#[cfg(test)]
mod tests {
    use verdict::Verdict;

    use super::Answer;

    #[test]
    fn what_diagnose_writes_becomes_an_answer() {
        let text = r#"{"format": 1, "diagnosis": {"verdict": "no_mismatch", "sentences": ["s"], "ranked": [
            {"effect": "none", "probability": 0.75, "magnitude": null, "sigma": null, "side": null, "intervals": null},
            {"effect": "grade", "probability": 0.25, "magnitude": -0.5, "sigma": 0.1, "side": "left",
             "intervals": {"run_1": [[1.0, 2.0]]}}]}}"#;
        let answer = Answer::read(text).expect("reads");
        assert_eq!((answer.verdict, answer.verdict()), (Verdict::NoMismatch, "no mismatch"));
        assert_eq!(answer.ranked[1].sigma, Some(0.1));
        let form = answer.form("x", 2.5).to_string();
        assert!(form.starts_with(r#"{"case":"x","verdict":"no mismatch","seconds":2.5,"ranked":[{"effect":"none","#));
        assert!(form.ends_with(r#""magnitude":-0.5,"side":"left","interval_s":{"run_1":[[1.0,2.0]]}}]}"#));
        assert!(Answer::read("{}").is_err());
    }
}
