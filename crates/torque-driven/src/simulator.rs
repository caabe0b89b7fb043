//! What the user's simulator believes, by its own logs: constants of the robot that it behaves like.
//!
//! A log says nothing of noise, and it need not come from a plant like ours: a fit to it gives the constants with which
//! our plant behaves as the simulator does. Recordings are then compared with that robot, whatever the robot file says.

use inference::robust::NINETY;
use inference::{DiagnosisError, Options};
use robot_model::Robot;
use robot_model::tunable::COUNT as NUISANCES;
use verdict::{Retuned, SimulatorConstants};

use crate::calibrate::{Calibration, Driver, calibrate_on, problem};
use crate::case::Case;
use crate::few_constants::{FewConstants, few_constants};
use crate::fit::Point;
use crate::four_motors;
use crate::retuned::otherwise;
use crate::run::Run;
use crate::settings::preparation::{Logs, SETTINGS};
use crate::windows::Cut;

const LOGS: Logs = SETTINGS.logs;

/// What the logs of a simulator say of its robot.
#[derive(Debug, Clone)]
pub(crate) struct Simulator {
    /// Its constants, from those of the robot file, in their sigmas.
    pub(crate) theta: [f64; NUISANCES],
    /// What of that is told.
    pub(crate) told: SimulatorConstants,
    /// What its logs gain by a motor at each wheel, nats; 0 where the robot file says of the chassis.
    pub(crate) gain_of_four_motors: f64,
}

impl Simulator {
    /// Fits the robot to logs.
    ///
    /// # Errors
    /// When the logs do not determine the robot.
    pub(crate) fn new(
        case: &Case,
        robot: &Robot<f64>,
        logs: &[Cut],
        largest_torque: f64,
        options: &Options,
    ) -> Result<Self, DiagnosisError> {
        let wide = case.sigma.map(|s| LOGS.wider * s);
        let all = fit(robot, &wide, logs, largest_torque, options)?;
        let wider = Case { sigma: wide, ..Case::new(*robot) };
        let problem = problem(robot, &wider, logs, &Calibration::by_file(), largest_torque, options);
        let from_file = |theta: &[f64; NUISANCES], k: usize| {
            let constant = otherwise(robot, &wide, [&[0.0; NUISANCES], theta], k)?;
            // What the simulator's laws differ in form is taken for constants.
            let half_width = NINETY * LOGS.form_error * constant.to.abs();
            let differs = (constant.to - constant.from).abs() > LOGS.told * half_width;
            differs.then_some(Retuned { half_width, sigmas: LOGS.wider * constant.sigmas, ..constant })
        };

        let few = few_constants(&problem, &all);
        let told = match &few {
            Some(FewConstants { theta, free, or }) if free.len() <= 1 => SimulatorConstants {
                constants: free.iter().filter_map(|&k| from_file(theta, k)).collect(),
                or: or.iter().filter_map(|(theta, k)| from_file(theta, *k)).collect(),
                only_together: false,
            },
            several => {
                let theta = several.as_ref().map_or(&all, |few| &few.theta);
                let mut constants: Vec<Retuned> = (0..NUISANCES).filter_map(|k| from_file(theta, k)).collect();
                constants.sort_by(|a, b| b.sigmas.abs().total_cmp(&a.sigmas.abs()));
                SimulatorConstants { constants, or: Vec::new(), only_together: true }
            }
        };
        let theta = few.map_or(all, |few| few.theta);
        let at = Point { theta, ..problem.origin() };
        let gain_of_four_motors =
            if four_motors::is_open(case, robot) { four_motors::gain_of_drives(&problem, &at) } else { 0.0 };
        Ok(Self { theta: theta.map(|x| LOGS.wider * x), told, gain_of_four_motors })
    }
}

/// Constants at which the plant behaves as logs show, from those of `robot`, in sigmas.
///
/// How far a simulator is from a file has nothing to do with how well the robot was measured: `sigma` is wider, and
/// decides what no drive can (a heavier body, or a larger inertia of the motors). Rolling resistance and dry friction are
/// told apart by little: that takes more steps than references do, whose constants are near.
///
/// # Errors
/// When the logs do not determine the robot.
pub(crate) fn fit(
    robot: &Robot<f64>,
    sigma: &[f64; NUISANCES],
    logs: &[Cut],
    largest_torque: f64,
    options: &Options,
) -> Result<[f64; NUISANCES], DiagnosisError> {
    Ok(calibrate_on(Driver::Simulator, robot, sigma, logs, largest_torque, options)?.theta)
}

/// Refuses logs that are no runs on the inputs of a reference or recording: of the same name, or else of the same place in
/// the order.
///
/// # Errors
/// The first difference.
pub(crate) fn check_inputs(case: &Case) -> Result<(), DiagnosisError> {
    let drives: Vec<&Run> = case.recordings.iter().chain(&case.references).collect();
    for (i, log) in case.simulations.iter().enumerate() {
        let named = drives.iter().find(|drive| drive.name == log.name);
        let in_order = drives.get(i).filter(|_| case.simulations.len() == case.recordings.len());
        let Some(drive) = named.or(in_order) else {
            let names: Vec<&str> = drives.iter().map(|d| d.name.as_str()).collect();
            let what = format!(
                "no recording has the name of this log of the simulator; name it after the drive on whose torques it was \
                 simulated ({})",
                names.join(", ")
            );
            return Err(DiagnosisError::Impossible { recording: log.name.clone(), what });
        };
        if let Some(difference) = difference(log, drive) {
            let what = format!(
                "this log of the simulator is no run on the inputs of '{}': {difference}; simulate with the recorded torques",
                drive.name
            );
            return Err(DiagnosisError::Impossible { recording: log.name.clone(), what });
        }
    }
    Ok(())
}

/// The first difference between the inputs of two runs.
fn difference(log: &Run, drive: &Run) -> Option<String> {
    if (log.period / drive.period - 1.0).abs() > LOGS.same_period {
        return Some(format!("its rows are {:.4} s apart, those of the recording {:.4} s", log.period, drive.period));
    }
    let largest = drive.torque.iter().flatten().fold(0.0_f64, |a, t| a.max(t.abs()));
    for (row, (a, b)) in log.torque.iter().zip(&drive.torque).enumerate() {
        let unlike = (0..2).find(|&side| (a[side] - b[side]).abs() > LOGS.same_torque * largest);
        if let Some(side) = unlike {
            return Some(format!(
                "at {:.2} s (row {}) the torque of the {} side is {:.4} N m, in the recording {:.4} N m",
                row as f64 * log.period,
                row + 1,
                ["left", "right"][side],
                a[side],
                b[side]
            ));
        }
    }
    let [ours, theirs] = [log, drive].map(Run::duration);
    ((ours - theirs).abs() > LOGS.same_length).then(|| format!("it lasts {ours:.1} s, the recording {theirs:.1} s"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::blank;

    fn case(simulations: Vec<Run>, recordings: Vec<Run>) -> Case {
        Case { simulations, recordings, ..Case::new(testing::robot()) }
    }

    fn drive(name: &str) -> Run {
        let mut run = blank(600);
        name.clone_into(&mut run.name);
        for (k, t) in run.torque.iter_mut().enumerate() {
            *t = [0.01 * k as f64, 1.0];
        }
        run
    }

    #[test]
    fn a_log_on_the_recorded_torques_is_taken_and_any_other_is_refused_with_the_first_difference() {
        let recording = drive("monday");
        assert!(check_inputs(&case(vec![drive("monday")], vec![recording.clone()])).is_ok());
        assert!(check_inputs(&case(vec![drive("simulated")], vec![recording.clone()])).is_ok(), "by its place");

        let refused = |log: Run, recordings: Vec<Run>| {
            check_inputs(&case(vec![log], recordings)).expect_err("other inputs").to_string()
        };
        let mut other = drive("monday");
        other.torque[250][1] = 3.0;
        let message = refused(other, vec![recording.clone()]);
        assert!(message.contains("at 2.50 s (row 251) the torque of the right side is 3.0000 N m"), "{message}");
        let mut slower = drive("monday");
        slower.period *= 2.0;
        assert!(refused(slower, vec![recording.clone()]).contains("rows are 0.0200 s apart"));
        let mut shorter = drive("monday");
        shorter.torque.truncate(300);
        assert!(refused(shorter, vec![recording.clone()]).contains("lasts 3.0 s"));
        let message = refused(drive("x"), vec![recording, drive("tuesday")]);
        assert!(message.contains("name it after the drive") && message.contains("tuesday"), "{message}");
    }
}
