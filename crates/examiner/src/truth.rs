//! What was hidden, in the form that the scorer reads.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// A hidden effect. Fields that an effect does not have are left out.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct EffectTruth {
    /// Id of the vocabulary, or `out_of_library`.
    pub id: String,
    /// 0 mild, 1 medium, 2 strong.
    pub severity: u8,
    /// `left`, `right` or null.
    pub side: Option<String>,
    /// Which outsider it is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kind: Option<String>,
    /// Body axis of a shifted centre of mass.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axis: Option<String>,
    /// `patch` or `time`.
    #[serde(rename = "where", skip_serializing_if = "Option::is_none")]
    pub place: Option<String>,
    /// World direction of a slope.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub downhill_direction_rad: Option<f64>,
    /// Yaw inertia of a payload.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub izz_added: Option<f64>,
    /// Rise of the centre of mass under a payload.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub height_rise_m: Option<f64>,
    /// Time constant of a drift.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tau_s: Option<f64>,
    /// Phase of a runout at the index mark, front wheel.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub phase_front_rad: Option<f64>,
    /// The same of the rear wheel.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub phase_rear_rad: Option<f64>,
    /// Size in the unit of the vocabulary.
    pub magnitude: f64,
    /// Centre of a disc.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub x: Option<f64>,
    /// Centre of a disc.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub y: Option<f64>,
    /// Radius of a disc.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius: Option<f64>,
    /// Share of each recording inside the disc.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coverage_recordings: Option<Vec<f64>>,
    /// Share of each held-out run inside the disc.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coverage_heldout: Option<Vec<f64>>,
    /// Free-run error of the recordings without this effect over that with it.
    pub excess: f64,
}

impl EffectTruth {
    pub(crate) fn new(id: String, severity: u8) -> Self {
        Self {
            id,
            severity,
            side: None,
            kind: None,
            axis: None,
            place: None,
            downhill_direction_rad: None,
            izz_added: None,
            height_rise_m: None,
            tau_s: None,
            phase_front_rad: None,
            phase_rear_rad: None,
            magnitude: 0.0,
            x: None,
            y: None,
            radius: None,
            coverage_recordings: None,
            coverage_heldout: None,
            excess: 0.0,
        }
    }
}

/// Of one recording. Pairs are root mean squares of wheel speeds and of yaw rate.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct RecordingTruth {
    /// When a local effect was present; of short events outside the vocabulary, what they act on and when.
    pub intervals_s: BTreeMap<String, Vec<[f64; 2]>>,
    /// Kinds of drive, in order.
    pub kinds: Vec<String>,
    /// Free-run error of the true robot without the effect.
    pub freerun_without_effect: [f64; 2],
    /// The same with the effect.
    pub freerun_with_effect: [f64; 2],
    /// The signals themselves.
    pub rms: [f64; 2],
}

/// Of one held-out run. Pairs are root mean squares of wheel speeds and of yaw rate.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct HeldoutTruth {
    /// Kinds of drive, in order.
    pub kinds: Vec<String>,
    /// The signals themselves.
    pub rms: [f64; 2],
    /// Error of the user's values.
    pub nominal: [f64; 2],
    /// Error of the true values without the effect.
    pub calibrated: [f64; 2],
    /// Error of the true values with the effect.
    pub oracle: [f64; 2],
}

/// Everything hidden in a case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Truth {
    /// Name of the case.
    pub case: String,
    /// The tyre law of the true robot.
    pub generator: String,
    /// `no mismatch`, `explained` or `unknown`.
    pub verdict: String,
    /// What was hidden.
    pub effects: Vec<EffectTruth>,
    /// By recording.
    pub recordings: BTreeMap<String, RecordingTruth>,
    /// By held-out run.
    pub heldout: BTreeMap<String, HeldoutTruth>,
    /// `normal` or `weak`.
    pub setting: String,
    /// The true robot without what is hidden; ratios to the user's value where there is one.
    pub robot: BTreeMap<String, f64>,
    /// Whether no draw reached the asked excess over the noise.
    pub below_noise: bool,
}

impl Truth {
    /// Its JSON text.
    ///
    /// # Errors
    /// If a number is not finite.
    pub fn json(&self) -> Result<String, serde_json::Error> {
        let mut text = serde_json::to_string_pretty(self)?;
        text.push('\n');
        Ok(text)
    }

    /// SHA-256 of its JSON text, to seal it before answers are given.
    ///
    /// # Errors
    /// If a number is not finite.
    pub fn seal(&self) -> Result<String, serde_json::Error> {
        Ok(sha256(self.json()?.as_bytes()))
    }
}

/// SHA-256 in hexadecimal, as `sha256sum` prints it.
pub fn sha256(bytes: &[u8]) -> String {
    hex::encode(Sha256::digest(bytes))
}
