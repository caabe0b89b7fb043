//! Synthetic drives for the unit tests.

use robot_model::{Active, Plant, Robot, State};
use sim::rollout::{Commanded, Grid, Hold, Rollout, Visitor};
use std::convert::Infallible;

use faer::Mat;
use robot_model::tunable::COUNT as NUISANCES;

use testing::{PERIOD, robot};

use crate::between_visits::Moves;
use crate::calibrate::Calibration;
use crate::case::Case;
use crate::channel::Channels;
use crate::decision::Decision;
use crate::drives::Drives;
use crate::fit::Problem;
use crate::judged::Judged;
use crate::motion::GyroError;
use crate::null_scores::NullScores;
use crate::redundancy::Redundant;
use crate::regimes::Regimes;
use crate::run::Run;
use crate::settings::fit::SETTINGS;
use crate::windows::{Cut, CutOptions};
use inference::Options;
use inference::hypothesis::Dose;
use robot_model::tunable::usual_sigma;

/// What steps of a decision are asked with: a case without references, what its calibration says, and the decision itself.
pub(crate) struct Asked<'a> {
    case: Case,
    options: Options,
    calibration: Calibration,
    sensors: Redundant,
    problem: &'a Problem<'a>,
    decision: Decision,
}

impl<'a> Asked<'a> {
    pub(crate) fn new(problem: &'a Problem<'a>, decision: Decision) -> Self {
        Self {
            case: Case { pose_sigma: 1e-4, ..Case::new(*problem.robot) },
            options: Options::default(),
            calibration: calibration(problem),
            sensors: Redundant::default(),
            problem,
            decision,
        }
    }

    pub(crate) fn judged(&self) -> Judged<'_> {
        Judged {
            case: &self.case,
            options: &self.options,
            problem: self.problem,
            references: &[],
            visits: &[],
            calibration: &self.calibration,
            sensors: &self.sensors,
            simulator: None,
            decision: &self.decision,
        }
    }
}

/// Segments of 2 s of this robot.
pub(crate) fn cutting() -> CutOptions {
    let r = robot();
    CutOptions {
        segment: 2.0,
        pose_sigma: 1e-4,
        gyro: GyroError::default(),
        wheel_radius: r.wheel_radius,
        contacts: r.contacts(),
    }
}

/// A run whose sensors show nothing yet.
pub(crate) fn blank(rows: usize) -> Run {
    let nothing = || vec![None; rows];
    Run {
        name: "synthetic".to_owned(),
        from: 0.0,
        visit: None,
        period: PERIOD,
        torque: vec![[0.0; 2]; rows],
        angle: [nothing(), nothing()],
        gyro: nothing(),
        accel: [nothing(), nothing()],
        pose: [nothing(), nothing(), nothing()],
        held_torques: 0,
    }
}

/// A drive of the plant itself in curves, seen by perfect sensors; the pose comes in every tenth row.
pub(crate) fn driven(robot: &Robot<f64>, doses: &[Dose], seconds: f64) -> Run {
    seen(robot, doses, seconds, true)
}

/// The same drive as a simulator logs it: every sample is of its row's instant.
pub(crate) fn logged(robot: &Robot<f64>, seconds: f64) -> Run {
    seen(robot, &[], seconds, false)
}

fn seen(robot: &Robot<f64>, doses: &[Dose], seconds: f64, late: bool) -> Run {
    let rows = (seconds / PERIOD).round() as usize;
    let mut run = blank(rows);
    for (k, torque) in run.torque.iter_mut().enumerate() {
        let t = k as f64 * PERIOD;
        let (both, turn) = (1.3 + 0.8 * (0.9 * t).sin(), 3.5 * (0.7 * t).sin());
        *torque = [both - turn, both + turn];
    }
    let active: Vec<Active<f64>> = doses.iter().map(Dose::active).collect();
    let grid = Grid { period: PERIOD, substeps: 10 };
    let plant = Plant::new(robot, &active, grid.step());
    let hold = Hold::new(grid, plant.drive().delay);
    let torque = run.torque.clone();
    let mut sensors = Sensors { run, late: late.then_some(grid.substeps / 2) };
    let Ok(()) = Rollout::new(&plant, rows, grid.substeps).run(
        &mut State::default(),
        &mut Commanded(|row, step| hold.command(&torque, row, step)),
        &mut sensors,
    );
    sensors.run
}

/// Perfect sensors that write a run.
struct Sensors {
    run: Run,
    /// Steps to the middle of a row, where samples of other clocks are taken; `None` of a simulator.
    late: Option<usize>,
}

impl Sensors {
    /// Writes what other sensors than encoders show into a row.
    fn write(&mut self, row: usize, plant: &Plant<'_, f64>, s: &State<f64>) {
        let run = &mut self.run;
        let mut r = plant.readings(s);
        plant.sense(&mut r);
        run.gyro[row] = Some(r.gyro);
        run.accel[0][row] = Some(r.accel[0]);
        run.accel[1][row] = Some(r.accel[1]);
        if row % 10 == 1 {
            run.pose[0][row] = Some(s.position[0]);
            run.pose[1][row] = Some(s.position[1]);
            run.pose[2][row] = Some(s.heading[1].atan2(s.heading[0]));
        }
    }
}

impl Visitor<f64> for Sensors {
    type Stop = Infallible;

    fn begin(&mut self, k: usize, plant: &Plant<'_, f64>, s: &mut State<f64>) -> Result<(), Infallible> {
        self.run.angle[0][k] = Some(s.wheel_angle[0]);
        self.run.angle[1][k] = Some(s.wheel_angle[1]);
        if self.late.is_none() {
            self.write(k, plant, s);
        }
        Ok(())
    }

    fn step(&mut self, k: usize, step: usize, plant: &Plant<'_, f64>, s: &State<f64>) {
        // A sample belongs half a row before the row it is written in.
        if self.late == Some(step + 1) && k + 1 < self.run.torque.len() {
            self.write(k + 1, plant, s);
        }
    }
}

/// What a calibration on typical references would leave.
pub(crate) fn problem<'a>(robot: &'a Robot<f64>, cuts: &'a [Cut]) -> Problem<'a> {
    let options = Options::default();
    Problem {
        robot,
        sigma: usual_sigma(),
        cuts,
        has_references: true,
        constants_are_loose: false,
        variance: Channels::from(SETTINGS.calibration.first_sigma).map(|s| s * s),
        regime: cuts.iter().map(|c| vec![1.0; c.segments.len()]).collect(),
        information: Mat::identity(NUISANCES, NUISANCES),
        centre: [0.0; NUISANCES],
        spread: SETTINGS.calibration.usual_spread,
        visits: Vec::new(),
        moves: 1.0,
        likelihood_power: options.likelihood_power,
        outlier_scale: options.outlier_scale,
        step: options.step,
        largest_torque: 5.0,
        same_robot: false,
        known: options.known,
        without: None,
        drives: Drives::default(),
    }
}

/// A calibration that has taught a problem all that it knows.
pub(crate) fn calibration(p: &Problem<'_>) -> Calibration {
    Calibration {
        theta: p.centre,
        information: p.information.clone(),
        variance: p.variance,
        spread: p.spread,
        regimes: Regimes::default(),
        null_scores: NullScores::default(),
        moves: Moves::default(),
    }
}
