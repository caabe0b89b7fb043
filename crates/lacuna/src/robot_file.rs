//! Robot files: TOML or JSON with value, unit, one sigma and source for each parameter.

use std::collections::BTreeMap;
use std::path::Path;

use inference::DiagnosisError;
use recordings::{Spot, suggest};
use robot_model::{Active, Robot};
use serde::{Deserialize, Serialize};
use verdict::EffectAt;
use verdict::ResponseModel;

use crate::RobotFileError;
use crate::flat_robot::FlatRobot;
use crate::robot_parameters::File;
use crate::robot_text::RobotText;

/// What is imposed and what comes out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Causality {
    /// Torque in; wheel speeds and body motion out.
    TorqueDriven,
    /// A drive imposes the wheel speeds; body motion and the torque that it takes come out.
    SpeedDriven,
    /// Wheel speeds are commanded; wheel speeds and body motion come out, no torque is known.
    CommandDriven,
}

impl Causality {
    /// As in a robot file.
    pub const fn name(self) -> &'static str {
        match self {
            Self::TorqueDriven => "torque-driven",
            Self::SpeedDriven => "speed-driven",
            Self::CommandDriven => "command-driven",
        }
    }

    /// Whether a diagnosis needs drives in which the simulation was right: the others are compared with the robot file.
    pub const fn needs_references(self) -> bool {
        matches!(self, Self::TorqueDriven)
    }
}

/// What a robot file says.
#[derive(Debug, Clone)]
pub struct RobotSpec {
    /// Name of the robot.
    pub name: String,
    /// What it is, for people.
    pub description: Option<String>,
    /// Torque-driven, speed-driven or command-driven.
    pub causality: Causality,
    /// The model.
    pub robot: Robot<f64>,
    /// What its simulation is given beside these constants.
    pub effects: Vec<EffectAt>,
    /// Response to commands, of a command-driven robot; without one, the wheels do what is commanded.
    pub response: Option<ResponseModel>,
    /// Where each parameter comes from, by its name in robot files.
    pub sources: BTreeMap<&'static str, String>,
    /// One sigma of each tunable: relative for factors, absolute for offsets.
    pub sigma: [f64; robot_model::tunable::COUNT],
    /// Noise of the pose sensor, m.
    pub pose_sigma: f64,
    /// Torque at the wheels of a side per ampere, and its one sigma, when currents are recorded.
    pub torque_per_current: Option<[f64; 2]>,
}

/// Noise of a pose sensor of which the robot file says nothing, m.
pub(crate) const USUAL_POSE_SIGMA: f64 = 0.004;

/// Robots that are built in.
pub const BUILT_IN: &[(&str, &str)] = &[
    ("husky-a200", include_str!("../robots/husky-a200.toml")),
    ("kobuki", include_str!("../robots/kobuki.toml")),
    ("husky-drive", include_str!("../robots/husky-drive.toml")),
    ("warthog-drive", include_str!("../robots/warthog-drive.toml")),
    ("hendzel-trojnacki-2014", include_str!("../robots/hendzel-trojnacki-2014.toml")),
];

impl RobotSpec {
    /// Its effects for the plant of a drive.
    ///
    /// # Errors
    /// As [`inference::active`].
    pub fn active(&self, drive: &str) -> Result<Vec<Active<f64>>, DiagnosisError> {
        self.effects.iter().map(|e| inference::active(e, drive)).collect()
    }

    /// A built-in robot.
    ///
    /// # Errors
    /// When there is none of this name.
    pub fn built_in(name: &str) -> Result<Self, RobotFileError> {
        let (_, text) = BUILT_IN.iter().find(|b| b.0 == name).ok_or_else(|| {
            let hint = suggest::hint(name, &BUILT_IN.iter().map(|b| b.0).collect::<Vec<_>>());
            RobotFileError::Unknown { name: name.to_owned(), hint }
        })?;
        Self::parse(&format!("{name}.toml"), text)
    }

    /// Reads a robot file; JSON when its name ends so, else TOML.
    ///
    /// JSON without `parameters`, `name` and `causality` is taken in the flat form.
    ///
    /// # Errors
    /// Syntax, unknown keys, units and values, each with file and place.
    pub fn parse(file: &str, text: &str) -> Result<Self, RobotFileError> {
        let source = RobotText { file, text };
        if text.trim().is_empty() {
            return Err(RobotFileError::Empty { place: Spot::file(file) });
        }
        let json = Path::new(file).extension().is_some_and(|e| e.eq_ignore_ascii_case("json"));
        if !json {
            let parsed: File = toml::from_str(text).map_err(|e| source.toml(&e))?;
            return parsed.spec(source);
        }
        let value: serde_json::Value = serde_json::from_str(text).map_err(|e| source.json(&e))?;
        let full = ["parameters", "name", "causality"].iter().any(|key| value.get(key).is_some());
        if full {
            let parsed: File = serde_json::from_str(text).map_err(|e| source.json(&e))?;
            parsed.spec(source)
        } else {
            let flat: FlatRobot = serde_json::from_str(text).map_err(|e| source.json(&e))?;
            flat.spec(source)
        }
    }
}
