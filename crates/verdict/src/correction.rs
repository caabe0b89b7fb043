//! The simulation as a diagnosis would have it: what `export` writes, `simulate` reads and rivals differ in.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::ResponseModel;

/// What a robot's simulation is to be given: constants re-tuned and effects added.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Correction {
    /// Tuning of each constant by its id (`robot_model::tunable`): the logarithm of a factor, or an offset in its unit.
    #[serde(default)]
    pub tuning: BTreeMap<String, f64>,
    /// Whether each wheel of four has a motor of its own, where the robot file says of neither that nor of coupled wheels.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub has_four_motors: bool,
    /// Effects, at values.
    #[serde(default)]
    pub effects: Vec<EffectAt>,
    /// Response to commands, of a command-driven robot.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub response: Option<ResponseModel>,
}

/// An effect of the catalogue at values, present somewhere.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EffectAt {
    /// Its id.
    pub effect: String,
    /// Values by parameter name, in the units of its specification; one that is missing is neutral.
    pub values: BTreeMap<String, f64>,
    /// Only on this side.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub side: Option<Side>,
    /// Only under wheels in this disc: x, y, radius, m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub place: Option<[f64; 3]>,
    /// Where it began at an instant: when in each recording, s after its first row.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub from: BTreeMap<String, f64>,
    /// Recordings in which it did not begin. Drives that neither this nor `from` names have it throughout.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub absent: Vec<String>,
}

/// A side of the robot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Side {
    /// The left one, 0 in arrays.
    Left,
    /// The right one, 1 in arrays.
    Right,
}

impl Side {
    /// Of an index, 0 being left.
    pub const fn of(index: usize) -> Self {
        if index == 0 { Self::Left } else { Self::Right }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_of_two_sides_is_the_left_one_in_files_too() {
        assert_eq!([0, 1].map(Side::of), [Side::Left, Side::Right]);
        assert_eq!(serde_json::to_string(&[0, 1].map(Side::of)).expect("plain data"), r#"["left","right"]"#);
    }
}
