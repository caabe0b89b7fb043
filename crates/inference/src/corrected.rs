//! A correction as a robot and effects that a plant takes.

use robot_model::tunable::tunables;
use robot_model::{Active, Chassis, Robot};
use verdict::Correction;

use crate::{DiagnosisError, KnownEffects};

/// The robot of a correction, and its effects.
pub trait Corrected {
    /// The robot with its constants re-tuned, on the chassis that was found. Effects change it further, when a plant is made of both.
    ///
    /// # Errors
    /// When no constant has an id, or a tuning makes a robot that cannot be.
    fn robot(&self, robot: &Robot<f64>) -> Result<Robot<f64>, DiagnosisError>;

    /// The effects for the plant of a drive.
    ///
    /// # Errors
    /// As [`KnownEffects::active`].
    fn active(&self, known: KnownEffects, drive: &str) -> Result<Vec<Active<f64>>, DiagnosisError>;
}

impl Corrected for Correction {
    fn robot(&self, robot: &Robot<f64>) -> Result<Robot<f64>, DiagnosisError> {
        let mut out = *robot;
        if self.has_four_motors {
            out.chassis = Chassis::FourMotors;
        }
        let known = tunables::<f64>();
        for (id, by) in &self.tuning {
            let constant =
                known.iter().find(|t| t.id == id).ok_or_else(|| DiagnosisError::NoSuchConstant { id: id.clone() })?;
            (constant.apply)(&mut out, *by);
        }
        Ok(out.checked()?)
    }

    fn active(&self, known: KnownEffects, drive: &str) -> Result<Vec<Active<f64>>, DiagnosisError> {
        self.effects.iter().map(|e| known.active(e, drive)).collect()
    }
}
