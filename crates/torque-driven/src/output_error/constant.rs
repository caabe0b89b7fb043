//! Constants of a robot that are free in a fit.

use robot_model::Robot;
use robot_model::tunable::{Tuning, tunables};

use super::OutputErrorError;
use crate::settings::output_error::{Constants, SETTINGS};

const CONSTANTS: Constants = SETTINGS.constants;

/// A constant of a robot that is free in a fit: `δ` changes it, 0 leaves it as it is.
#[derive(Debug, Clone)]
pub struct Constant {
    name: String,
    apply: fn(&mut Robot<f64>, f64),
    /// `apply` gets `exp(δ)` instead of `δ`.
    by_exponent: bool,
    /// Size of a usual change of `δ`.
    scale: f64,
}

impl Constant {
    /// One of [`tunables`]: a factor is multiplied by `exp(δ)`, to an offset `δ` is added in its unit.
    ///
    /// # Errors
    /// A name that is none of theirs.
    pub fn tunable(id: &str) -> Result<Self, OutputErrorError> {
        let all = tunables::<f64>();
        let found = all.iter().find(|t| t.id == id).ok_or_else(|| OutputErrorError::NoSuchConstant {
            id: id.into(),
            known: all.iter().map(|t| t.id).collect::<Vec<_>>().join(", "),
        })?;
        let scale = if found.tuning == Tuning::Factor { CONSTANTS.factor } else { found.sigma };
        Ok(Self { name: id.into(), apply: found.apply, by_exponent: false, scale })
    }

    /// Any constant that is multiplied: `apply` gets the factor `exp(δ)`.
    ///
    /// ```
    /// let both_sides = torque_driven::output_error::Constant::factor("coulomb", |robot, factor| {
    ///     robot.coulomb = robot.coulomb.map(|torque| torque * factor);
    /// });
    /// ```
    pub fn factor(name: &str, apply: fn(&mut Robot<f64>, f64)) -> Self {
        Self { name: name.into(), apply, by_exponent: true, scale: CONSTANTS.factor }
    }

    /// Any constant to which `apply` adds `δ`, in the constant's unit; `scale` is a usual change of it.
    ///
    /// # Errors
    /// A scale that is not a finite number above 0.
    pub fn offset(name: &str, scale: f64, apply: fn(&mut Robot<f64>, f64)) -> Result<Self, OutputErrorError> {
        if scale.is_finite() && scale > 0.0 {
            Ok(Self { name: name.into(), apply, by_exponent: false, scale })
        } else {
            Err(OutputErrorError::NotPositive { what: format!("the scale of constant '{name}'"), value: scale })
        }
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    pub(super) fn apply(&self, robot: &mut Robot<f64>, delta: f64) {
        (self.apply)(robot, if self.by_exponent { delta.exp() } else { delta });
    }

    /// Finite step of `δ` for a column of the Jacobian.
    pub(super) fn step(&self) -> f64 {
        CONSTANTS.step * self.scale
    }

    pub(super) fn longest_step(&self) -> f64 {
        CONSTANTS.longest * self.scale
    }

    pub(super) fn scale(&self) -> f64 {
        self.scale
    }
}
