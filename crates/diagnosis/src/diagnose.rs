//! The whole way of a torque-driven case, from recordings to a verdict.

use crate::answer::Answer;
use crate::calibrate::{Calibration, calibrate};
use crate::case::Case;
use crate::decide::decide;
use crate::drives::Drives;
use crate::fit::Problem;
use crate::motion::GyroError;
use crate::redundancy::{Redundant, check};
use crate::run::Run;
use crate::search::search;
use crate::verdict::Diagnosis;
use crate::windows::{Cut, CutOptions, cut};
use crate::{DiagnosisError, Options, next};

/// Version of the diagnosis' JSON.
pub(crate) const FORMAT: u32 = 2;

/// Diagnoses a torque-driven case. `progress` is told the stage that begins.
///
/// # Errors
/// When there is nothing to compare with, or the recordings do not determine the model.
pub fn diagnose(case: &Case, options: &Options, progress: &dyn Fn(&str)) -> Result<Diagnosis, DiagnosisError> {
    if case.references.is_empty() {
        return Err(DiagnosisError::Empty { what: "reference" });
    }
    if case.recordings.is_empty() {
        return Err(DiagnosisError::Empty { what: "recording" });
    }
    let robot = case.robot.checked()?;
    progress("checking the sensors against each other");
    let sensors = check(&case.recordings, &case.references);
    let reference_sensors = check(&case.references, &[]);
    let cutting = |gyro: GyroError| CutOptions {
        segment: options.segment,
        pose_sigma: case.pose_sigma,
        gyro,
        wheel_radius: robot.wheel_radius,
        half_base: [robot.half_wheelbase, robot.half_track],
    };
    let cut_all = |runs: &[Run], sensors: &Redundant| -> Vec<Cut> {
        runs.iter().map(|r| cut(&sensors.corrected(r), &cutting(sensors.gyro))).collect()
    };
    let references = cut_all(&case.references, &reference_sensors);
    let recordings = cut_all(&case.recordings, &sensors);
    for c in references.iter().chain(&recordings) {
        if c.segments.is_empty() {
            let rows = c.torque.len();
            let needed = (2.0 * options.segment / c.period) as usize;
            return Err(DiagnosisError::TooShort { recording: c.name.clone(), rows, needed });
        }
    }
    let largest = case
        .recordings
        .iter()
        .chain(&case.references)
        .flat_map(|r| &r.torque)
        .flatten()
        .fold(0.0_f64, |a, t| a.max(t.abs()));
    progress("calibrating on the references");
    let calibration = calibrate(&robot, &case.sigma, &references, largest, options)?;
    let problem = problem(&robot, case, &recordings, &calibration, largest, options);
    let found = search(&problem, progress);
    let decision = decide(&problem, &found, &calibration.regimes.scatter, calibration.gate.highest());
    progress("comparing on data that was not fitted");
    let answer = Answer {
        case,
        options,
        problem: &problem,
        references: &references,
        calibration: &calibration,
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

/// What the recordings are compared with after calibration.
pub(crate) fn problem<'a>(
    robot: &'a robot_model::Robot<f64>,
    case: &Case,
    cuts: &'a [Cut],
    calibration: &Calibration,
    largest_torque: f64,
    options: &Options,
) -> Problem<'a> {
    Problem {
        robot,
        sigma: case.sigma,
        cuts,
        variance: calibration.variance,
        regime: calibration.regimes.of(cuts),
        information: calibration.information.clone(),
        centre: calibration.theta,
        spread: calibration.spread,
        temper: options.temper,
        kappa: options.kappa,
        step: options.step,
        largest_torque,
        drives: Drives::default(),
    }
}
