//! Robot files of cars.

use anyhow::{Context, Result};
use single_track::file::RobotFile;
use single_track::{Car, Constant, Quantity, constants};
use toml_edit::{DocumentMut, InlineTable, Item, TableLike, table, value};
use verdict::Diagnosis;

use super::unheld::{Told, Unheld, told};
use crate::edit::{document, rounded, set, set_source};

/// The corrected file, and what it cannot hold.
pub(super) fn robot_file(name: &str, text: &str, diagnosis: &Diagnosis) -> Result<(String, Vec<Unheld>)> {
    let read = RobotFile::parse(name, text)?;
    let mut document = document(name, text)?;
    let mass = document.get("mass").and_then(Item::as_table_like).and_then(|t| number(t.get("value")?));
    let told = told(diagnosis);
    for constant in constants(&read.car) {
        let Some(found) = diagnosis.tuning.get(constant.name) else { continue };
        let is_told = told.iter().any(|told| told.name == constant.name);
        if !is_of_a_day(constant.quantity) || is_told {
            edit(&mut document, &read, mass, &constant, *found);
        }
    }
    let edited = document.to_string();
    RobotFile::parse(name, &edited).context("no car can have the corrected numbers")?;
    Ok((edited, unheld(&read.car, diagnosis, |_| true)))
}

/// Whether a number belongs to the day and the place of the drives, not to the car: it is written only where it is told.
fn is_of_a_day(quantity: Quantity) -> bool {
    use Quantity as Q;
    matches!(quantity, Q::SlopeX | Q::SlopeY | Q::Clock | Q::GyroBias | Q::GyroDelay | Q::EncoderDelay)
}

/// Writes a constant where its file has it.
fn edit(document: &mut DocumentMut, read: &RobotFile, mass: Option<f64>, constant: &Constant, found: f64) {
    let (mut inside, mut key) = constant.quantity.key();
    let mut factor = 1.0;
    let states_ratio = document.contains_key("yaw_inertia_over_mass");
    match (constant.quantity, mass) {
        // Of yaw inertia and mass only their ratio shows.
        (Quantity::Gyration, Some(mass)) if !states_ratio => factor = mass,
        (Quantity::Gyration, _) => key = "yaw_inertia_over_mass",
        // A command in units of an angle asks for that angle, whatever the steering makes of it.
        (Quantity::FullSteering, _) if read.columns.steering_unit != "command" => {
            (inside, key, factor) = (Some("steering"), "gain", 1.0 / read.full_asked);
        }
        // A gain beside it stays.
        (Quantity::FullSteering, _) => factor = read.full_asked / constant.given,
        _ => {}
    }
    let [from, to] = [constant.given, found].map(|x| rounded(factor * x));
    if from == to {
        return;
    }
    let root = document.as_table_mut() as &mut dyn TableLike;
    let parent = match inside {
        None => Some(root),
        Some(name) => root.entry(name).or_insert_with(table).as_table_like_mut(),
    };
    let Some(parent) = parent else { return };
    let unit = if key == "yaw_inertia" { "kg m²" } else { constant.unit };
    let unit = if matches!(unit, "1") || key == "gain" { String::new() } else { format!(" {unit}") };
    if let Some(row) = parent.get_mut(key).and_then(Item::as_table_like_mut) {
        set(row, "value", to);
        set_source(row, &format!("re-tuned by lacuna from {from}{unit}"));
        return;
    }

    // Of what the owner does not state the usual number stood in, and it is known no better by its owner.
    let mut row = InlineTable::new();
    row.insert("value", to.into());
    if constant.is_stated || key == "gain" {
        let by = if key == "gain" { "" } else { ", which follows from other keys" };
        row.insert("source", format!("re-tuned by lacuna from {from}{unit}{by}").into());
    } else {
        let sigma = constant.sigma * if constant.is_factor { found.abs() } else { 1.0 };
        row.insert("sigma", rounded(factor * sigma).into());
        row.insert("source", format!("re-tuned by lacuna from the usual {from}{unit}, for none was stated").into());
    }
    parent.insert(key, value(row));
}

fn number(item: &Item) -> Option<f64> {
    item.as_float().or_else(|| item.as_integer().map(|n| n as f64))
}

/// What the verdict tells and a target does not hold.
pub(super) fn unheld(car: &Car, diagnosis: &Diagnosis, holds: impl Fn(&Constant) -> bool) -> Vec<Unheld> {
    let constants = constants(car);
    let unheld = |told: Told| {
        let constant = constants.iter().find(|c| c.name == told.name)?;
        let remedy = remedy(constant.quantity);
        let is_off = told.differs_from(constant.given);
        (is_off && !holds(constant)).then_some(Unheld { told, unit: constant.unit, remedy })
    };
    let (mut all, mut fitted) = (told(diagnosis), Vec::new());
    // What makes angles of commands is fitted together with the lengths that a target does hold.
    let of_steering = |c: &&Constant| matches!(c.quantity, Quantity::FullSteering | Quantity::Centre);
    for constant in constants.iter().filter(of_steering).filter(|c| all.iter().all(|told| told.name != c.name)) {
        fitted.extend(Told::fitted(diagnosis, constant.name));
    }
    all.extend(fitted);
    all.into_iter().filter_map(unheld).collect()
}

fn remedy(quantity: Quantity) -> &'static str {
    use Quantity as Q;
    match quantity {
        Q::Curve | Q::Asymmetry => "bring commands into a straight line by a table first",
        Q::FullSteering | Q::Centre => "calibrate the steering where commands become angles",
        Q::SteeringDelay | Q::SteeringLag | Q::Slowness | Q::Play => "the steering is taken to follow at once",
        Q::Wheelbase | Q::CentreOfMass | Q::Gyration => "it has no key for it",
        Q::FrontCompliance | Q::RearCompliance | Q::FrontInverseGrip | Q::RearInverseGrip => {
            "its tyres do not give way, and poses go wrong by that in fast curves"
        }
        Q::DriveGain
        | Q::DeadZone
        | Q::BackEmf
        | Q::Friction
        | Q::Viscous
        | Q::MotorBraking
        | Q::Drag
        | Q::DriveLag
        | Q::DriveDelay => "the drive's own controller has to make up for it",
        Q::SlopeX | Q::SlopeY => "it takes the ground for level",
        Q::PointX | Q::PointY => "shift the pose by it where it is recorded",
        Q::Direction => "turn the pose by it where it is recorded",
        Q::Clock | Q::GyroDelay | Q::EncoderDelay => "correct the time stamps by it",
        Q::GyroScale => "divide the gyro's readings by it",
        Q::GyroBias => "subtract it from the gyro's readings",
        Q::EncoderScale => "divide the encoder's speeds by it",
        Q::WheelSlip => "divide the encoder's speeds by 1 + it (speed times yaw rate)²",
    }
}
