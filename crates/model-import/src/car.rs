//! Robot files of cars.

use serde::Serialize;

use crate::error::ImportError;
use crate::import::{Imported, Kind, Number};
use crate::layout::{Layout, Robot, mean};
use crate::rounded::digits;
use crate::settings::SETTINGS;
use crate::source::Source;
use crate::wheels::{Hangs, Wheel};

/// A robot file of `kind = "car"`, as its reader has it.
#[derive(Serialize)]
struct File {
    name: String,
    description: String,
    kind: &'static str,
    wheelbase: Stated,
    #[serde(skip_serializing_if = "Option::is_none")]
    mass: Option<Stated>,
    #[serde(skip_serializing_if = "Option::is_none")]
    centre_of_mass: Option<Stated>,
    #[serde(skip_serializing_if = "Option::is_none")]
    yaw_inertia: Option<Stated>,
    wheel_radius: Stated,
    steering: Steering,
    point: Point,
    columns: Columns,
}

#[derive(Serialize, Clone)]
struct Stated {
    value: f64,
    sigma: f64,
    source: String,
}

#[derive(Serialize)]
struct Steering {
    full_angle: Stated,
    centre: Stated,
}

#[derive(Serialize)]
struct Point {
    x: Stated,
    y: Stated,
    yaw: Stated,
}

#[derive(Serialize)]
struct Columns {
    time: &'static str,
    throttle: &'static str,
    steering: &'static str,
    x: &'static str,
    y: &'static str,
    yaw: &'static str,
}

/// The robot file.
pub(crate) fn file(source: &Source<'_>, robot: &Robot<'_>, name: &str) -> Result<Imported, ImportError> {
    if robot.layout == Layout::SteeredAxles {
        return Err(robot.of_many_axles(source, Kind::Car));
    }
    if !matches!(robot.layout, Layout::Car | Layout::Tricycle) {
        return Err(source.whole(format!(
            "the model is {}, but a car has one steered and one fixed axle; leave out --kind car",
            robot.layout.name()
        )));
    }
    let (model, form) = (robot.model, robot.model.form);
    let ranges: Vec<[f64; 2]> = robot.steered(true).map(|w| range(source, robot, w)).collect::<Result<_, _>>()?;
    let along = |steered: bool| mean(robot.steered(steered).map(|w| robot.place(w)[0]));
    let across = mean(robot.steered(false).map(|w| robot.place(w)[1]));
    let (rear, wheelbase) = (along(false), along(true) - along(false));
    let stated = |value: f64, sigma: f64, what: &str| Stated {
        value: digits(value),
        sigma: digits(sigma),
        source: format!("{form}: {what}"),
    };

    let whole = model.solid(&model.of_robot());
    let mut notes = robot.notes_without_casters();
    if whole.is_none() {
        notes.push("no link states a mass: mass, centre of mass and yaw inertia are those of a usual car".to_owned());
    }
    let ahead = whole.map(|w| w.centre.coords.dot(&robot.forward) - rear);
    let between = ahead.filter(|a| (0.0..wheelbase).contains(a) && *a > 0.0);
    if ahead.is_some() && between.is_none() {
        notes.push("the centre of mass is not between the axles; it is taken to be in the middle".to_owned());
    }
    let radius = mean(robot.wheels.iter().map(|w| w.radius));
    let full = mean(ranges.iter().map(|[lower, upper]| 0.5 * (upper - lower)));
    let yaw = whole.map(|w| w.about_axis(&w.centre, &nalgebra::Vector3::z()));
    notes.push(
        "the drive's acceleration and dead zone are in no model; they are fitted. Columns are usual names: write yours, and \
         what steering is recorded in (steering_unit)"
            .to_owned(),
    );

    let all = File {
        name: name.to_owned(),
        description: format!("Made from a model in {form}, {}", robot.layout.name()),
        kind: "car",
        wheelbase: stated(wheelbase, SETTINGS.spreads.stated * wheelbase, "places of the wheel joints"),
        mass: whole.map(|w| stated(w.mass, SETTINGS.spreads.stated * w.mass, "masses of all links")),
        centre_of_mass: between
            .map(|x| stated(x, SETTINGS.spreads.stated * wheelbase, "centre of mass of all links, from the rear axle")),
        yaw_inertia: yaw.map(|j| {
            stated(j, SETTINGS.spreads.stated_inertia * j, "inertias of all links about their centre of mass")
        }),
        wheel_radius: stated(radius, SETTINGS.spreads.stated * radius, "shapes of the wheels"),
        steering: Steering {
            full_angle: stated(full, 2.0 * SETTINGS.spreads.stated * full, "limits of the steering joints"),
            centre: stated(
                mean(ranges.iter().map(|[l, u]| 0.5 * (l + u))),
                SETTINGS.spreads.centre,
                "limits of the steering joints",
            ),
        },
        point: Point {
            x: stated(-rear, SETTINGS.spreads.point, "origin of the model, from the rear axle"),
            y: stated(-across, SETTINGS.spreads.point, "origin of the model, from the rear axle"),
            yaw: stated(0.0, SETTINGS.spreads.direction, "axes of the model"),
        },
        columns: Columns {
            time: "time_s",
            throttle: "throttle",
            steering: "steering",
            x: "x_m",
            y: "y_m",
            yaw: "yaw_rad",
        },
    };
    let text = toml::to_string(&all).map_err(|e| source.whole(format!("it cannot be written as TOML: {e}")))?;
    let number = |name: &str, of: &Stated, unit: &str| Number {
        name: name.to_owned(),
        value: of.value,
        unit: unit.to_owned(),
        source: of.source.clone(),
        is_stated: true,
    };
    let mut numbers = vec![number("wheelbase", &all.wheelbase, "m")];
    numbers.extend(all.mass.as_ref().map(|m| number("mass", m, "kg")));
    numbers.extend(all.centre_of_mass.as_ref().map(|c| number("centre_of_mass", c, "m")));
    numbers.extend(all.yaw_inertia.as_ref().map(|j| number("yaw_inertia", j, "kg m2")));
    numbers.push(number("wheel_radius", &all.wheel_radius, "m"));
    numbers.push(number("steering full_angle", &all.steering.full_angle, "rad"));
    numbers.push(number("point x", &all.point.x, "m"));
    Ok(Imported { kind: Kind::Car, layout: robot.layout.name(), text, spec: None, numbers, notes })
}

/// Angles between which the joint of a steered wheel turns.
fn range(source: &Source<'_>, robot: &Robot<'_>, wheel: &Wheel) -> Result<[f64; 2], ImportError> {
    let Hangs::Steered(joint) = wheel.hangs else { return Ok([0.0; 2]) };
    let joint = &robot.model.joints[joint];
    // About an axis that points down, left is negative.
    let up = |[lower, upper]: [f64; 2]| if joint.axis.z < 0.0 { [-upper, -lower] } else { [lower, upper] };
    let stated = joint.range.filter(|_| !joint.is_endless()).or(joint.meant).filter(|range| *range != [0.0; 2]);
    let [lower, upper] = stated.map(up).ok_or_else(|| {
        source.whole(format!(
            "steering joint '{}' has no limits; add them in rad (URDF: type=\"revolute\" with <limit lower upper>): the angle \
             at full command is read from them",
            joint.name
        ))
    })?;
    if lower >= upper || lower.abs().max(upper.abs()) > std::f64::consts::FRAC_PI_2 {
        return Err(source.whole(format!(
            "steering joint '{}' has limits of {lower} and {upper} rad; the lower one must be less than the upper one, and no \
             wheel is steered by more than a right angle (1.5708 rad): are they in degrees?",
            joint.name
        )));
    }
    Ok([lower, upper])
}
