//! Robot files of robots of any wheels.

use std::collections::BTreeMap;

use anyhow::{Context, Result};
use model_export::{AnyWheelsModel, Engine, Input};
use toml_edit::{Array, InlineTable, Item, TableLike};
use verdict::Diagnosis;
use wheeled::file::RobotFile;
use wheeled::{AnyWheels, Constant, Quantity, constants};

use super::unheld::{Told, Unheld, told};
use super::{ColumnsRobot, Written};
use crate::edit::{document, rounded, set, set_source, tables};

/// The corrected file, and what it cannot hold.
pub(super) fn robot_file(name: &str, text: &str, diagnosis: &Diagnosis) -> Result<(String, Vec<Unheld>)> {
    let robot = RobotFile::parse(name, text)?.robot;
    let all = constants(&robot, true, true);
    let mut document = document(name, text)?;
    let root = document.as_table_mut() as &mut dyn TableLike;
    for constant in &all {
        let Some(found) = diagnosis.tuning.get(&constant.name) else { continue };
        edit(root, &robot, constant, *found);
    }
    let edited = document.to_string();
    RobotFile::parse(name, &edited).context("no robot can have the corrected numbers")?;
    let unheld = |told: Told| {
        let constant = all.iter().find(|c| c.name == told.name)?;
        let remedy = remedy(constant.quantity)?;
        told.differs_from(constant.given).then_some(Unheld { told, unit: constant.unit, remedy })
    };
    Ok((edited, self::told(diagnosis).into_iter().filter_map(unheld).collect()))
}

/// The model for an engine of what the corrected robot file says.
pub(super) fn model(robot: &ColumnsRobot, engine: Engine) -> Result<Written> {
    let (text, unheld) = robot.edited()?;
    let holder = format!("a model in {}", engine.name());
    let mut not_held: Vec<String> = unheld.iter().map(|u| u.sentence(&holder)).collect();
    let RobotFile { robot: corrected, columns, .. } = RobotFile::parse(&robot.name, &text)?;
    let mut told: Vec<String> = robot.headline().into_iter().collect();
    told.extend(retuned(&RobotFile::parse(&robot.name, &robot.text)?.robot, &robot.tuning()));

    let (motors, joints) = (inputs(&corrected.motors, &columns.torque), inputs(&corrected.joints, &columns.joints));
    let model = AnyWheelsModel {
        name: &corrected.name,
        robot: &corrected.plant,
        wheels: &corrected.wheels,
        motors: &motors,
        joints: &joints,
        point: corrected.point,
        told: &told,
    };
    let exported = model.export(engine)?;
    not_held.extend(exported.notes.iter().map(|note| format!("{} does not hold {note}", engine.name())));
    Ok(Written { text: exported.text, not_held })
}

/// Motors or joints with what a unit of their columns is.
fn inputs<'a>(names: &'a [String], columns: &[(String, f64)]) -> Vec<Input<'a>> {
    names.iter().zip(columns).map(|(name, (_, per_unit))| Input { name, per_unit: *per_unit }).collect()
}

/// Constants that a verdict corrects, one sentence each.
fn retuned(stated: &AnyWheels, tuning: &BTreeMap<String, f64>) -> Vec<String> {
    let differs = |c: &Constant| {
        let found = tuning.get(&c.name).copied().filter(|found| rounded(*found) != rounded(c.given))?;
        let number = |x: f64| format!("{x:.4e}").parse::<f64>().unwrap_or(x);
        let unit = if c.unit == "1" { String::new() } else { format!(" {}", c.unit) };
        Some(format!("{}: {}{unit}, re-tuned from {}", c.name, number(found), number(c.given)))
    };
    constants(stated, true, true).iter().filter_map(differs).collect()
}

/// Writes a number where its file has it.
fn edit(root: &mut dyn TableLike, robot: &AnyWheels, constant: &Constant, found: f64) {
    use Quantity as Q;
    let row = |root: &mut dyn TableLike, list: &str, k: usize, key: &str, by: &dyn Fn(f64) -> f64| {
        let Some(row) = root.get_mut(list).map(tables).and_then(|rows| rows.into_iter().nth(k)) else { return };
        let from = row.get(key).and_then(number);
        write(row, key, (from, by(from.unwrap_or(constant.given))));
    };
    let to = |_: f64| found;
    let times = |from: f64| from * found;
    match constant.quantity {
        Q::Mass => value(root, "mass", found),
        Q::Drag => drag(root, constant.given, found),
        Q::YawInertia => value(root, "yaw_inertia", found),
        Q::ComX => element(root, "centre_of_mass", 0, &to),
        Q::ComY => element(root, "centre_of_mass", 1, &to),
        Q::Gain(k) => row(root, "motor", k, "torque_per_unit", &times),
        Q::Coulomb(k) => row(root, "motor", k, "coulomb", &to),
        Q::Viscous(k) => row(root, "motor", k, "viscous", &to),
        Q::Lag => (0..robot.motors.len()).for_each(|k| row(root, "motor", k, "lag", &to)),
        Q::SteeringZero(k) => row(root, "joint", k, "zero_deg", &|_| found.to_degrees()),
        Q::SteeringGain(k) => row(root, "joint", k, "angle_per_unit", &times),
        Q::Radius(k) => row(root, "wheel", k, "radius", &to),
        Q::Direction(k) => row(root, "wheel", k, "direction_deg", &|_| found.to_degrees()),
        Q::Across | Q::Along => {
            let axis = usize::from(constant.quantity == Q::Across);
            for list in ["wheel", "caster", "joint"] {
                for row in root.get_mut(list).map(tables).unwrap_or_default() {
                    element(row, "place", axis, &times);
                }
            }
        }
        Q::CasterRolling | Q::CasterPivot => {
            let key = if constant.quantity == Q::CasterRolling { "rolling_resistance" } else { "pivot_friction" };
            (0..robot.plant.casters.iter().flatten().count()).for_each(|k| row(root, "caster", k, key, &to));
        }
        Q::Slip => inside(root, "ground", "slip_at_peak", constant.given, found),
        Q::Brush => inside(root, "ground", "brush_share", constant.given, found),
        Q::Lateral => inside(root, "ground", "lateral_stiffness", constant.given, found),
        Q::Rest => inside(root, "ground", "rest_speed", constant.given, found),
        Q::Grip => inside(root, "ground", "adhesion", constant.given, found),
        Q::Rolling => inside(root, "ground", "rolling_resistance", constant.given, found),
        Q::RollerDrag => inside(root, "ground", "roller_drag", constant.given, found),
        Q::PoseX => inside(root, "point", "x", constant.given, found),
        Q::PoseY => inside(root, "point", "y", constant.given, found),
        Q::PoseDirection => inside(root, "point", "yaw_deg", constant.given.to_degrees(), found.to_degrees()),
        Q::SlopeX => slope(root, 0, constant.given.to_degrees(), found.to_degrees()),
        Q::SlopeY => slope(root, 1, constant.given.to_degrees(), found.to_degrees()),
        Q::Delay | Q::GyroScale | Q::GyroBias | Q::Clock => {}
    }
}

fn number(item: &Item) -> Option<f64> {
    item.as_float().or_else(|| item.as_integer().map(|n| n as f64))
}

fn write(row: &mut dyn TableLike, key: &str, (from, to): (Option<f64>, f64)) {
    let to = rounded(to);
    if from.map_or(to == 0.0, |from| rounded(from) == to) {
        return;
    }
    let before = from.map_or_else(|| "nothing stated".to_owned(), |from| from.to_string());
    set(row, key, to);
    set_source(row, &format!("{key} re-tuned by lacuna from {before}"));
}

/// A number with a sigma and a source of its own.
fn value(root: &mut dyn TableLike, key: &str, found: f64) {
    if let Some(row) = root.get_mut(key).and_then(Item::as_table_like_mut) {
        let from = row.get("value").and_then(number);
        write(row, "value", (from, found));
    }
}

/// The drag, which most robot files say nothing of.
fn drag(root: &mut dyn TableLike, given: f64, found: f64) {
    if rounded(given) == rounded(found) {
        return;
    }
    let row = root.entry("drag").or_insert_with(|| toml_edit::value(InlineTable::new()));
    if let Some(row) = row.as_table_like_mut() {
        write(row, "value", (Some(given), found));
    }
}

/// A number of a list.
fn element(row: &mut dyn TableLike, key: &str, at: usize, by: &dyn Fn(f64) -> f64) {
    let Some(list) = row.get_mut(key).and_then(Item::as_array_mut) else { return };
    let mut values: Vec<f64> =
        list.iter().filter_map(|v| v.as_float().or_else(|| v.as_integer().map(|n| n as f64))).collect();
    let Some(own) = values.get_mut(at) else { return };
    let to = rounded(by(*own));
    if to != rounded(*own) {
        *own = to;
        set(row, key, Array::from_iter(values));
    }
}

/// The ground's slope along one axis, in degrees: of these drives, not of the robot.
fn slope(root: &mut dyn TableLike, axis: usize, given: f64, found: f64) {
    if rounded(given) == rounded(found) {
        return;
    }
    let Some(ground) = root.entry("ground").or_insert_with(toml_edit::table).as_table_like_mut() else { return };
    if !ground.contains_key("slope_deg") {
        set(ground, "slope_deg", Array::from_iter([0.0; 2]));
        set_source(ground, "slope_deg is that of the ground of these drives; elsewhere set it to [0, 0]");
    }
    element(ground, "slope_deg", axis, &|_| found);
}

/// A number of a table that may not be there.
fn inside(root: &mut dyn TableLike, table: &str, key: &str, given: f64, found: f64) {
    if rounded(given) == rounded(found) {
        return;
    }
    if let Some(row) = root.entry(table).or_insert_with(toml_edit::table).as_table_like_mut() {
        write(row, key, (Some(given), found));
    }
}

/// What to do about a constant that a robot file has no key for.
fn remedy(quantity: Quantity) -> Option<&'static str> {
    use Quantity as Q;
    match quantity {
        Q::Delay => Some("correct the time stamps of the torques by it"),
        Q::GyroScale => Some("divide the gyro's readings by it"),
        Q::GyroBias => Some("subtract it from the gyro's readings"),
        Q::Clock => Some("correct the time stamps by it"),
        _ => None,
    }
}
