//! Which signals are the state and which the input.

use anyhow::{Context, Result};
use recordings::{Channel, Recording, Signal};
use robot_file::{Causality, RobotSpec};

/// Left and right channel.
type Pair<'a> = [&'a Channel; 2];

/// The signals of a recording that the identifier works on.
pub(super) struct Chosen<'a> {
    /// Wheel speeds x.
    pub(super) speed: Pair<'a>,
    /// Torques or currents u.
    pub(super) input: Pair<'a>,
    /// Torque per unit of the input.
    pub(super) input_factor: f64,
    /// Inputs carry no sign and take that of the speed.
    pub(super) unsigned: bool,
    /// Wheel angles, where recorded.
    pub(super) angle: Option<Pair<'a>>,
    /// The state in words.
    pub(super) state_words: String,
    /// The input in words.
    pub(super) input_words: String,
}

fn pair(recording: &Recording, signals: [Signal; 2]) -> Result<Pair<'_>> {
    Ok([recording.require(signals[0])?, recording.require(signals[1])?])
}

/// Chooses by the robot's causality.
pub(super) fn choose<'a>(recording: &'a Recording, robot: &RobotSpec) -> Result<Chosen<'a>> {
    let measured = [Signal::WheelSpeedLeft, Signal::WheelSpeedRight];
    let commanded = [Signal::CommandSpeedLeft, Signal::CommandSpeedRight];
    let torques = [Signal::TorqueLeft, Signal::TorqueRight];
    let currents = [Signal::CurrentLeft, Signal::CurrentRight];
    let angles = [Signal::WheelAngleLeft, Signal::WheelAngleRight];
    let has = |pair: [Signal; 2]| pair.iter().all(|s| recording.get(*s).is_some());
    let speed_driven = robot.causality == Causality::SpeedDriven;

    let from_commands = speed_driven && !has(measured);
    let speed = pair(recording, if from_commands { commanded } else { measured })?;
    let from_currents = speed_driven && !has(torques);
    let input = pair(recording, if from_currents { currents } else { torques })?;
    let input_factor = if from_currents {
        let known = robot.torque_per_current.with_context(|| {
            format!(
                "the robot '{}' has no `torque_per_current`, which turns recorded currents into torques; \
                 add `torque_per_current = {{ value = ..., unit = \"N m/A\", source = \"...\" }}` to its parameters",
                robot.name
            )
        })?;
        known[0]
    } else {
        1.0
    };
    let unsigned = input.iter().any(|c| c.attributes().magnitude_only);
    let names = |p: &Pair<'_>| format!("{}, {}", p[0].name(), p[1].name());
    let mut state_words = names(&speed);
    if from_commands {
        state_words += " (set-points: what the drive was commanded, not what it did)";
    }
    let mut input_words = names(&input);
    if from_currents {
        input_words += &format!(" times {input_factor} N m/A");
    }
    if unsigned {
        input_words += ", with the sign of the speed, since they carry none";
    }
    Ok(Chosen {
        speed,
        input,
        input_factor,
        unsigned,
        angle: has(angles).then(|| pair(recording, angles)).transpose()?,
        state_words,
        input_words,
    })
}
