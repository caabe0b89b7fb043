//! What a diagnosis says.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::{
    Advice, Cause, Cell, Correction, Coverage, Finding, FreeRun, LawOfFile, Loads, Located, PredictedPath, Prediction,
    Response, Retuned, SimulatorConstants, Trace, Trial, UnnamedCause,
};

/// Version of the JSON of a diagnosis.
pub const FORMAT: u32 = 2;

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
    /// Cost of the recordings when calibrated, when re-tuned, when fault-free: nats.
    pub costs: [f64; 3],
    /// The effect that each reference, left out in turn, would falsely be given, and its score: a
    /// hypothesis must do better.
    #[serde(alias = "accusations")]
    pub null_scores: Vec<(String, f64)>,
    /// Evidence of the screen per effect, nats.
    pub screened: Vec<(String, f64)>,
    /// Constants of the robot as re-tuned together with the named effects, relative to sigma.
    pub tuning: BTreeMap<String, f64>,
    /// Constants that moved farther than they are known, the farthest first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub retuned: Vec<Retuned>,
    /// Constants with which the user's simulator behaves otherwise than the robot file says, by its own logs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub simulator: Option<SimulatorConstants>,
    /// The simulation as this diagnosis would have it: what held-out drives are predicted with.
    pub correction: Correction,
    /// Recordings beside the simulation.
    pub traces: Vec<Trace>,
    /// Loads of steady driving (speed-driven cases).
    pub steady: Option<Loads>,
    /// Response from command over wheels to the body (command-driven cases).
    pub response: Option<Response>,
    /// Which drive would tell the rivals apart, if that was asked.
    #[serde(default)]
    pub next: Option<Advice>,
    /// What was found of a cause without a name, if it was looked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub law: Option<UnnamedCause>,
    /// Laws of files that were weighed as effects of one's own: other commands need these files to simulate what is named.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub own_effects: Vec<LawOfFile>,
    /// Of long recordings and references, the stretches that this rests on, by the part that they play.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub coverage: BTreeMap<String, Coverage>,
    /// Predicted responses of the held-out drives: corrected, then without the effect.
    #[serde(skip)]
    pub predictions: Vec<(Prediction, Prediction)>,
    /// Predicted poses of the held-out drives, of robots that are compared by their pose.
    #[serde(skip)]
    pub predicted_paths: Vec<PredictedPath>,
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
            null_scores: Vec::new(),
            screened: Vec::new(),
            tuning: BTreeMap::new(),
            retuned: Vec::new(),
            simulator: None,
            correction: Correction::default(),
            traces: Vec::new(),
            steady: None,
            response: None,
            next: None,
            law: None,
            own_effects: Vec::new(),
            coverage: BTreeMap::new(),
            predictions: Vec::new(),
            predicted_paths: Vec::new(),
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_diagnosis_of_long_recordings_says_of_each_part_what_it_rests_on_and_what_was_left_out() {
        let coverage = |screened: f64, left_out: usize| Coverage {
            screened,
            diagnosed: 600.0,
            compared_with: crate::ComparedWith::References,
            chosen: Vec::new(),
            left_out,
            unlike: [None; 5],
            unlike_left_out: [None; 2],
        };
        let parts = [("the recordings", coverage(7200.0, 40)), ("the references", coverage(3600.0, 20))];
        let parts = BTreeMap::from(parts.map(|(part, coverage)| (part.to_owned(), coverage)));
        let mut diagnosis = Diagnosis::withheld();
        diagnosis.sentences.push("Left brake drags.".to_owned());
        diagnosis.rest_on(&parts);

        let [verdict, recordings, references] = &diagnosis.sentences[..] else { panic!("{:?}", diagnosis.sentences) };
        assert_eq!(verdict, "Left brake drags.");
        assert!(recordings.starts_with("Of 2.0 h of the recordings, all screened, 10.0 min were"), "{recordings}");
        assert!(references.starts_with("Of 60.0 min of the references, all screened, 10.0 min were"), "{references}");
        let [recordings, references] = &diagnosis.limits[..] else { panic!("{:?}", diagnosis.limits) };
        assert!(recordings.starts_with("40 stretches of the recordings were screened but not"), "{recordings}");
        assert!(references.starts_with("20 stretches of the references were screened but not"), "{references}");
        assert_eq!(diagnosis.coverage, parts);
    }
}
