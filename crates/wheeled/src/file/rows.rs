//! Rows of a robot file of this kind, and the robot that they make.

mod known;

use odometry::file::seconds_in;
use robot_model::wheels::{Caster, Coupling, Ground, Joint, MOST, MOST_CASTERS, Motor, Robot, Wheel};
use serde::Deserialize;

use crate::file::Columns;
use crate::robot::AnyWheels;
use crate::settings::SETTINGS;
use known::{sigmas, usual_sigmas};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct File {
    name: String,
    pub(super) description: Option<String>,
    pub(super) kind: String,
    mass: Number,
    yaw_inertia: Number,
    centre_of_mass: [f64; 3],
    centre_of_mass_sigma: Option<f64>,
    #[serde(rename = "centre_of_mass_source")]
    _centre_of_mass_source: Option<String>,
    drag: Option<Number>,
    wheel: Vec<WheelRow>,
    #[serde(default)]
    caster: Vec<CasterRow>,
    motor: Vec<MotorRow>,
    #[serde(default)]
    joint: Vec<JointRow>,
    #[serde(default)]
    ground: GroundRow,
    #[serde(default)]
    known: KnownRow,
    #[serde(default)]
    point: PointRow,
    pub(super) columns: Option<ColumnNames>,
}

/// A number with its sigma and where it comes from.
#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct Number {
    value: f64,
    sigma: Option<f64>,
    /// Read by people.
    #[serde(rename = "source")]
    _source: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WheelRow {
    name: String,
    place: [f64; 2],
    #[serde(default)]
    direction_deg: f64,
    /// 0 without rollers.
    #[serde(default)]
    roller_deg: f64,
    radius: f64,
    radius_sigma: Option<f64>,
    inertia: f64,
    motor: Option<String>,
    steered_by: Option<String>,
    column: Option<String>,
    /// Read by people.
    #[serde(rename = "source")]
    _source: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CasterRow {
    place: [f64; 2],
    trail: f64,
    #[serde(default)]
    rolling_resistance: f64,
    #[serde(default)]
    pivot_friction: f64,
    /// Read by people.
    #[serde(rename = "source")]
    _source: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct MotorRow {
    name: String,
    column: String,
    /// N m at the wheels per unit of the column: torque constant times gear where the column is a current.
    #[serde(default = "one")]
    torque_per_unit: f64,
    #[serde(default)]
    differential: bool,
    #[serde(default)]
    inertia: f64,
    #[serde(default)]
    lag: f64,
    #[serde(default)]
    coulomb: f64,
    coulomb_sigma: Option<f64>,
    #[serde(default)]
    viscous: f64,
    viscous_sigma: Option<f64>,
    /// Read by people.
    #[serde(rename = "source")]
    _source: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct JointRow {
    name: String,
    place: [f64; 2],
    #[serde(default)]
    unsteered_axle_x: f64,
    column: String,
    /// Angle per unit of the column, in the unit of angles: -1 where it counts to the right.
    #[serde(default = "one")]
    angle_per_unit: f64,
    /// Angle where the column says none.
    #[serde(default)]
    zero_deg: f64,
    #[serde(default)]
    lag: f64,
    /// Read by people.
    #[serde(rename = "source")]
    _source: Option<String>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct GroundRow {
    adhesion: Option<f64>,
    slip_at_peak: Option<f64>,
    brush_share: Option<f64>,
    lateral_stiffness: Option<f64>,
    rest_speed: Option<f64>,
    rolling_resistance: Option<f64>,
    roller_drag: Option<f64>,
    #[serde(default)]
    slope_deg: [f64; 2],
    /// Read by people.
    #[serde(rename = "source")]
    _source: Option<String>,
}

/// How well other numbers are known: one sigma.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct KnownRow {
    place_share: Option<f64>,
    direction_deg: Option<f64>,
    torque_share: Option<f64>,
    lag: Option<f64>,
    steering_deg: Option<f64>,
    steering_share: Option<f64>,
    rolling_resistance: Option<f64>,
    slip_share: Option<f64>,
    adhesion_share: Option<f64>,
    slope_deg: Option<f64>,
    /// Read by people.
    #[serde(rename = "source")]
    _source: Option<String>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct PointRow {
    #[serde(default)]
    x: f64,
    #[serde(default)]
    y: f64,
    #[serde(default)]
    yaw_deg: f64,
    sigma: Option<f64>,
    yaw_sigma_deg: Option<f64>,
    /// Read by people.
    #[serde(rename = "source")]
    _source: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ColumnNames {
    time: String,
    time_unit: Option<String>,
    wheels: Option<String>,
    angle_unit: Option<String>,
    speed_unit: Option<String>,
    gyro_unit: Option<String>,
    gyro: Option<String>,
    x: Option<String>,
    y: Option<String>,
    yaw: Option<String>,
}

fn one() -> f64 {
    1.0
}

/// Place of a name in a list.
fn place(names: &[String], name: Option<&String>, what: &str, of: &str) -> Result<Option<usize>, String> {
    let Some(name) = name else { return Ok(None) };
    let found = names.iter().position(|n| n == name);
    found.map(Some).ok_or_else(|| {
        format!(
            "{of} names the {what} '{name}', which is not there; it has {}: correct the name, or add it",
            names.join(", ")
        )
    })
}

pub(super) fn columns(read: &File, names: &ColumnNames) -> Result<Columns, String> {
    let pose = match (&names.x, &names.y, &names.yaw) {
        (Some(x), Some(y), Some(yaw)) => Some([x, y, yaw].map(Clone::clone)),
        (None, None, None) => None,
        _ => return Err("[columns] names a part of the pose; give x, y and yaw, or none of them".to_owned()),
    };
    let wheels: Vec<String> = read.wheel.iter().filter_map(|w| w.column.clone()).collect();
    if wheels.is_empty() && pose.is_none() {
        return Err(
            "there is neither a wheel with a column nor a pose in [columns]; name the column of one, so that there is \
                    something to compare the torques with"
                .to_owned(),
        );
    }
    let is_speed = match (names.wheels.as_deref(), wheels.is_empty()) {
        (Some("speed"), _) | (None, true) => true,
        (Some("angle"), _) => false,
        (Some(other), _) => return Err(format!("[columns] wheels = \"{other}\"; write speed or angle")),
        (None, false) => return Err("[columns] has no wheels; write wheels = \"speed\" or \"angle\"".to_owned()),
    };
    let angle = match names.angle_unit.as_deref() {
        None | Some("rad") => 1.0,
        Some("deg") => 1.0_f64.to_radians(),
        Some(other) => return Err(format!("angle_unit = \"{other}\"; write rad or deg")),
    };
    let turn = std::f64::consts::TAU;
    let degree = 1.0_f64.to_radians();
    let speed = match names.speed_unit.as_deref() {
        None | Some("rad/s") => 1.0,
        Some(_) if !is_speed => {
            return Err(
                "[columns] states a speed_unit, but wheels = \"angle\"; write wheels = \"speed\", or leave it out"
                    .to_owned(),
            );
        }
        Some("deg/s") => degree,
        Some("turn/s") => turn,
        Some("rpm") => turn / 60.0,
        Some(other) => return Err(format!("speed_unit = \"{other}\"; write rad/s, deg/s, turn/s or rpm")),
    };
    let rate = match names.gyro_unit.as_deref() {
        None | Some("rad/s") => 1.0,
        Some("deg/s") => degree,
        Some(other) => return Err(format!("gyro_unit = \"{other}\"; write rad/s or deg/s")),
    };
    Ok(Columns {
        time: names.time.clone(),
        second: seconds_in(names.time_unit.as_deref())?,
        torque: read.motor.iter().map(|m| (m.column.clone(), m.torque_per_unit)).collect(),
        joints: read.joint.iter().map(|j| (j.column.clone(), j.angle_per_unit * angle)).collect(),
        wheels,
        is_speed,
        turning: if is_speed { speed } else { angle },
        angle,
        rate,
        gyro: names.gyro.clone(),
        pose,
    })
}

pub(super) fn robot(read: &File) -> Result<AnyWheels, String> {
    let names = |all: Vec<&String>, what: &str, most: usize| -> Result<Vec<String>, String> {
        if all.len() > most {
            return Err(format!(
                "{} {what}s, but a robot has {most} at most; leave out those that carry nothing",
                all.len()
            ));
        }
        let twice = all.iter().enumerate().find(|(k, name)| all[..*k].contains(name));
        match twice {
            Some((_, name)) => Err(format!("{what} '{name}': two {what}s have this name; give each its own")),
            None => Ok(all.into_iter().cloned().collect()),
        }
    };
    let wheels = names(read.wheel.iter().map(|w| &w.name).collect(), "wheel", MOST)?;
    let motors = names(read.motor.iter().map(|m| &m.name).collect(), "motor", MOST)?;
    let joints = names(read.joint.iter().map(|j| &j.name).collect(), "joint", MOST)?;
    if read.caster.len() > MOST_CASTERS {
        return Err(format!("{} casters, but a robot has {MOST_CASTERS} at most", read.caster.len()));
    }

    let mut plant = Robot {
        mass: read.mass.value,
        yaw_inertia: read.yaw_inertia.value,
        com: read.centre_of_mass,
        wheels: [None; MOST],
        casters: [None; MOST_CASTERS],
        motors: [None; MOST],
        joints: [None; MOST],
        drag: read.drag.as_ref().map_or(0.0, |drag| drag.value),
        ground: ground(&read.ground)?,
    };
    for (to, row) in plant.wheels.iter_mut().zip(&read.wheel) {
        let of = format!("wheel '{}'", row.name);
        *to = Some(Wheel {
            place: row.place,
            direction: row.direction_deg.to_radians(),
            roller: (row.roller_deg != 0.0).then(|| row.roller_deg.to_radians()),
            radius: row.radius,
            inertia: row.inertia,
            motor: place(&motors, row.motor.as_ref(), "motor", &of)?,
            joint: place(&joints, row.steered_by.as_ref(), "joint", &of)?,
        });
    }
    for (k, row) in read.motor.iter().enumerate() {
        if read.wheel.iter().all(|w| w.motor.as_ref() != Some(&row.name)) {
            return Err(format!("motor '{}' turns no wheel; write motor = \"{}\" at its wheels", row.name, row.name));
        }
        let coupling = if row.differential { Coupling::Differential } else { Coupling::Rigid };
        plant.motors[k] = Some(Motor {
            coupling,
            inertia: row.inertia,
            gain: 1.0,
            lag: row.lag,
            coulomb: row.coulomb,
            viscous: row.viscous,
        });
    }
    for (to, row) in plant.casters.iter_mut().zip(&read.caster) {
        *to = Some(Caster {
            pivot: row.place,
            trail: row.trail,
            rolling: row.rolling_resistance,
            pivot_friction: row.pivot_friction,
        });
    }
    check_units(read)?;
    for (to, row) in plant.joints.iter_mut().zip(&read.joint) {
        if row.unsteered_axle_x == row.place[0] {
            return Err(format!(
                "joint '{}': unsteered_axle_x is that of the joint itself; give x of an axle that does not steer, or any other x \
                 where each steered wheel has its own joint",
                row.name
            ));
        }
        *to = Some(Joint {
            place: row.place,
            about: row.unsteered_axle_x,
            offset: row.zero_deg.to_radians(),
            gain: 1.0,
            lag: row.lag,
        });
    }
    let mut out = AnyWheels {
        name: read.name.clone(),
        plant,
        wheels,
        motors,
        joints,
        measured: read.wheel.iter().enumerate().filter(|(_, w)| w.column.is_some()).map(|(k, _)| k).collect(),
        point: [read.point.x, read.point.y, read.point.yaw_deg.to_radians()],
        sigmas: usual_sigmas(read.wheel.len()),
    };
    out.sigmas = sigmas(read, &out)?;
    Ok(out)
}

/// Refuses columns of which a unit means nothing.
fn check_units(read: &File) -> Result<(), String> {
    let per_unit = read.motor.iter().map(|m| ("motor", &m.name, "torque_per_unit", m.torque_per_unit));
    let mut per_unit =
        per_unit.chain(read.joint.iter().map(|j| ("joint", &j.name, "angle_per_unit", j.angle_per_unit)));
    per_unit.find(|(.., value)| *value == 0.0 || !value.is_finite()).map_or(Ok(()), |(part, name, key, value)| {
        Err(format!("{part} '{name}': {key} is {value}; give what one unit of its column means, or leave it out"))
    })
}

fn ground(row: &GroundRow) -> Result<Ground<f64>, String> {
    let usual = Ground::usual();
    let steepest = SETTINGS.units.steepest;
    if let Some(slope) = row.slope_deg.iter().find(|slope| !(-steepest..=steepest).contains(*slope)) {
        return Err(format!(
            "[ground] slope_deg holds {slope}; give how far the ground rises along x and along y of the pose, in degrees, at most \
             {steepest}"
        ));
    }
    Ok(Ground {
        adhesion: row.adhesion.unwrap_or(usual.adhesion),
        slip_at_peak: row.slip_at_peak.unwrap_or(usual.slip_at_peak),
        brush_share: row.brush_share.unwrap_or(usual.brush_share),
        lateral_stiffness: row.lateral_stiffness.unwrap_or(usual.lateral_stiffness),
        rest_speed: row.rest_speed.unwrap_or(usual.rest_speed),
        rolling: row.rolling_resistance.unwrap_or(usual.rolling),
        roller_drag: row.roller_drag.unwrap_or(usual.roller_drag),
        slope: row.slope_deg.map(|slope| -slope.to_radians() * usual.gravity),
        ..usual
    })
}
