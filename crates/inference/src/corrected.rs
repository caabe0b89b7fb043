//! A correction as a robot and effects that a plant takes.

use robot_model::effect::MAX_PARAMETERS;
use robot_model::presence::{Disc, Presence};
use robot_model::tunable::tunables;
use robot_model::{Active, Effect, Robot, effects};
use verdict::{Correction, EffectAt};

use crate::DiagnosisError;

/// The robot of a correction, and its effects.
pub trait Corrected {
    /// The robot with its constants re-tuned. Effects change it further, when a plant is made of both.
    ///
    /// # Errors
    /// When no constant has an id, or a tuning makes a robot that cannot be.
    fn robot(&self, robot: &Robot<f64>) -> Result<Robot<f64>, DiagnosisError>;

    /// The effects for the plant of a drive.
    ///
    /// # Errors
    /// As [`active`].
    fn active(&self, drive: &str) -> Result<Vec<Active<f64>>, DiagnosisError>;
}

impl Corrected for Correction {
    fn robot(&self, robot: &Robot<f64>) -> Result<Robot<f64>, DiagnosisError> {
        let mut out = *robot;
        let known = tunables::<f64>();
        for (id, by) in &self.tuning {
            let constant =
                known.iter().find(|t| t.id == id).ok_or_else(|| DiagnosisError::NoSuchConstant { id: id.clone() })?;
            (constant.apply)(&mut out, *by);
        }
        Ok(out.checked()?)
    }

    fn active(&self, drive: &str) -> Result<Vec<Active<f64>>, DiagnosisError> {
        self.effects.iter().map(|e| active(e, drive)).collect()
    }
}

/// The effect of the catalogue.
///
/// # Errors
/// When the catalogue has none of this id.
pub fn in_catalogue(at: &EffectAt) -> Result<&'static dyn Effect<f64>, DiagnosisError> {
    let found = effects::catalogue::<f64>().into_iter().find(|e| e.spec().id == at.effect);
    found.ok_or_else(|| DiagnosisError::NoSuchEffect { id: at.effect.clone() })
}

/// The effect for the plant of a drive.
///
/// # Errors
/// When the effect or a parameter is not in the catalogue, or a value is not finite.
pub fn active(at: &EffectAt, drive: &str) -> Result<Active<f64>, DiagnosisError> {
    let effect = in_catalogue(at)?;
    let parameters = effect.spec().parameters;
    let mut values: Vec<f64> = parameters.iter().take(MAX_PARAMETERS).map(|p| p.neutral).collect();
    for (name, value) in &at.values {
        let index = parameters.iter().position(|p| p.name == name).filter(|_| value.is_finite());
        let index = index.ok_or_else(|| DiagnosisError::NoSuchParameter {
            effect: at.effect.clone(),
            name: name.clone(),
            known: parameters.iter().map(|p| p.name).collect::<Vec<_>>().join(", "),
        })?;
        values[index] = *value;
    }
    let mut presence = Presence { side: at.side.map(|s| s as usize), ..Presence::default() };
    if let Some([x, y, radius]) = at.place {
        presence.disc = Some(Disc { centre: [x, y], radius });
    }
    if let Some(from) = at.from.get(drive) {
        presence.from = *from;
    } else if at.absent.iter().any(|name| name == drive) {
        presence.from = f64::MAX;
    }
    Ok(Active::new(effect, &values, presence))
}
