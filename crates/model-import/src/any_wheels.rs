//! Robot files of any wheels under torque.

mod motors;
mod rows;
#[cfg(test)]
mod tests;

use nalgebra::Vector3;
use robot_model::robot::USUAL_SLIDING_SHARE;
use robot_model::wheels::{Caster, Ground, MOST, MOST_CASTERS, Robot as Plant, Wheel as PlantWheel};

use crate::error::ImportError;
use crate::import::{Imported, Kind, Number};
use crate::layout::{Robot, mean};
use crate::rounded::{degrees, digits, metres};
use crate::settings::SETTINGS;
use crate::solid::Solid;
use crate::source::Source;
use crate::torque::not_of_rubber;
use crate::wheels::{Hangs, Wheel};
use motors::motors;
use rows::{CasterRow, Columns, File, GroundRow, JointRow, Known, Point, Stated, WheelRow};

/// The robot file.
pub(crate) fn file(source: &Source<'_>, robot: &Robot<'_>, name: &str) -> Result<Imported, ImportError> {
    let (model, form) = (robot.model, robot.model.form);
    let Some(whole) = model.solid(&model.of_robot()) else {
        return Err(source.whole(
            "no link states a mass, but wheeled robots need mass and inertia: add <inertial> to the links, or compare wheel motion \
             with a pose alone (--kind odometry)",
        ));
    };
    let mut notes = robot.notes.clone();
    let load = load(robot, &whole);
    let rolling = rolling(robot, load);
    // Of one wheel, N m.
    let rolls = rolling * load * mean(robot.wheels.iter().map(|w| w.radius));
    let motors = motors(robot, &mut notes);
    let stated = |value: f64, share: f64, what: &str| Stated {
        value: digits(value),
        sigma: digits(share * value),
        source: format!("{form}: {what}"),
    };
    let centre = whole.centre;
    let [x, y] = robot.seen_from_origin(&centre).map(metres);
    let ground = ground(robot, rolling, &mut notes);
    let known = Known {
        place_share: SETTINGS.spreads.stated,
        adhesion_share: ground.adhesion.map(|_| SETTINGS.spreads.stated_friction),
    };

    let out = File {
        name: name.to_owned(),
        description: format!("Made from a model in {form}, {}", robot.layout.name()),
        kind: Kind::Wheeled.name(),
        mass: stated(whole.mass, SETTINGS.spreads.stated, "masses of all links"),
        yaw_inertia: stated(
            whole.about_axis(&centre, &Vector3::z()),
            SETTINGS.spreads.stated_inertia,
            "inertias of all links about their centre of mass",
        ),
        centre_of_mass: [x, y, metres(centre.z - robot.ground)],
        centre_of_mass_sigma: metres(SETTINGS.spreads.stated * longest(robot)),
        centre_of_mass_source: format!(
            "{form}: centre of mass of all links, from the model's origin and above the ground"
        ),
        wheel: robot.wheels.iter().map(|w| wheel(robot, w, &whole, &motors)).collect(),
        caster: casters(robot, &mut notes),
        motor: motors.iter().map(|m| m.row(robot, rolls)).collect(),
        joint: joints(robot, &mut notes),
        ground,
        known,
        point: Point { x: 0.0, y: 0.0, yaw_deg: degrees(robot.left().x.atan2(robot.forward.x)) },
        columns: Columns { time: "time_s", wheels: "speed", gyro: "gyro_z", x: "x_m", y: "y_m", yaw: "yaw_rad" },
    };
    checked(source, &out)?;
    notes.push(
        "columns are torque_, speed_ and angle_ with the names of the joints, gyro_z, and x_m, y_m, yaw_rad for the pose of the \
         model's origin; write your own names, and where motors' currents are recorded, torque_per_unit"
            .to_owned(),
    );
    let text = toml::to_string(&out).map_err(|e| source.whole(format!("it cannot be written as TOML: {e}")))?;
    Ok(Imported { kind: Kind::Wheeled, layout: robot.layout.name(), text, spec: None, numbers: numbers(&out), notes })
}

/// Longest distance between two wheels, m.
fn longest(robot: &Robot<'_>) -> f64 {
    let from = |a: &Wheel| robot.wheels.iter().map(|b| (a.centre - b.centre).norm()).fold(0.0, f64::max);
    robot.wheels.iter().map(from).fold(0.0, f64::max)
}

/// Load of a contact where all carry the same, N.
fn load(robot: &Robot<'_>, whole: &Solid) -> f64 {
    let contacts = robot.wheels.len() + robot.casters.len() + robot.sliders.len();
    whole.mass * Ground::<f64>::usual().gravity / contacts as f64
}

/// Rolling resistance that is taken off the friction of driven joints: the usual one, and at most half of the weakest joint's.
/// Simulators have none, so that joint friction stands for both.
fn rolling(robot: &Robot<'_>, load: f64) -> f64 {
    let friction = |w: &Wheel| robot.model.joints[w.joint].friction.filter(|f| *f > 0.0);
    let most = robot.wheels.iter().filter_map(|w| Some(0.5 * friction(w)? / (load * w.radius)));
    most.fold(Ground::<f64>::usual().rolling, f64::min)
}

fn ground(robot: &Robot<'_>, rolling: f64, notes: &mut Vec<String>) -> GroundRow {
    let adhesion = match robot.adhesion(USUAL_SLIDING_SHARE) {
        Some(Ok(peak)) => Some(digits(peak)),
        Some(Err(filler)) => {
            notes.push(not_of_rubber(filler));
            None
        }
        None => None,
    };
    let source = if adhesion.is_some() { "friction of the wheels, as the middle of peak and sliding; " } else { "" };
    GroundRow {
        adhesion,
        rolling_resistance: digits(rolling),
        source: format!("{}: {source}rolling resistance is a guess", robot.model.form),
    }
}

fn wheel(robot: &Robot<'_>, wheel: &Wheel, whole: &Solid, motors: &[motors::Group]) -> WheelRow {
    let model = robot.model;
    let joint = &model.joints[wheel.joint];
    let spin = model.solid(&wheel.links).map(|s| s.about_axis(&wheel.centre, &wheel.axle)).filter(|spin| *spin > 0.0);
    // A disc of a usual share of the robot's mass.
    let usual = 0.5 * SETTINGS.fillers.wheel_mass * whole.mass * wheel.radius * wheel.radius;
    let motor = motors.iter().find(|m| m.wheels.contains(&wheel.joint));
    let is_first = motor.is_some_and(|m| m.wheels[0] == wheel.joint);
    let inertia = if spin.is_some() { "" } else { "; its inertia is a guess" };
    WheelRow {
        name: wheel.name.clone(),
        place: robot.place(wheel).map(metres),
        direction_deg: degrees(robot.direction(wheel)),
        roller_deg: Some(degrees(robot.roller(wheel))).filter(|r| *r != 0.0),
        radius: metres(wheel.radius),
        radius_sigma: metres(SETTINGS.spreads.stated * wheel.radius),
        inertia: digits(spin.unwrap_or(usual)),
        has_inertia: spin.is_some(),
        motor: motor.map(|m| m.name.clone()),
        steered_by: match wheel.hangs {
            Hangs::Steered(k) => Some(model.joints[k].name.clone()),
            _ => None,
        },
        column: is_first.then(|| format!("speed_{}", joint.name)),
        source: format!("{}: joint {}{inertia}", model.form, joint.name),
    }
}

fn casters(robot: &Robot<'_>, notes: &mut Vec<String>) -> Vec<CasterRow> {
    let form = robot.model.form;
    let hung = robot.casters.iter().map(|w| {
        let pivot = w.pivot.unwrap_or(w.centre);
        let trail = (w.centre - pivot).xy().norm();
        CasterRow {
            place: robot.seen_from_origin(&pivot).map(metres),
            trail: metres(trail),
            has_trail: true,
            rolling_resistance: Ground::<f64>::usual().rolling,
            source: format!("{form}: joint {}; its rolling resistance is a guess", robot.model.joints[w.joint].name),
        }
    });
    let sliding = robot.sliders.iter().map(|s| CasterRow {
        place: robot.seen_from_origin(&s.centre).map(metres),
        trail: SETTINGS.fillers.sphere_trail,
        has_trail: false,
        rolling_resistance: Ground::<f64>::usual().rolling,
        source: format!("{form}: sphere of {}; its trail and rolling resistance are guesses", s.name),
    });
    if !robot.sliders.is_empty() {
        notes.push(format!(
            "spheres that slide along the ground are taken for casters with a trail of {} m: correct [[caster]]",
            SETTINGS.fillers.sphere_trail
        ));
    }
    hung.chain(sliding).collect()
}

/// A joint for every steered wheel.
fn joints(robot: &Robot<'_>, notes: &mut Vec<String>) -> Vec<JointRow> {
    let model = robot.model;
    let axle = mean(robot.steered(false).map(|w| robot.place(w)[0]));
    robot
        .wheels
        .iter()
        .filter_map(|w| {
            let Hangs::Steered(k) = w.hangs else { return None };
            let joint = &model.joints[k];
            let place = robot.place(w).map(metres);
            let beside = w.pivot.map_or(0.0, |pivot| (w.centre - pivot).xy().norm());
            if beside > SETTINGS.wheels.trail * w.radius {
                notes.push(format!(
                    "wheel {} stands {beside:.3} m beside the axis of its steering joint; it is taken to turn about its contact",
                    w.name
                ));
            }
            // Of a wheel at its joint's own place it does not matter where the other axle is, but there has to be one.
            let unsteered_axle_x = if (axle - place[0]).abs() > beside { metres(axle) } else { place[0] - 1.0 };
            Some(JointRow {
                name: joint.name.clone(),
                place,
                unsteered_axle_x,
                column: format!("angle_{}", joint.name),
                // About an axis that points down, left is negative.
                angle_per_unit: (joint.axis.z < 0.0).then_some(-1.0),
                source: format!("{}: joint {}", model.form, joint.name),
            })
        })
        .collect()
}

/// Refuses what no robot of this kind can be, before a file of it is written.
fn checked(source: &Source<'_>, of: &File) -> Result<(), ImportError> {
    for (what, count, most) in [("wheels", of.wheel.len(), MOST), ("casters", of.caster.len(), MOST_CASTERS)] {
        if count > most {
            return Err(source.whole(format!(
                "the model has {count} {what}, but a robot of kind wheeled has {most} at most; leave out those that carry nothing"
            )));
        }
    }
    // Wheels that hang on one steering joint turn with it as a whole, which no robot file of this kind says.
    let shared = of.joint.iter().enumerate().find(|(k, row)| of.joint[..*k].iter().any(|other| other.name == row.name));
    if let Some((_, row)) = shared {
        return Err(source.whole(format!(
            "steering joint '{}' carries several wheels, an axle that turns as a whole; robots of kind wheeled have a steering joint for \
             each wheel: draw one for each",
            row.name
        )));
    }
    let mut plant = Plant {
        mass: of.mass.value,
        yaw_inertia: of.yaw_inertia.value,
        com: of.centre_of_mass,
        wheels: [None; MOST],
        casters: [None; MOST_CASTERS],
        motors: [None; MOST],
        joints: [None; MOST],
        drag: 0.0,
        ground: Ground::usual(),
    };
    // Motors and joints are named after what is there; what may be wrong are numbers of links, and where the robot stands.
    for (to, w) in plant.wheels.iter_mut().zip(&of.wheel) {
        let roller = w.roller_deg.map(f64::to_radians);
        let (place, direction) = (w.place, w.direction_deg.to_radians());
        let (radius, inertia) = (w.radius, w.inertia);
        *to = Some(PlantWheel { place, direction, roller, radius, inertia, motor: None, joint: None });
    }
    for (to, c) in plant.casters.iter_mut().zip(&of.caster) {
        *to = Some(Caster { pivot: c.place, trail: c.trail, rolling: c.rolling_resistance, pivot_friction: 0.0 });
    }
    let cannot_be = |e: robot_model::ModelError| source.whole(format!("no robot of kind wheeled can be so: {e}"));
    plant.checked().map(|_| ()).map_err(cannot_be)
}

fn numbers(of: &File) -> Vec<Number> {
    let number = |name: &str, value: f64, unit: &str, source: &str| Number {
        name: name.to_owned(),
        value,
        unit: unit.to_owned(),
        source: source.to_owned(),
        is_stated: true,
    };
    let guessed = |name: &str, value: f64, unit: &str| Number {
        is_stated: false,
        ..number(name, value, unit, "not in the model: usual value, a guess")
    };
    let mut out = vec![
        number("mass", of.mass.value, "kg", &of.mass.source),
        number("yaw_inertia", of.yaw_inertia.value, "kg m2", &of.yaw_inertia.source),
    ];
    for (axis, value) in ["x", "y", "height"].iter().zip(of.centre_of_mass) {
        out.push(number(&format!("centre_of_mass {axis}"), value, "m", &of.centre_of_mass_source));
    }
    for w in &of.wheel {
        for (what, value) in [("radius", w.radius), ("x", w.place[0]), ("y", w.place[1])] {
            out.push(number(&format!("{} {what}", w.name), value, "m", &w.source));
        }
        let name = format!("{} inertia", w.name);
        out.push(if w.has_inertia {
            number(&name, w.inertia, "kg m2", &w.source)
        } else {
            guessed(&name, w.inertia, "kg m2")
        });
    }
    for m in &of.motor {
        let all = [("inertia", m.inertia, "kg m2"), ("coulomb", m.coulomb, "N m"), ("viscous", m.viscous, "N m s/rad")];
        let stated = all.iter().filter_map(|(what, value, unit)| Some((what, (*value)?, unit)));
        out.extend(stated.map(|(what, value, unit)| number(&format!("{} {what}", m.name), value, unit, &m.source)));
    }
    for (k, c) in of.caster.iter().enumerate() {
        let name = format!("caster {} trail", k + 1);
        out.push(if c.has_trail { number(&name, c.trail, "m", &c.source) } else { guessed(&name, c.trail, "m") });
    }
    out.extend(of.ground.adhesion.map(|mu| number("adhesion", mu, "-", &of.ground.source)));
    out.push(guessed("rolling_resistance", of.ground.rolling_resistance, "-"));
    out.sort_by_key(|n| !n.is_stated);
    out
}
