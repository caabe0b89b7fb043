//! A robot from the logs of a simulator alone: constants at which our plant behaves as the simulator does.

use robot_model::Robot;
use robot_model::tunable::{COUNT as NUISANCES, Tuning, tunables, tuned};

use crate::calibrate::{Calibration, problem};
use crate::case::Case;
use crate::diagnose::cut_all;
use crate::few_constants::errors;
use crate::redundancy::Redundant;
use crate::retuned::constant_of;
use crate::rms::motion;
use crate::run::Run;
use crate::run::largest_torque;
use crate::settings::preparation::{Logs, SETTINGS};
use crate::simulator::fit;
use inference::{DiagnosisError, Options};

const LOGS: Logs = SETTINGS.logs;

/// A robot that behaves as a simulator does.
///
/// Its constants do so together; one of them alone may be off by tens of per cent, for a heavier body shows as a larger
/// inertia of the motors does, and rolling resistance as dry friction: no interval is told.
#[derive(Debug, Clone)]
pub struct FittedRobot {
    /// It.
    pub robot: Robot<f64>,
    /// Every constant that was free.
    pub constants: Vec<FittedConstant>,
    /// Rms error of free runs over 2 s from measured states, of the robot that was started from and of this one: wheel
    /// speed, rad/s, and yaw rate, rad/s.
    pub errors: [[f64; 2]; 2],
    /// Rms wheel speed and yaw rate of the logs, rad/s.
    pub motion: [f64; 2],
}

/// A constant that was fitted.
#[derive(Debug, Clone, PartialEq)]
pub struct FittedConstant {
    /// As in robot files.
    pub id: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Where the fit started.
    pub from: f64,
    /// Where it ended.
    pub to: f64,
}

impl FittedRobot {
    /// Whether it behaves as the simulator does, but for a small share of the motion or what sensors of usual noise would
    /// not show.
    pub fn is_alike(&self) -> bool {
        let [_, after] = self.errors;
        (0..2).all(|q| after[q] <= (LOGS.alike * self.motion[q]).max(LOGS.invisible[q]))
    }
}

/// Fits the constants of a robot to logs of a simulator: free runs of 2 s from measured states, as in a diagnosis.
///
/// `start` must have the wheels where the simulator's robot has them, and about its mass; the torques are taken as exact.
/// The plant need not be the simulator's: what its laws do otherwise is taken into the constants.
///
/// # Errors
/// When there is no log, one is too short, or they do not determine the robot.
pub fn fit_logs(start: &Robot<f64>, logs: &[Run], options: &Options) -> Result<FittedRobot, DiagnosisError> {
    if logs.is_empty() {
        return Err(DiagnosisError::Empty { what: "log of a simulator" });
    }
    let robot = start.checked()?;
    let sigma = wide_sigma().map(|s| LOGS.wider * s);
    let case = Case { sigma, ..Case::new(robot) };
    let recorded: Vec<Run> = logs.iter().map(Run::as_recorded).collect();
    let cuts = cut_all(&recorded, &Redundant::default(), &case, &robot, options)?;
    let largest = largest_torque(logs);
    let theta = fit(&robot, &sigma, &cuts, largest, options)?;
    let fitted = tuned(&robot, &sigma, &theta).checked()?;

    // How far free runs are off, before and after.
    let by_file = Calibration::by_file();
    let problem = problem(&robot, &case, &cuts, &by_file, largest, options);
    let errors = [[0.0; NUISANCES], theta].map(|theta| errors(&problem, &theta));

    let free = tunables::<f64>().into_iter().zip(sigma).filter(|(_, sigma)| *sigma > LOGS.wider * LOGS.exact);
    let constants = free.filter_map(|(tunable, _)| {
        let constant = constant_of(&tunable)?;
        let [from, to] = [&robot, &fitted].map(|r| (constant.get)(r));
        Some(FittedConstant { id: constant.id, unit: constant.unit, from, to })
    });
    Ok(FittedRobot { robot: fitted, constants: constants.collect(), errors, motion: motion(&cuts) })
}

/// How well the constants of a robot are known of which only size and mass are: the mass as usual, other factors hardly,
/// the torque exactly.
fn wide_sigma() -> [f64; NUISANCES] {
    tunables::<f64>().map(|t| match (t.id, t.tuning) {
        ("torque_constant", _) => LOGS.exact,
        ("mass", _) | (_, Tuning::Offset) => t.sigma,
        (_, Tuning::Factor) => t.sigma.max(LOGS.unknown_factor),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::logged;
    use testing::robot;

    #[test]
    fn logs_of_another_robot_give_one_that_behaves_alike() {
        let mut truth = robot();
        truth.mass *= 1.05;
        truth.yaw_inertia *= 1.3;
        truth.rolling_resistance *= 1.6;
        truth.coulomb = [0.5; 2];
        let fitted = fit_logs(&robot(), &[logged(&truth, 40.0)], &Options::default()).expect("a robot");
        let [before, after] = fitted.errors;
        assert!(fitted.is_alike() && after[0] < 0.02 * before[0] && after[1] < 0.1 * before[1], "{before:?} {after:?}");
        assert!(fitted.constants.iter().all(|c| c.id != "torque_gain"), "the torque is exact");
        // What a drive does tell: friction and rolling resistance together.
        let drag =
            |r: &Robot<f64>| r.rolling_resistance * r.mass * r.gravity * r.wheel_radius + r.coulomb[0] + r.coulomb[1];
        approx::assert_relative_eq!(drag(&fitted.robot), drag(&truth), max_relative = 0.03);
    }

    #[test]
    fn a_robot_of_another_size_is_not_alike_and_no_log_is_none() {
        let mut truth = robot();
        truth.half_track *= 2.0;
        truth.wheel_radius *= 2.5;
        let fitted = fit_logs(&robot(), &[logged(&truth, 40.0)], &Options::default()).expect("a robot");
        assert!(!fitted.is_alike(), "{fitted:?}");
        assert!(matches!(fit_logs(&robot(), &[], &Options::default()), Err(DiagnosisError::Empty { .. })));
    }
}
