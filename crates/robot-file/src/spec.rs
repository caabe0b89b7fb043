//! What a robot file says.

use std::collections::BTreeMap;

use inference::{DiagnosisError, KnownEffects};
use robot_model::{Active, Robot};
use serde::{Deserialize, Serialize};
use verdict::EffectAt;
use verdict::ResponseModel;

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
    /// Whether the file says what it stands on: of four wheels, whether those of a side are coupled.
    pub is_chassis_stated: bool,
    /// What its simulation is given beside these constants.
    pub effects: Vec<EffectAt>,
    /// The effects that may be among them: the catalogue's, and those of one's own.
    pub known: KnownEffects,
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
    /// One sigma of the wheels' radius and of the track, as a share of each.
    pub geometry_sigma: [f64; 2],
}

impl RobotSpec {
    /// The robot with the laws that are adopted, where its file does not hold them already.
    #[must_use]
    pub fn adopting(mut self) -> Self {
        let is_there = |law: &EffectAt| self.effects.iter().any(|held| held.effect == law.effect);
        let adopted: Vec<EffectAt> = self.known.adopted().into_iter().filter(|law| !is_there(law)).collect();
        self.effects.extend(adopted);
        self
    }

    /// Its effects for the plant of a drive.
    ///
    /// # Errors
    /// As [`KnownEffects::active`].
    pub fn active(&self, drive: &str) -> Result<Vec<Active<f64>>, DiagnosisError> {
        self.effects.iter().map(|e| self.known.active(e, drive)).collect()
    }
}
