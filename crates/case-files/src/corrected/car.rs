//! Robot files of cars.

use anyhow::{Context, Result};
use single_track::file::RobotFile;
use single_track::{Car, Constant, Quantity, Stated, constants};
use toml_edit::{DocumentMut, InlineTable, Item, TableLike, table, value};
use verdict::Diagnosis;

use super::unheld::{Told, Unheld, told};
use crate::edit::{document, rounded, set, set_source};

/// The corrected file, and what it cannot hold.
pub(super) fn robot_file(name: &str, text: &str, diagnosis: &Diagnosis) -> Result<(String, Vec<Unheld>)> {
    let car = RobotFile::parse(name, text)?.car;
    let mut document = document(name, text)?;
    let mass = document.get("mass").and_then(Item::as_table_like).and_then(|t| number(t.get("value")?));
    for constant in constants(&car) {
        let Some(place) = place(&car, mass, constant.quantity) else { continue };
        let Some(found) = diagnosis.tuning.get(constant.name) else { continue };
        edit(&mut document, &place, *found);
    }
    let edited = document.to_string();
    RobotFile::parse(name, &edited).context("no car can have the corrected numbers")?;
    let held = |constant: &Constant| place(&car, mass, constant.quantity).is_some();
    Ok((edited, unheld(&car, diagnosis, held)))
}

/// Where a robot file has a constant: table, key, what the owner states of it, what the value is multiplied by, unit.
struct Place {
    table: Option<&'static str>,
    key: &'static str,
    stated: Stated,
    factor: f64,
    unit: &'static str,
}

/// Where a robot file has a constant, if it has one. Numbers of a drive that the owner leaves out stay out: what a file
/// does not state of its drive is fitted to every set of drives.
fn place(car: &Car, mass: Option<f64>, quantity: Quantity) -> Option<Place> {
    let states_drive = car.drive_gain.is_stated || car.dead_zone.is_stated;
    let of = |table: &'static str, key, stated, unit| {
        let table = (!table.is_empty()).then_some(table);
        Some(Place { table, key, stated, factor: 1.0, unit })
    };
    match quantity {
        Quantity::Wheelbase => of("", "wheelbase", car.wheelbase, "m"),
        Quantity::CentreOfMass => of("", "centre_of_mass", car.centre_of_mass, "m"),
        Quantity::Gyration => {
            let place = of("", "yaw_inertia", car.gyration, "kg m²");
            place.zip(mass).map(|(place, mass)| Place { factor: mass, ..place })
        }
        Quantity::FullSteering => of("steering", "full_angle", car.full_steering, "rad"),
        Quantity::Centre => of("steering", "centre", car.centre, "rad"),
        Quantity::SteeringDelay => of("steering", "delay", car.steering_delay, "s"),
        Quantity::SteeringLag => of("steering", "lag", car.steering_lag, "s"),
        Quantity::DriveGain if states_drive => of("drive", "full_acceleration", car.drive_gain, "m/s²"),
        Quantity::DeadZone if states_drive => of("drive", "dead_zone", car.dead_zone, "of the throttle"),
        Quantity::PointX => of("point", "x", car.point_x, "m"),
        Quantity::PointY => of("point", "y", car.point_y, "m"),
        Quantity::Direction => of("point", "yaw", car.direction, "rad"),
        _ => None,
    }
}

fn edit(document: &mut DocumentMut, place: &Place, found: f64) {
    let Place { table: inside, key, stated, factor, unit } = *place;
    let [from, to] = [stated.value, found].map(|x| rounded(factor * x));
    if from == to {
        return;
    }
    let root = document.as_table_mut() as &mut dyn TableLike;
    let parent = match inside {
        None => Some(root),
        Some(name) => root.entry(name).or_insert_with(table).as_table_like_mut(),
    };
    let Some(parent) = parent else { return };
    if let Some(row) = parent.get_mut(key).and_then(Item::as_table_like_mut) {
        set(row, "value", to);
        set_source(row, &format!("re-tuned by lacuna from {from} {unit}"));
        return;
    }
    // Of what the owner does not state the usual number stood in.
    let from = if stated.is_stated {
        format!("{from} {unit}, which follows from other keys")
    } else {
        format!("the usual {from} {unit}, for none was stated")
    };
    let mut row = InlineTable::new();
    row.insert("value", to.into());
    row.insert("source", format!("re-tuned by lacuna from {from}").into());
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
