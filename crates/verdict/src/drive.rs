//! What is found beside steady loads: drives that do not follow, loads that pulse, inertial units that tip.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::Word;

/// A side that turns at another speed than it is commanded to, and moves the body with it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Unfollowed {
    /// When, by recording, from and until, s.
    pub intervals: BTreeMap<String, Vec<[f64; 2]>>,
    /// All of that together, s.
    pub seconds: f64,
    /// The side.
    pub side: Word,
    /// Its speed over the commanded one: least and most of the stretches.
    pub share: [f64; 2],
    /// Its torque there, median, N m.
    pub torque: f64,
    /// Half of the 90 % interval of that, N m.
    pub half: f64,
    /// Whether that torque is the same in all of them and no larger one is given beside them: the motor gives no more.
    pub is_limited: bool,
}

/// Straight driving at a constant commanded speed in which the load rises and falls again and again.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Pulsing {
    /// Name of the recording.
    pub recording: String,
    /// First and last row that show it, s.
    pub interval: [f64; 2],
    /// Straight driving between them, s.
    pub seconds: f64,
    /// Root mean square of the straight load about its mean, N m: here, and usually.
    pub swing: [f64; 2],
    /// How often it rises and falls, Hz: mean of the stretches.
    pub frequency: f64,
    /// What that frequency goes with.
    pub rhythm: Rhythm,
    /// Mean straight load in the direction of travel, over the usual one: forward and backward; `None` where that was not driven.
    pub ratio: [Option<f64>; 2],
    /// What holds the robot back along its body axis on the average, positive against forward driving, N; `None` unless both
    /// directions were driven and currents have signs.
    pub pull: Option<f64>,
    /// Half of the 90 % interval of that, N.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub half: Option<f64>,
}

/// What the frequency of a load goes with, by stretches at unlike speeds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Rhythm {
    /// It is the same at every speed.
    Time,
    /// It goes with the turning of the wheels: so often per turn.
    Wheel(f64),
    /// Speeds are too much alike, or it goes with neither.
    Unknown,
}

/// An inertial unit that tips in the body while the robot drives.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Tipped {
    /// Name of the recording.
    pub recording: String,
    /// When, and the end of the recording, s.
    pub interval: [f64; 2],
    /// By how much its forward axis points up more than before, rad.
    pub tilt: f64,
    /// Half of the 90 % interval of that, rad.
    pub half: f64,
    /// Straight load from then on over the usual one.
    pub ratio: f64,
    /// What a slope of that angle would add to the straight load, or take from it, over the usual one.
    pub of_slope: f64,
}

/// A pull along the body: straight driving takes more one way and less the other.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BodyPull {
    /// Where it pulls, by recording, from and until, s; empty where it does under all driving.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub intervals: BTreeMap<String, Vec<[f64; 2]>>,
    /// Force against forward driving, N.
    pub pull: f64,
    /// Half of its 90 % interval, N.
    pub half: f64,
    /// Straight loads over the usual ones: forward and backward.
    pub ratios: [f64; 2],
    /// Stretches of straight driving that it rests on.
    pub stretches: usize,
    /// The slope that would do the same, rad, where these drives do not tell the two apart.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub may_be_slope: Option<f64>,
}
