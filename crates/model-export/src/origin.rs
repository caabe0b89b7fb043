//! Where the values of a model come from, as comments.

use inference::robust::NINETY;
use robot_model::Robot;
use robot_model::effect::export::{Section, Way};
use robot_model::effect::{EffectSpec, Parameter};
use verdict::Cause;

use crate::at::At;
use crate::model::Model;
use crate::number::number;

/// Reads a constant.
type Read = fn(&Robot<f64>) -> f64;

/// Constants that a re-tuning may change: name, unit, part of the model.
const CONSTANTS: [(&str, &str, Section, Read); 19] = [
    ("mass", "kg", Section::Body, |r| r.mass),
    ("yaw inertia", "kg m²", Section::Body, |r| r.yaw_inertia),
    ("centre of mass x", "m", Section::Body, |r| r.com[0]),
    ("centre of mass y", "m", Section::Body, |r| r.com[1]),
    ("centre of mass z", "m", Section::Body, |r| r.com[2]),
    ("motor inertia", "kg m²", Section::Wheels, |r| r.motor_inertia),
    ("dry friction, left", "N m", Section::Wheels, |r| r.coulomb[0]),
    ("dry friction, right", "N m", Section::Wheels, |r| r.coulomb[1]),
    ("viscous friction, left", "N m s/rad", Section::Wheels, |r| r.viscous[0]),
    ("viscous friction, right", "N m s/rad", Section::Wheels, |r| r.viscous[1]),
    ("Stribeck friction", "N m", Section::Wheels, |r| r.stribeck),
    ("adhesion", "", Section::Ground, |r| r.adhesion),
    ("slip at peak", "", Section::Ground, |r| r.slip_at_peak),
    ("sliding share", "", Section::Ground, |r| r.sliding_share),
    ("lateral factor", "", Section::Ground, |r| r.lateral_factor),
    ("rolling resistance", "", Section::Ground, |r| r.rolling_resistance),
    ("torque gain", "", Section::Drive, |r| r.drive.gain),
    ("motor lag", "s", Section::Drive, |r| r.drive.lag),
    ("transport delay", "s", Section::Drive, |r| r.drive.delay),
];

/// What was re-tuned.
pub(crate) fn retuned(model: &Model<'_>) -> Vec<(Section, String)> {
    let Some(before) = model.before else {
        return Vec::new();
    };
    let changed = CONSTANTS.iter().filter(|(.., read)| read(before) != read(model.robot));
    let text = |name: &str, unit: &str, read: Read| {
        let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
        format!("re-tuned: {name} {}{unit}, was {}", number(read(model.robot)), number(read(before)))
    };
    changed.map(|(name, unit, section, read)| (*section, text(name, unit, *read))).collect()
}

/// What an effect stands for in the model.
pub(crate) fn of_effect(at: &At<'_>, causes: &[Cause], way: Way) -> String {
    let how = match way {
        Way::Held(value) => format!("here: {value}"),
        Way::Added(_) => "not held by this engine: see the residuals".to_owned(),
    };
    let began = at.began();
    let when = if began.is_empty() { String::new() } else { format!("; began {began}; here from the start") };
    format!("effect {}{when}; {how}", described(at, causes))
}

/// An effect with its values and their intervals.
pub(crate) fn described(at: &At<'_>, causes: &[Cause]) -> String {
    let spec = at.spec();
    let cause = causes.iter().find(|c| c.effect == spec.id && c.side.as_deref() == at.side_name());
    let values: Vec<String> = spec
        .parameters
        .iter()
        .enumerate()
        // A number at which nothing changes says nothing.
        .filter(|(i, p)| at.values()[*i] != p.neutral || spec.parameters.len() == 1)
        .map(|(i, p)| parameter(spec, p, at.values()[i], cause))
        .collect();
    let side = at.side_name().map(|s| format!(", {s}")).unwrap_or_default();
    let place = at
        .place()
        .map_or_else(String::new, |[x, y, r]| format!(", within {} m of ({}, {}) m", number(r), number(x), number(y)));
    format!("{} ({}){side}{place}: {}", spec.id, spec.name, values.join(", "))
}

fn parameter(spec: &EffectSpec, p: &Parameter, value: f64, cause: Option<&Cause>) -> String {
    let unit = if p.unit == "-" { String::new() } else { format!(" {}", p.unit) };
    let sigma = cause.and_then(|c| {
        // Where an effect has one number, its cause may know it as the magnitude only.
        let known = c.parameters.get(p.name).and_then(|e| e.sigma);
        known.or_else(|| c.sigma.filter(|_| spec.parameters.len() == 1))
    });
    let interval = sigma.map_or_else(String::new, |s| {
        format!(" (90 %: {} to {})", number(value - NINETY * s), number(value + NINETY * s))
    });
    format!("{} = {}{unit}{interval}", p.name, number(value))
}
