//! What a diagnosis says.

use std::borrow::Cow;
use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::correction::Correction;
use crate::diagnose::FORMAT;
use crate::locate::Located;
use crate::long::Coverage;
use crate::predict::Prediction;
use crate::trace::Trace;

/// A word of the program's own; of another's when read from JSON.
pub type Word = Cow<'static, str>;

/// The kind of answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// One or more effects of the catalogue explain the mismatch.
    Explained,
    /// There is a mismatch, but nothing in the catalogue explains it.
    Unknown,
    /// Nothing is missing.
    NoMismatch,
    /// The recordings permit no answer.
    Withheld,
}

/// One possible cause with what is known about it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Cause {
    /// Effect id, "none" or "unknown".
    pub effect: String,
    /// Name for people, with side, axis and place.
    pub name: String,
    /// Probability that it is part of the truth.
    pub probability: f64,
    /// Size in `unit`.
    pub magnitude: Option<f64>,
    /// One sigma of the size.
    pub sigma: Option<f64>,
    /// Unit of the size.
    pub unit: Word,
    /// Every number of its law, by name; of a place also x, y and radius, m.
    pub parameters: BTreeMap<String, Estimate>,
    /// Side, when it sits on one.
    pub side: Option<Word>,
    /// Where on the ground, when it is a place: x, y, radius in m.
    pub place: Option<[f64; 3]>,
    /// When it was present in each recording, s; `None` when it was there all the time.
    pub intervals: Option<BTreeMap<String, Vec<[f64; 2]>>>,
}

/// A fitted number.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// Its value in the unit of the card.
    pub value: f64,
    /// One sigma, where it is known.
    pub sigma: Option<f64>,
    /// Whether the fit stopped at the end of what the card calls sensible: the value is then no estimate.
    pub at_bound: bool,
}

impl Cause {
    /// Whether any number of it stopped at its bound.
    pub fn is_at_bound(&self) -> bool {
        self.parameters.values().any(|p| p.at_bound)
    }

    /// A cause of which only the probability is known.
    pub(crate) fn plain(effect: &str, name: &str, probability: f64) -> Self {
        Self {
            effect: effect.to_owned(),
            name: name.to_owned(),
            probability,
            magnitude: None,
            sigma: None,
            unit: "-".into(),
            parameters: BTreeMap::new(),
            side: None,
            place: None,
            intervals: None,
        }
    }
}

/// Free-run errors of a recording that was not used for the fit, rms.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FreeRun {
    /// Name of the recording that was left out.
    pub recording: String,
    /// What is compared, with its unit.
    pub quantity: String,
    /// The user's model as it is.
    pub nominal: f64,
    /// Re-tuned without any effect.
    pub retuned: f64,
    /// Corrected by the named effects.
    pub corrected: f64,
    /// Corrected by the best wrong effect, given the same freedom; `None` when no other effect was fitted.
    pub placebo: Option<f64>,
}

/// A place in the data where the mismatch shows.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// Which signal.
    pub signal: String,
    /// Side of the signal, if it has one.
    pub side: Option<Word>,
    /// Mean squared mismatch of the calibrated model over what left-out references show in such driving.
    pub ratio: f64,
    /// Recording and interval in which it is largest, s.
    pub recording: String,
    /// From, until, s.
    pub interval: [f64; 2],
    /// Probability that a healthy case shows as much.
    pub p: f64,
    /// Whether it stands out from the references, with 5 % of false discoveries over all signals.
    pub significant: bool,
}

/// Mean mismatch in a range of speed, turning, slip or heading, or at a place on the ground.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Cell {
    /// "speed" (|forward velocity|), "turning" (yaw rate), "slip" (the faster side's |slip speed|), "heading" or "place".
    pub by: Word,
    /// Unit of the range.
    pub unit: Word,
    /// Range; of a place, those of x and y.
    pub range: Vec<[f64; 2]>,
    /// Seconds of driving in it.
    pub seconds: f64,
    /// Mean squared mismatch of all signals over what the references show in such driving.
    pub ratio: f64,
    /// Probability that healthy driving shows as much; segments are the independent blocks.
    pub p: f64,
    /// Whether it stands out, with 5 % of false discoveries over all cells (Benjamini and Yekutieli).
    pub significant: bool,
}

/// A hypothesis that was fitted in free run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Trial {
    /// Its effects, with side, axis and place.
    pub hypothesis: Vec<String>,
    /// Fall of the cost below "re-tune only", nats.
    pub gain: f64,
    /// Separate visits that support a place on the ground, if it names one.
    pub visits: Option<usize>,
    /// Gain less penalties, nats.
    pub score: f64,
    /// Its share of the probability.
    pub probability: f64,
    /// The simulation as this hypothesis would have it.
    pub correction: Correction,
}

/// The answer to a case.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Diagnosis {
    /// Version of this structure.
    pub format: u32,
    /// Kind of answer.
    pub verdict: Verdict,
    /// The answer in sentences.
    pub sentences: Vec<String>,
    /// Causes, "none" and "unknown" by probability.
    pub ranked: Vec<Cause>,
    /// Classes of effects that these recordings cannot tell apart, one for each missing effect; the best first.
    pub indistinguishable: Vec<Vec<String>>,
    /// Where the mismatch shows.
    pub findings: Vec<Finding>,
    /// Mismatch by speed, turning, slip, heading and place.
    pub cells: Vec<Cell>,
    /// When it shows, residual torque, and what is left after the verdict.
    pub located: Located,
    /// Free runs on recordings that were not fitted.
    pub free_runs: Vec<FreeRun>,
    /// Share of the mismatch that the best answer leaves unexplained, if there is one.
    pub unexplained: Option<f64>,
    /// What limits the answer.
    pub limits: Vec<String>,
    /// Hypotheses that were fitted, best first.
    pub trials: Vec<Trial>,
    /// Cost of the recordings when calibrated, when re-tuned, when healthy: nats.
    pub costs: [f64; 3],
    /// What each reference, left out in turn, would be accused of, and what that scores: a hypothesis must do better.
    pub accusations: Vec<(String, f64)>,
    /// Evidence of the screen per effect, nats.
    pub screened: Vec<(String, f64)>,
    /// Constants of the robot as re-tuned together with the named effects, relative to sigma.
    pub tuning: BTreeMap<String, f64>,
    /// The simulation as this diagnosis would have it: what held-out drives are predicted with.
    pub correction: Correction,
    /// Recordings beside the simulation.
    pub traces: Vec<Trace>,
    /// Loads of steady driving (speed-driven cases).
    pub steady: Option<crate::steady::Loads>,
    /// Response from command over wheels to the body (command-driven cases).
    pub response: Option<crate::response::Response>,
    /// Which drive would tell the rivals apart, if that was asked.
    #[serde(default)]
    pub next: Option<crate::next::Advice>,
    /// Of long recordings and references, the stretches that this rests on, by the part that they play.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub coverage: BTreeMap<String, Coverage>,
    /// Predicted responses of the held-out drives: corrected, then without the effect.
    #[serde(skip)]
    pub predictions: Vec<(Prediction, Prediction)>,
}

impl Diagnosis {
    /// No answer yet: what a diagnosis starts from.
    pub fn withheld() -> Self {
        Self {
            format: FORMAT,
            verdict: Verdict::Withheld,
            sentences: Vec::new(),
            ranked: Vec::new(),
            indistinguishable: Vec::new(),
            findings: Vec::new(),
            cells: Vec::new(),
            located: Located::default(),
            free_runs: Vec::new(),
            unexplained: None,
            limits: Vec::new(),
            trials: Vec::new(),
            costs: [0.0; 3],
            accusations: Vec::new(),
            screened: Vec::new(),
            tuning: BTreeMap::new(),
            correction: Correction::default(),
            traces: Vec::new(),
            steady: None,
            response: None,
            next: None,
            coverage: BTreeMap::new(),
            predictions: Vec::new(),
        }
    }

    /// Says what it rests on where recordings were too long to be used whole.
    pub fn rest_on(&mut self, coverage: &BTreeMap<String, Coverage>) {
        for (part, coverage) in coverage {
            self.sentences.push(coverage.sentence(part));
            self.limits.push(coverage.limit(part));
        }
        self.coverage.clone_from(coverage);
    }
}
