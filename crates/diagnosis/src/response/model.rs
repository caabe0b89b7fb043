//! A fitted response as a model of its own: what a robot file holds, forward.

use std::collections::BTreeMap;

use recordings::{Channel, Clock, Recording, Signal};
use robot_model::Robot;
use serde::{Deserialize, Serialize};

use crate::DiagnosisError;
use crate::response::compare::{QUANTITIES, errors, summary};
use crate::response::constants::Constant;
use crate::response::controller::{self, Law, Scaling, free_run};
use crate::response::drive::DrivePart;
use crate::response::ground::{self, GroundPart, driven};
use crate::response::identify::Simulated;
use crate::response::run::{Piece, ResponseRun, STEP, commands};
use crate::response::search::Model;
use crate::response::windows::Windows;

/// From the command over the wheels to the body: what a robot file holds under `response`. By default the wheels do
/// what is commanded and the body rolls without slip on the nominal track.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ResponseModel {
    /// How both sides are kept below a wheel's limit.
    pub scaling: Scaling,
    /// Sides are scaled after the acceleration limits, else before.
    pub scaled_after_ramps: bool,
    /// Acceleration limits hold each side, else forward speed and turning.
    pub side_ramps: bool,
    /// The lag is of second order, else of first.
    pub second_order: bool,
    /// Constants that differ from "does what is commanded, rolls without slip", by id ([`crate::response::Parameter`]).
    pub constants: BTreeMap<String, f64>,
}

impl ResponseModel {
    pub(crate) fn of(s: &Simulated) -> Self {
        let law = s.drive.law;
        let own = |constants: &[Constant], x: &[f64]| -> Vec<(String, f64)> {
            let all = constants.iter().zip(x);
            all.filter(|(c, x)| **x != c.neutral).map(|(c, x)| (c.id.to_owned(), *x)).collect()
        };
        let mut constants = own(&controller::CONSTANTS, &s.drive.x);
        constants.extend(own(&ground::CONSTANTS, &s.ground.x));
        Self {
            scaling: law.scaling,
            scaled_after_ramps: law.after_ramp,
            side_ramps: law.side_ramps,
            second_order: law.second_order,
            constants: constants.into_iter().collect(),
        }
    }

    /// Checks every constant.
    ///
    /// # Errors
    /// A constant that no response has, or beyond what is sensible.
    pub fn checked(&self) -> Result<(), DiagnosisError> {
        self.simulated().map(|_| ())
    }

    fn simulated(&self) -> Result<Simulated, DiagnosisError> {
        let mut drive: Vec<f64> = controller::CONSTANTS.iter().map(|c| c.neutral).collect();
        let mut ground = ground::neutral();
        for (id, value) in &self.constants {
            let place = |all: &[Constant]| all.iter().position(|c| c.id == id);
            let (c, slot) = if let Some(i) = place(&controller::CONSTANTS) {
                (controller::CONSTANTS[i], &mut drive[i])
            } else if let Some(i) = place(&ground::CONSTANTS) {
                (ground::CONSTANTS[i], &mut ground[i])
            } else {
                let known = controller::CONSTANTS.iter().chain(&ground::CONSTANTS).map(|c| c.id);
                return Err(DiagnosisError::NoSuchParameter {
                    effect: "response".to_owned(),
                    name: id.clone(),
                    known: known.collect::<Vec<_>>().join(", "),
                });
            };
            if !(c.bounds[0]..=c.bounds[1]).contains(value) {
                let [least, most] = c.bounds;
                return Err(DiagnosisError::OutOfBounds { name: id.clone(), value: *value, least, most });
            }
            *slot = *value;
        }
        let law = Law {
            scaling: self.scaling,
            after_ramp: self.scaled_after_ramps,
            side_ramps: self.side_ramps,
            second_order: self.second_order,
        };
        Ok(Simulated { drive: Model { law, x: drive }, ground: Model { law: (), x: ground } })
    }
}

/// Simulates a command-driven robot on the commanded wheel speeds of a recording, from the wheel speeds of its first row
/// (else at rest) at the origin: wheel speeds and pose every 50 ms.
///
/// # Errors
/// When commands are missing, or a constant is not sensible.
pub fn simulate_response(
    robot: &Robot<f64>,
    model: &ResponseModel,
    inputs: &Recording,
) -> Result<Recording, DiagnosisError> {
    let s = model.simulated()?;
    let (first, command) = commands(inputs)?;
    let start = [Signal::WheelSpeedLeft, Signal::WheelSpeedRight]
        .map(|w| inputs.get(w).and_then(|c| c.values().first().copied()).unwrap_or_default());
    let piece = Piece { start: 0.0, wheel: vec![start; command.len()], command, heading: None, position: None };
    let wheels = free_run(s.drive.law, &s.drive.x, &piece);
    let poses = driven(&s.ground.x, [robot.wheel_radius, 2.0 * robot.half_track], &wheels);
    let stamps: Vec<i64> = (0..wheels.len()).map(|i| first + (i as f64 * STEP * 1e9).round() as i64).collect();
    let wheel = |j: usize| wheels.iter().map(|w| w[j]).collect::<Vec<f64>>();
    let pose = |k: usize| poses.iter().map(|p| p[k]).collect::<Vec<f64>>();
    let columns = [
        (Signal::WheelSpeedLeft, wheel(0)),
        (Signal::WheelSpeedRight, wheel(1)),
        (Signal::CommandSpeedLeft, piece.command.iter().map(|c| c[0]).collect()),
        (Signal::CommandSpeedRight, piece.command.iter().map(|c| c[1]).collect()),
        (Signal::PoseX, pose(0)),
        (Signal::PoseY, pose(1)),
        (Signal::PoseYaw, pose(2)),
    ];
    let not_finite =
        |_| DiagnosisError::NotFinite { recording: inputs.name().to_owned(), what: "wheel speed", time: 0.0 };
    let channels = columns.into_iter().map(|(signal, values)| Channel::new(signal, 0, stamps.clone(), values));
    let channels = channels.collect::<Result<Vec<_>, _>>().map_err(not_finite)?;
    let clock = Clock { name: "simulation".to_owned(), nominal_rate_hz: Some(1.0 / STEP) };
    Recording::new(inputs.name(), vec![clock], channels).map_err(not_finite)
}

/// Root mean squared errors of the forecasts of a recording from its commands, over windows of 2 s from the measured
/// state: quantity with unit, error. Positions only where they were recorded.
///
/// # Errors
/// When a constant is not sensible.
pub fn response_errors(
    robot: &Robot<f64>,
    model: &ResponseModel,
    run: &ResponseRun,
) -> Result<Vec<(String, f64)>, DiagnosisError> {
    let s = model.simulated()?;
    let windows = Windows::new(std::slice::from_ref(run));
    let wheels = DrivePart::new(&windows, 0).wheels(s.drive.law, &s.drive.x);
    let nominal = [robot.wheel_radius, 2.0 * robot.half_track];
    let poses = GroundPart::new(&windows, wheels.clone(), nominal).poses(&s.ground.x);
    let found = errors(&windows, &wheels, &poses);
    let shown =
        QUANTITIES.iter().zip(&found).filter(|((what, _), _)| run.has_position() || !what.starts_with("position"));
    Ok(shown.map(|((what, unit), e)| (format!("{what}, {unit}"), summary(e)[0])).collect())
}
