//! What turns a body otherwise than its wheels say, and what shows another turning than there is.

use serde::{Deserialize, Serialize};

use crate::Word;

/// What a gyro shows of the turning that a pose shows.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct GyroBesidePose {
    /// Its share in the recordings.
    pub share: f64,
    /// Half of its 90 % interval.
    pub half: f64,
    /// The same share in the references; `None` without any.
    pub references: Option<f64>,
    /// Whether its scale is off, by more than chance and by enough to matter.
    pub is_off: bool,
}

/// A side whose wheels roll as if they had another radius: the body turns while both sides turn alike.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SideDrift {
    /// Right less left radius, as a share, beyond that of the references.
    pub difference: f64,
    /// Half of its 90 % interval.
    pub half: f64,
    /// The side, where the loads tell it.
    pub side: Option<Word>,
}

/// A stretch in which the encoder of one side shows another speed than there is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WrongSpeed {
    /// Name of the recording.
    pub recording: String,
    /// From and until, s.
    pub interval: [f64; 2],
    /// The side.
    pub side: Word,
    /// What it shows over what there is.
    pub share: f64,
    /// Half of its 90 % interval.
    pub half: f64,
    /// Whether the controller follows it: it shows what is set, and the wheel turns otherwise.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub is_followed: bool,
}

/// The gyro's clock of a recording against that of the speeds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ClockError {
    /// Name of the recording.
    pub recording: String,
    /// Smallest and largest lag in the recording, s.
    pub lag: [f64; 2],
    /// Median and 90 % quantile of the error on turns left out of the alignment, s; `None` below three turns.
    pub error: Option<[f64; 2]>,
    /// Error of each turn left out, s.
    pub left_out: Vec<f64>,
}
