//! Robot files of wheels beside a pose.

use std::collections::BTreeMap;

use anyhow::{Context, Result};
use odometry::file::RobotFile;
use odometry::{Constant, Measured, Quantity, WheeledRobot, constants};
use toml_edit::{Array, Item, TableLike};
use verdict::Diagnosis;

use super::unheld::{Told, Unheld, told};
use crate::edit::{document, rounded, set, set_source, tables};

/// The corrected file, and what it cannot hold.
pub(super) fn robot_file(name: &str, text: &str, diagnosis: &Diagnosis) -> Result<(String, Vec<Unheld>)> {
    let stated = RobotFile::parse(name, text)?.robot;
    let wanted = corrected(&stated, &diagnosis.tuning);
    let mut document = document(name, text)?;
    for row in document.get_mut("wheel").map(tables).unwrap_or_default() {
        let wheel = row.get("name").and_then(Item::as_str);
        // Casters are wheels of the file, but none of the robot.
        let Some(k) = wheel.and_then(|wheel| stated.wheels.iter().position(|w| w.name == wheel)) else { continue };
        edit(row, &stated.wheels[k], &wanted.wheels[k]);
    }
    let edited = document.to_string();
    RobotFile::parse(name, &edited).context("no robot can have the corrected numbers")?;
    Ok((edited, unheld(&stated, diagnosis, |quantity| is_length(quantity) || is_direction(quantity))))
}

fn edit(row: &mut dyn TableLike, stated: &odometry::Wheel, wanted: &odometry::Wheel) {
    let mut changes = Vec::new();
    if rounded(wanted.radius) != rounded(stated.radius) {
        changes.push(format!("radius re-tuned by lacuna from {} m", stated.radius));
        set(row, "radius", rounded(wanted.radius));
    }
    if wanted.place.map(rounded) != stated.place.map(rounded) {
        let [x, y] = stated.place;
        changes.push(format!("place re-tuned by lacuna from [{x}, {y}] m"));
        set(row, "place", Array::from_iter(wanted.place.map(rounded)));
    }
    let [from, to] = [stated, wanted].map(|wheel| rounded(wheel.direction.to_degrees()));
    if from != to {
        changes.push(format!("direction_deg re-tuned by lacuna from {from} deg"));
        set(row, "direction_deg", to);
    }
    if !changes.is_empty() {
        set_source(row, &changes.join(", "));
    }
}

/// The robot with the corrected numbers that wheels have: radius, place, and direction at steering zero.
pub(super) fn corrected(stated: &WheeledRobot, tuning: &BTreeMap<String, f64>) -> WheeledRobot {
    let mut out = stated.clone();
    let measured = stated.measured();
    let places = |axis: usize| stated.wheels.iter().map(move |w| w.place[axis]);
    let extent = |axis: usize| places(axis).fold(f64::MIN, f64::max) - places(axis).fold(f64::MAX, f64::min);
    let reach = inference::robust::mean(stated.wheels.iter().map(|w| w.place[0].hypot(w.place[1])));
    let mut scale = |axes: &[usize], factor: f64| {
        for wheel in &mut out.wheels {
            for &axis in axes {
                wheel.place[axis] *= factor;
            }
        }
    };
    let found = |name: &str| tuning.get(name).copied();

    let (mut radii, mut directions) = (Vec::new(), Vec::new());
    let mut zero = 0.0;
    for constant in constants(stated, Measured::BOTH) {
        let Some(value) = found(&constant.name) else { continue };
        match constant.quantity {
            Quantity::Radius(k) => radii.push((measured[k], value)),
            Quantity::Direction(k) => directions.push((measured[k], value)),
            Quantity::Across => scale(&[1], value / extent(1)),
            Quantity::Along => scale(&[0], value / extent(0)),
            Quantity::Reach => scale(&[0, 1], reach.map_or(1.0, |reach| value / reach)),
            Quantity::SteeringOffset => zero = value,
            _ => {}
        }
    }
    for (wheel, radius) in radii {
        out.wheels[wheel].radius = radius;
    }
    for (wheel, angle) in directions {
        out.wheels[wheel].direction += angle;
    }
    // The zero is added to the steering angle, as the direction at steering zero is.
    for wheel in out.wheels.iter_mut().filter(|w| w.steered) {
        wheel.direction += zero;
    }
    out
}

/// Whether a constant is a direction of wheels.
fn is_direction(quantity: Quantity) -> bool {
    matches!(quantity, Quantity::Direction(_) | Quantity::SteeringOffset)
}

/// Whether a constant is a radius or a place of wheels.
pub(super) fn is_length(quantity: Quantity) -> bool {
    matches!(quantity, Quantity::Radius(_) | Quantity::Across | Quantity::Along | Quantity::Reach)
}

/// What the verdict tells and a target does not hold.
pub(super) fn unheld(stated: &WheeledRobot, diagnosis: &Diagnosis, holds: impl Fn(Quantity) -> bool) -> Vec<Unheld> {
    let constants = constants(stated, Measured::BOTH);
    let unheld = |told: Told| {
        let Some(constant) = constants.iter().find(|c| c.name == told.name) else {
            let remedy = "look at the wheel's encoder, its plug and its counter";
            return Some(Unheld { told, unit: "1", remedy });
        };
        let remedy = remedy(constant.quantity);
        let is_off = neutral(constant.quantity).is_none_or(|neutral| told.differs_from(neutral));
        (is_off && !holds(constant.quantity)).then_some(Unheld { told, unit: constant.unit, remedy })
    };
    let (mut all, mut fitted) = (told(diagnosis), Vec::new());
    // Zero and gain of the steering are fitted together with the lengths that a target does hold.
    let of_steering = |c: &&Constant| matches!(c.quantity, Quantity::SteeringOffset | Quantity::SteeringGain);
    for constant in constants.iter().filter(of_steering).filter(|c| all.iter().all(|told| told.name != c.name)) {
        fitted.extend(Told::fitted(diagnosis, &constant.name));
    }
    all.extend(fitted);
    all.into_iter().filter_map(unheld).collect()
}

/// What a target takes for granted of a constant that it does not hold; `None` where that depends on another constant.
fn neutral(quantity: Quantity) -> Option<f64> {
    match quantity {
        Quantity::SteeringGain | Quantity::GyroScale => Some(1.0),
        Quantity::TurnSlipRate | Quantity::TurnSlipPower => None,
        _ => Some(0.0),
    }
}

fn remedy(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Radius(_) | Quantity::Across | Quantity::Along | Quantity::Reach => "measure it",
        Quantity::Direction(_) => "turn the wheel's bracket back by it",
        Quantity::SteeringOffset => "add it to the steering angle before it is used",
        Quantity::SteeringGain => "multiply the steering angle by it before it is used",
        Quantity::Mounting => "turn the pose by it where it is recorded",
        Quantity::OriginX | Quantity::OriginY => "shift the pose by it where it is recorded",
        Quantity::GyroScale => "divide the gyro's yaw rate by it",
        Quantity::GyroBias => "subtract it from the gyro's yaw rate",
        Quantity::ClockOffset | Quantity::ClockRate(_) => "correct the time stamps of the counts by it",
        Quantity::RollerSlip
        | Quantity::TurnSlip
        | Quantity::TurnSlipRate
        | Quantity::TurnSlipPower
        | Quantity::RateSlip
        | Quantity::SpeedSlip
        | Quantity::SpeedTurnSlip
        | Quantity::WheelSpeedSlip
        | Quantity::Sideslip
        | Quantity::CorneringForward
        | Quantity::CorneringSideways => "its wheels roll without slip, and poses from counts go wrong by that",
    }
}
