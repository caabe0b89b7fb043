//! The simulation as a diagnosis would have it: what `export` writes, `simulate` reads and rivals differ in.

use std::collections::BTreeMap;

use robot_model::effect::MAX_PARAMETERS;
use robot_model::presence::{Disc, Presence};
use robot_model::tunable::tunables;
use robot_model::{Active, Effect, Robot, effects};
use serde::{Deserialize, Serialize};

use crate::DiagnosisError;
use crate::response::ResponseModel;

/// What a robot's simulation is to be given: constants re-tuned and effects added.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Correction {
    /// Tuning of each constant by its id ([`robot_model::tunable`]): the logarithm of a factor, or an offset in its unit.
    #[serde(default)]
    pub tuning: BTreeMap<String, f64>,
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
    /// Values by parameter name, in the units of the card; one that is missing is neutral.
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
    pub(crate) const fn of(index: usize) -> Self {
        if index == 0 { Self::Left } else { Self::Right }
    }
}

impl Correction {
    /// The robot with its constants re-tuned. Effects change it further, when a plant is made of both.
    ///
    /// # Errors
    /// When no constant has an id, or a tuning makes a robot that cannot be.
    pub fn robot(&self, robot: &Robot<f64>) -> Result<Robot<f64>, DiagnosisError> {
        let mut out = *robot;
        let known = tunables::<f64>();
        for (id, by) in &self.tuning {
            let constant =
                known.iter().find(|t| t.id == id).ok_or_else(|| DiagnosisError::NoSuchConstant { id: id.clone() })?;
            (constant.apply)(&mut out, *by);
        }
        Ok(out.checked()?)
    }

    /// The effects for the plant of a drive.
    ///
    /// # Errors
    /// As [`EffectAt::active`].
    pub fn active(&self, drive: &str) -> Result<Vec<Active<f64>>, DiagnosisError> {
        self.effects.iter().map(|e| e.active(drive)).collect()
    }
}

impl EffectAt {
    /// The effect of the catalogue.
    ///
    /// # Errors
    /// When the catalogue has none of this id.
    pub fn in_catalogue(&self) -> Result<&'static dyn Effect<f64>, DiagnosisError> {
        let found = effects::catalogue::<f64>().into_iter().find(|e| e.spec().id == self.effect);
        found.ok_or_else(|| DiagnosisError::NoSuchEffect { id: self.effect.clone() })
    }

    /// The effect for the plant of a drive.
    ///
    /// # Errors
    /// When the effect or a parameter is not in the catalogue, or a value is not finite.
    pub fn active(&self, drive: &str) -> Result<Active<f64>, DiagnosisError> {
        let effect = self.in_catalogue()?;
        let parameters = effect.spec().parameters;
        let mut values: Vec<f64> = parameters.iter().take(MAX_PARAMETERS).map(|p| p.neutral).collect();
        for (name, value) in &self.values {
            let at = parameters.iter().position(|p| p.name == name).filter(|_| value.is_finite());
            let at = at.ok_or_else(|| DiagnosisError::NoSuchParameter {
                effect: self.effect.clone(),
                name: name.clone(),
                known: parameters.iter().map(|p| p.name).collect::<Vec<_>>().join(", "),
            })?;
            values[at] = *value;
        }
        let mut presence = Presence { side: self.side.map(|s| s as usize), ..Presence::default() };
        if let Some([x, y, radius]) = self.place {
            presence.disc = Some(Disc { centre: [x, y], radius });
        }
        if let Some(from) = self.from.get(drive) {
            presence.from = *from;
        } else if self.absent.iter().any(|name| name == drive) {
            presence.from = f64::MAX;
        }
        Ok(Active::new(effect, &values, presence))
    }
}
