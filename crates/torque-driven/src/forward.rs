//! Simulating drives: from inputs to the recording that the robot's sensors would make, and to forecasts of held-out
//! drives.

use recordings::{Channel, Clock, Recording, Signal};
use robot_model::{Active, Plant, Robot, State};
use sim::rollout::{AtSpeed, Commanded, Grid, Hold, Ramp, Rollout, Start, Visitor};

use crate::case::{HeldOut, Restart};
use crate::motion::GyroError;
use crate::predict::predict;
use crate::settings::fit::SETTINGS;
use inference::{DiagnosisError, Options};
use verdict::Prediction;

/// Integration step of a speed-driven robot, s.
const STEP_AT_SPEED: f64 = SETTINGS.simulation.step_at_speed;

/// Simulates a torque-driven robot on the commanded torques of a recording.
///
/// It starts in the state of the first row where all of it was recorded (pose, body velocity, gyro, wheels), else at rest
/// at the origin. Out comes a recording on the rows of the torque: what ideal sensors show, with the sensor faults
/// among `effects` applied; wheel angles are the integral of the shown speeds.
///
/// # Errors
/// When torque is missing, or the simulation does not stay finite.
pub fn simulate(
    robot: &Robot<f64>,
    effects: &[Active<f64>],
    inputs: &Recording,
    options: &Options,
) -> Result<Recording, DiagnosisError> {
    let held = HeldOut::inputs(inputs)?;
    let grid = Grid::nearest(held.period, options.step);
    let plant = Plant::new(robot, effects, grid.step());
    let hold = Hold::new(grid, plant.drive().delay);

    let mut s = State::default();
    if let Some(first) = held.restarts.first().filter(|r| r.row == 0) {
        first.start(gyro_error(&plant)).set(&plant, &mut s);
    }

    let mut written = Written { sheet: Sheet::new(inputs.name(), &held.stamps), torque: &held.torque };
    Rollout::new(&plant, held.torque.len(), grid.substeps).run(
        &mut s,
        &mut Commanded(|row, step| hold.command(&held.torque, row, step)),
        &mut written,
    )?;
    written.sheet.recording()
}

/// Simulates a speed-driven robot on the measured (or commanded) wheel speeds of a recording: out comes what it takes,
/// and how the body moves, from rest at the origin. Between rows the speeds are interpolated linearly.
///
/// # Errors
/// When speeds are missing, or the simulation does not stay finite.
pub fn simulate_at_speed(
    robot: &Robot<f64>,
    effects: &[Active<f64>],
    inputs: &Recording,
) -> Result<Recording, DiagnosisError> {
    let missing = || DiagnosisError::MissingSignal {
        recording: inputs.name().to_owned(),
        what: "wheel_speed or command_speed of both sides",
    };
    let pair = |l, r| inputs.get(l).zip(inputs.get(r));
    let (left, right) = pair(Signal::WheelSpeedLeft, Signal::WheelSpeedRight)
        .or_else(|| pair(Signal::CommandSpeedLeft, Signal::CommandSpeedRight))
        .ok_or_else(missing)?;
    let rows: Vec<(i64, [f64; 2])> = left
        .samples()
        .filter_map(|(t, l)| Some((t, [l, right.values()[right.t_ns().binary_search(&t).ok()?]])))
        .collect();
    if rows.len() < 2 {
        return Err(DiagnosisError::TooShort { recording: inputs.name().to_owned(), rows: rows.len(), needed: 2 });
    }

    let stamps: Vec<i64> = rows.iter().map(|r| r.0).collect();
    let mut out = Sheet::new(inputs.name(), &stamps);
    let mut s = State::default();
    let at_rest = Plant::new(robot, effects, STEP_AT_SPEED);
    out.row(&at_rest, &s, [f64::NAN; 2])?;
    for pair in rows.windows(2) {
        let grid = Grid::at_most((pair[1].0 - pair[0].0) as f64 * 1e-9, STEP_AT_SPEED);
        let plant = Plant::new(robot, effects, grid.step());
        let ramp = Ramp::new([pair[0].1, pair[1].1], grid);
        let Ok(()) = Rollout::new(&plant, 1, grid.substeps).run(&mut s, &mut AtSpeed(|_, step| ramp.at(step)), &mut ());
        out.row(&plant, &s, [f64::NAN; 2])?;
    }
    out.recording()
}

/// Forecasts a held-out drive of a torque-driven robot from its inputs, freely from restart to restart.
pub fn forecast(robot: &Robot<f64>, effects: &[Active<f64>], held: &HeldOut, options: &Options) -> Prediction {
    let gyro = gyro_error(&Plant::new(robot, effects, options.step));
    predict(held, robot, effects, gyro, options.step)
}

/// What the active sensor faults make of a true yaw rate.
fn gyro_error(plant: &Plant<'_, f64>) -> GyroError {
    let shown = |gyro: f64| {
        let mut readings = robot_model::effect::Readings { gyro, ..Default::default() };
        plant.sense(&mut readings);
        readings.gyro
    };
    let bias = shown(0.0);
    GyroError { bias, scale: shown(1.0) - bias - 1.0 }
}

impl Restart {
    /// The motion behind it, the gyro's error taken off.
    pub(crate) fn start(&self, gyro: GyroError) -> Start {
        Start {
            wheel_speed: self.wheel_speed,
            wheel_angle: self.wheel_angle,
            yaw_rate: (self.gyro - gyro.bias) / (1.0 + gyro.scale),
            velocity: self.velocity,
            position: [self.pose[0], self.pose[1]],
            yaw: self.pose[2],
        }
    }
}

/// What is written of a simulated drive, in the order of a row.
const SIGNALS: [Signal; 14] = [
    Signal::WheelSpeedLeft,
    Signal::WheelSpeedRight,
    Signal::WheelAngleLeft,
    Signal::WheelAngleRight,
    Signal::TorqueLeft,
    Signal::TorqueRight,
    Signal::GyroZ,
    Signal::AccelX,
    Signal::AccelY,
    Signal::PoseX,
    Signal::PoseY,
    Signal::PoseYaw,
    Signal::BodyVx,
    Signal::BodyVy,
];

/// Rows of a simulated drive.
struct Sheet<'a> {
    name: &'a str,
    stamps: &'a [i64],
    columns: [Vec<f64>; SIGNALS.len()],
    /// Shown wheel angles and heading, which grow beyond a turn, rad.
    angle: [f64; 2],
    yaw: f64,
}

/// A sheet with the commands of its rows.
struct Written<'a> {
    sheet: Sheet<'a>,
    torque: &'a [[f64; 2]],
}

impl Visitor<f64> for Written<'_> {
    type Stop = DiagnosisError;

    fn begin(&mut self, row: usize, plant: &Plant<'_, f64>, s: &mut State<f64>) -> Result<(), DiagnosisError> {
        self.sheet.row(plant, s, self.torque[row])
    }
}

impl<'a> Sheet<'a> {
    fn new(name: &'a str, stamps: &'a [i64]) -> Self {
        Self { name, stamps, columns: Default::default(), angle: [0.0; 2], yaw: 0.0 }
    }

    /// Adds a row; `torque` is the command, or not a number where the drive finds the torque itself.
    fn row(&mut self, plant: &Plant<'_, f64>, s: &State<f64>, torque: [f64; 2]) -> Result<(), DiagnosisError> {
        let mut shown = plant.readings(s);
        plant.sense(&mut shown);
        let k = self.columns[0].len();
        if k > 0 {
            let span = (self.stamps[k] - self.stamps[k - 1]) as f64 * 1e-9;
            for j in 0..2 {
                self.angle[j] += 0.5 * span * (shown.wheel_speed[j] + self.columns[j][k - 1]);
            }
        } else {
            self.angle = s.wheel_angle;
        }
        let heading = s.heading[1].atan2(s.heading[0]);
        let turn = (heading - self.yaw).rem_euclid(std::f64::consts::TAU);
        self.yaw += if turn > std::f64::consts::PI { turn - std::f64::consts::TAU } else { turn };
        let torque = [0, 1].map(|j| if torque[j].is_nan() { shown.torque[j] } else { torque[j] });
        let row = [
            shown.wheel_speed[0],
            shown.wheel_speed[1],
            self.angle[0],
            self.angle[1],
            torque[0],
            torque[1],
            shown.gyro,
            shown.accel[0],
            shown.accel[1],
            s.position[0],
            s.position[1],
            self.yaw,
            shown.velocity[0],
            shown.velocity[1],
        ];
        for (i, (column, value)) in self.columns.iter_mut().zip(row).enumerate() {
            if !value.is_finite() {
                return Err(DiagnosisError::NotFinite {
                    recording: self.name.to_owned(),
                    what: SIGNALS[i].name(),
                    time: (self.stamps[k] - self.stamps[0]) as f64 * 1e-9,
                });
            }
            column.push(value);
        }
        Ok(())
    }

    fn recording(self) -> Result<Recording, DiagnosisError> {
        let defect = |_| DiagnosisError::Empty { what: "row" };
        let clock = Clock { name: "simulation".to_owned(), nominal_rate_hz: None };
        let channels = SIGNALS.iter().zip(self.columns);
        let channels: Vec<Channel> = channels
            .map(|(signal, values)| Channel::new(*signal, 0, self.stamps.to_vec(), values).map_err(defect))
            .collect::<Result<_, _>>()?;
        Recording::new(self.name, vec![clock], channels).map_err(defect)
    }
}

#[cfg(test)]
mod tests {
    use recordings::Signal;

    use super::{simulate, simulate_at_speed};
    use inference::{Corrected as _, DiagnosisError, KnownEffects, Options};
    use testing::{recording, robot, samples};
    use verdict::{Correction, EffectAt};

    fn torques() -> recordings::Recording {
        recording(&[
            (Signal::TorqueLeft, samples(400, |t| 2.0 * t.min(1.0))),
            (Signal::TorqueRight, samples(400, |t| 2.2 * t.min(1.0))),
        ])
    }

    fn last(r: &recordings::Recording, signal: Signal) -> f64 {
        *r.get(signal).expect("there").values().last().expect("rows")
    }

    #[test]
    fn what_a_torque_does_at_those_speeds_is_what_it_takes_to_drive_them() {
        let driven = simulate(&robot(), &[], &torques(), &Options::default()).expect("a drive");
        assert_eq!(driven.get(Signal::GyroZ).expect("there").len(), 400);
        assert!(last(&driven, Signal::WheelSpeedLeft) > 1.0 && last(&driven, Signal::PoseYaw) > 0.0);
        let taken = simulate_at_speed(&robot(), &[], &driven).expect("a drive");
        approx::assert_relative_eq!(last(&taken, Signal::TorqueLeft), 2.0, epsilon = 0.05);
        approx::assert_relative_eq!(last(&taken, Signal::TorqueRight), 2.2, epsilon = 0.05);
        approx::assert_relative_eq!(last(&taken, Signal::PoseX), last(&driven, Signal::PoseX), epsilon = 0.02);
    }

    #[test]
    fn sensor_faults_show_and_physics_moves() {
        let with = |effect: &str, value: f64| {
            let spec = robot_model::effects::catalogue::<f64>()
                .into_iter()
                .find(|e| e.spec().id == effect)
                .expect("known")
                .spec();
            let values = [(spec.parameters[0].name.to_owned(), value)].into();
            let correction = Correction {
                effects: vec![EffectAt { effect: effect.to_owned(), values, ..EffectAt::default() }],
                ..Correction::default()
            };
            let active = correction.active(KnownEffects::default(), "d").expect("known");
            simulate(&robot(), &active, &torques(), &Options::default()).expect("a drive")
        };
        let plain = simulate(&robot(), &[], &torques(), &Options::default()).expect("a drive");
        let biased = with("gyro_bias", 0.05);
        approx::assert_relative_eq!(last(&biased, Signal::GyroZ), last(&plain, Signal::GyroZ) + 0.05, epsilon = 1e-12);
        assert_eq!(last(&biased, Signal::PoseX), last(&plain, Signal::PoseX));
        assert!(last(&with("payload", 5.0), Signal::PoseX) < last(&plain, Signal::PoseX) - 0.1);
    }

    #[test]
    fn inputs_that_are_missing_are_named() {
        let only = recording(&[(Signal::TorqueLeft, samples(400, |_| 1.0))]);
        let e = simulate(&robot(), &[], &only, &Options::default()).expect_err("no right torque");
        assert!(matches!(e, DiagnosisError::MissingSignal { what: "torque_right", .. }), "{e}");
        let e = simulate_at_speed(&robot(), &[], &only).expect_err("no speeds");
        assert!(e.to_string().contains("wheel_speed"), "{e}");
    }
}
