//! A case of any kind of robot, and the engine that diagnoses it.

use command_driven::ResponseCase;
use inference::{DiagnosisError, Options};
use speed_driven::SteadyCase;
use torque_driven::Calibrated;
use verdict::Diagnosis;

/// What the user knows and what was recorded, by the kind of robot.
#[derive(Debug, Clone)]
pub enum Case {
    /// Drives are given torques; wheel speeds and the motion of the body come out.
    TorqueDriven(Box<torque_driven::Case>),
    /// Drives are given speeds; the torque that this takes comes out.
    SpeedDriven(Box<SteadyCase>),
    /// Only commands and motion were recorded.
    CommandDriven(Box<ResponseCase>),
}

/// Refuses effects of one's own for robots that no free run of the plant is compared with.
fn refuse_own_effects(case: &Case, options: &Options) -> Result<(), DiagnosisError> {
    let kind = match case {
        Case::TorqueDriven(_) => return Ok(()),
        Case::SpeedDriven(_) => "speed-driven",
        Case::CommandDriven(_) => "command-driven",
    };
    options.known.refused_for(kind)
}

/// Says what physics the simulation of a case left out. `progress` is told the stage that begins.
///
/// # Errors
/// When there is nothing to compare with, or the recordings do not determine an answer.
pub fn diagnose(case: &Case, options: &Options, progress: &dyn Fn(&str)) -> Result<Diagnosis, DiagnosisError> {
    refuse_own_effects(case, options)?;
    match case {
        Case::TorqueDriven(case) => torque_driven::diagnose(case, options, progress),
        Case::SpeedDriven(case) => speed_driven::diagnose_steady(case, options, progress),
        Case::CommandDriven(case) => command_driven::diagnose_response(case, options, progress),
    }
}

/// References of a robot, made ready once for any number of recordings.
pub struct Prepared {
    /// The case whose references these are.
    of: Case,
    /// What the references of a torque-driven robot teach.
    calibrated: Option<Calibrated>,
}

impl Prepared {
    /// Makes the references of a case ready; its recordings do not matter.
    ///
    /// # Errors
    /// When the references do not determine the model.
    pub fn new(case: Case, options: &Options) -> Result<Self, DiagnosisError> {
        refuse_own_effects(&case, options)?;
        let calibrated = match &case {
            Case::TorqueDriven(case) => Some(Calibrated::new(case, options)?),
            Case::SpeedDriven(_) | Case::CommandDriven(_) => None,
        };
        Ok(Self { of: case, calibrated })
    }

    /// Diagnoses the recordings of a case of the same robot; the references are those that were made ready, whatever the
    /// case holds.
    ///
    /// # Errors
    /// As [`diagnose`]; a case of another kind of robot has no recordings for these references.
    pub fn diagnose(
        &self,
        case: Case,
        options: &Options,
        progress: &dyn Fn(&str),
    ) -> Result<Diagnosis, DiagnosisError> {
        match (&self.of, case) {
            (Case::TorqueDriven(of), Case::TorqueDriven(mut case)) => {
                case.references.clone_from(&of.references);
                match &self.calibrated {
                    Some(calibrated) => calibrated.diagnose(&case, options, progress),
                    None => torque_driven::diagnose(&case, options, progress),
                }
            }
            (Case::SpeedDriven(of), Case::SpeedDriven(mut case)) => {
                case.references.clone_from(&of.references);
                diagnose(&Case::SpeedDriven(case), options, progress)
            }
            (Case::CommandDriven(of), Case::CommandDriven(mut case)) => {
                case.references.clone_from(&of.references);
                diagnose(&Case::CommandDriven(case), options, progress)
            }
            _ => Err(DiagnosisError::Empty { what: "recording" }),
        }
    }
}
