//! A fitted response as a model of its own: what a robot file holds, forward.

use recordings::{Channel, Clock, Recording, Signal};
use robot_model::Robot;
use verdict::{DRIVE_CONSTANTS, GROUND_CONSTANTS, ResponseConstant, ResponseModel};

use crate::compare::{Motion, QUANTITIES, errors, summary};
use crate::controller::{Law, free_run};
use crate::drive::DrivePart;
use crate::ground::{GroundPart, TurnSlip, driven};
use crate::identify::Base;
use crate::run::{Commands, Piece, ResponseRun, STEP, commands};
use crate::search::Model;
use crate::windows::Windows;
use inference::DiagnosisError;

/// What a fit found, for files.
pub(crate) fn model_of(s: &Base) -> ResponseModel {
    let law = s.drive.law;
    let own = |constants: &[ResponseConstant], x: &[f64]| -> Vec<(String, f64)> {
        let all = constants.iter().zip(x);
        all.filter(|(c, x)| **x != c.neutral).map(|(c, x)| (c.id.to_owned(), *x)).collect()
    };
    let mut constants = own(&DRIVE_CONSTANTS, &s.drive.x);
    constants.extend(own(&GROUND_CONSTANTS, &s.ground.x));
    ResponseModel {
        scaling: law.scaling,
        scaled_after_ramps: law.after_ramp,
        side_ramps: law.side_ramps,
        second_order: law.second_order,
        constants: constants.into_iter().collect(),
    }
}

/// The response that a file holds, for simulations.
fn simulated(model: &ResponseModel) -> Result<Base, DiagnosisError> {
    model.checked()?;
    let value = |c: &ResponseConstant| model.constants.get(c.id).copied().unwrap_or(c.neutral);
    let law = Law {
        scaling: model.scaling,
        after_ramp: model.scaled_after_ramps,
        side_ramps: model.side_ramps,
        second_order: model.second_order,
    };
    let drive = Model { law, x: DRIVE_CONSTANTS.iter().map(value).collect() };
    let of_ground: Vec<f64> = GROUND_CONSTANTS.iter().map(value).collect();
    Ok(Base { drive, ground: Model { law: TurnSlip::of(&of_ground), x: of_ground } })
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
    let s = simulated(model)?;
    let Commands { first, command, within } = commands(inputs)?;
    let start = [Signal::WheelSpeedLeft, Signal::WheelSpeedRight]
        .map(|w| inputs.get(w).and_then(|c| c.values().first().copied()).unwrap_or_default());
    let piece = Piece {
        start: 0.0,
        wheel: vec![start; command.len()],
        command,
        within,
        heading: None,
        integrated: false,
        position: None,
    };
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
    let s = simulated(model)?;
    let windows = Windows::new(std::slice::from_ref(run));
    let wheels = DrivePart::new(&windows, 0).wheels(s.drive.law, &s.drive.x);
    let nominal = [robot.wheel_radius, 2.0 * robot.half_track];
    let poses = GroundPart::new(&windows, wheels.clone(), nominal).poses(&s.ground.x);
    let found = errors(&windows, &Motion { wheels, poses });
    let shown =
        QUANTITIES.iter().zip(&found).filter(|((what, _), _)| run.has_position() || !what.starts_with("position"));
    Ok(shown.map(|((what, unit), e)| (format!("{what}, {unit}"), summary(e)[0])).collect())
}
