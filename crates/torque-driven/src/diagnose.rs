//! The whole way of a torque-driven case, from recordings to a verdict.

use robot_model::Robot;

use crate::calibrate::{Calibration, calibrate, problem};
use crate::case::Case;
use crate::decide::decide;
use crate::judged::Judged;
use crate::redundancy::{Redundant, check};
use crate::run::Run;
use crate::search::search;
use crate::windows::{Cut, CutOptions, cut};
use inference::{DiagnosisError, Options};
use verdict::Diagnosis;

use crate::next;

/// What the references of a case teach: enough to diagnose any number of recordings of that robot.
pub struct Calibrated {
    references: Vec<Cut>,
    calibration: Calibration,
    largest_torque: f64,
}

impl Calibrated {
    /// Calibrates the model on the references of a case; its recordings do not matter.
    ///
    /// # Errors
    /// When there is nothing to compare with, or the references do not determine the model.
    pub fn new(case: &Case, options: &Options) -> Result<Self, DiagnosisError> {
        Self::up_to(largest_torque(&case.references), case, options)
    }

    /// The same with effects that scale with the torque probed up to `largest_torque`, N m.
    fn up_to(largest_torque: f64, case: &Case, options: &Options) -> Result<Self, DiagnosisError> {
        if case.references.is_empty() {
            return Err(DiagnosisError::Empty { what: "reference" });
        }
        let robot = case.robot.checked()?;
        let references = cut_all(&case.references, &check(&case.references, &[]), case, &robot, options)?;
        let calibration = calibrate(&robot, &case.sigma, &references, largest_torque, options)?;
        Ok(Self { references, calibration, largest_torque })
    }

    /// Diagnoses the recordings of a case with the same robot and references. `progress` is called
    /// with the stage that begins.
    ///
    /// Where they hold a larger torque than the references, the references are screened anew with that torque, so that the
    /// answer is that of [`diagnose`].
    ///
    /// # Errors
    /// When there is no recording, or one is too short.
    pub fn diagnose(
        &self,
        case: &Case,
        options: &Options,
        progress: &dyn Fn(&str),
    ) -> Result<Diagnosis, DiagnosisError> {
        if case.recordings.is_empty() {
            return Err(DiagnosisError::Empty { what: "recording" });
        }
        let robot = case.robot.checked()?;
        let sensors = check(&case.recordings, &case.references);
        let recordings = cut_all(&case.recordings, &sensors, case, &robot, options)?;
        let largest = largest_torque(&case.recordings).max(self.largest_torque);
        let anew;
        let calibration = if largest > self.largest_torque {
            anew = calibrate(&robot, &case.sigma, &self.references, largest, options)?;
            &anew
        } else {
            &self.calibration
        };
        let problem = problem(&robot, case, &recordings, calibration, largest, options);
        let found = search(&problem, progress);
        let decision = decide(&problem, &found, &calibration.regimes.scatter, calibration.gate.highest());
        progress("comparing on data that was not fitted");
        let answer = Judged {
            case,
            options,
            problem: &problem,
            references: &self.references,
            calibration,
            sensors: &sensors,
            decision: &decision,
        };
        let mut out = answer.diagnosis(&found.retuned, found.screened.clone());
        if let Some(length) = options.next {
            progress("looking for the drive that tells the rivals apart");
            out.next = Some(next::advise(&answer, &found.retuned, length));
        }
        Ok(out)
    }
}

/// Diagnoses a torque-driven case. `progress` is called with the stage that begins.
///
/// # Errors
/// When there is nothing to compare with, or the recordings do not determine the model.
pub fn diagnose(case: &Case, options: &Options, progress: &dyn Fn(&str)) -> Result<Diagnosis, DiagnosisError> {
    progress("calibrating on the references");
    let largest = largest_torque(&case.references).max(largest_torque(&case.recordings));
    Calibrated::up_to(largest, case, options)?.diagnose(case, options, progress)
}

/// Runs without their sensors' faults, cut into segments.
fn cut_all(
    runs: &[Run],
    sensors: &Redundant,
    case: &Case,
    robot: &Robot<f64>,
    options: &Options,
) -> Result<Vec<Cut>, DiagnosisError> {
    let cutting = CutOptions {
        segment: options.segment,
        pose_sigma: case.pose_sigma,
        gyro: sensors.gyro,
        wheel_radius: robot.wheel_radius,
        half_base: [robot.half_wheelbase, robot.half_track],
    };
    runs.iter()
        .map(|run| {
            let c = cut(&sensors.corrected(run), &cutting);
            if c.segments.is_empty() {
                let needed = (2.0 * options.segment / c.period) as usize;
                return Err(DiagnosisError::TooShort { recording: c.name, rows: c.torque.len(), needed });
            }
            Ok(c)
        })
        .collect()
}

fn largest_torque(runs: &[Run]) -> f64 {
    runs.iter().flat_map(|r| &r.torque).flatten().fold(0.0_f64, |a, t| a.max(t.abs()))
}
