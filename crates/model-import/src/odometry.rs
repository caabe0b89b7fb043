//! Robot files of wheel motion beside a pose.

use serde::Serialize;

use crate::error::ImportError;
use crate::import::{Imported, Kind, Number};
use crate::layout::{Layout, Robot, mean};
use crate::rounded::{degrees, metres};
use crate::settings::SETTINGS;
use crate::source::Source;
use crate::wheels::{Hangs, Wheel};

/// A robot file of `kind = "odometry"`, as its reader has it.
#[derive(Serialize)]
struct File {
    name: String,
    description: String,
    kind: &'static str,
    wheel: Vec<Row>,
    known: Known,
    columns: Columns,
}

#[derive(Serialize)]
struct Row {
    name: String,
    place: [f64; 2],
    direction_deg: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    roller_deg: Option<f64>,
    radius: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    radius_sigma: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    column: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    steered: Option<bool>,
    #[serde(skip_serializing_if = "Option::is_none")]
    caster: Option<bool>,
    source: String,
}

#[derive(Serialize)]
struct Known {
    #[serde(skip_serializing_if = "Option::is_none")]
    track_sigma: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    wheelbase_sigma: Option<f64>,
    source: String,
}

#[derive(Serialize)]
struct Columns {
    time: &'static str,
    wheels: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    steering: Option<String>,
    x: &'static str,
    y: &'static str,
    yaw: &'static str,
}

/// The robot file.
pub(crate) fn file(source: &Source<'_>, robot: &Robot<'_>, name: &str) -> Result<Imported, ImportError> {
    let mut notes = robot.notes_without_casters();
    if robot.layout == Layout::SteeredAxles {
        return Err(robot.of_many_axles(source, Kind::Odometry));
    }
    let steering = robot.wheels.iter().find_map(|w| match w.hangs {
        Hangs::Steered(joint) => Some(robot.model.joints[joint].name.clone()),
        _ => None,
    });
    let skids = robot.layout == Layout::SkidSteer;
    if skids && robot.sides().iter().any(Vec::is_empty) {
        return Err(source.whole(
            "all wheels roll along one line, so that no difference of their speeds turns the robot; check the origins of the \
             wheel joints",
        ));
    }
    let mut wheel = if skids { sides(robot) } else { wheels(robot, &mut notes) };
    let extent = |axis: usize| {
        let places = || wheel.iter().map(|row| row.place[axis]);
        Some(places().fold(f64::MIN, f64::max) - places().fold(f64::MAX, f64::min)).filter(|x| *x > 0.0)
    };
    let known = Known {
        track_sigma: extent(1).map(|x| if skids { SETTINGS.spreads.skidding * x } else { SETTINGS.spreads.stated * x }),
        wheelbase_sigma: extent(0).map(|x| SETTINGS.spreads.stated * x),
        source: if skids {
            format!(
                "the effective track of sides that skid: {} times the measured one is usual (Mandow et al. 2007)",
                SETTINGS.skid.wider
            )
        } else {
            "guess: models are drawn by people".to_owned()
        },
    };
    let numbers = wheel.iter().filter(|row| row.caster.is_none()).flat_map(numbers).collect();
    wheel.extend(robot.casters.iter().map(|w| Row { caster: Some(true), column: None, ..row(robot, w, 0.0) }));
    notes.push(
        "columns are named after the joints, with angles in rad, and x_m, y_m, yaw_rad for the pose of the model's origin; \
         write your own names, and wheels = \"counts\" with counts_per_turn where counts are recorded"
            .to_owned(),
    );

    let whole = File {
        name: name.to_owned(),
        description: format!("Made from a model in {}, {}", robot.model.form, robot.layout.name()),
        kind: "odometry",
        wheel,
        known,
        columns: Columns { time: "time_s", wheels: "angle", steering, x: "x_m", y: "y_m", yaw: "yaw_rad" },
    };
    let text = toml::to_string(&whole).map_err(|e| source.whole(format!("it cannot be written as TOML: {e}")))?;
    Ok(Imported { kind: Kind::Odometry, layout: robot.layout.name(), text, spec: None, numbers, notes })
}

fn numbers(row: &Row) -> [Number; 3] {
    let of = |what: &str, value: f64| Number {
        name: format!("{} {what}", row.name),
        value,
        unit: "m".to_owned(),
        source: row.source.clone(),
        is_stated: true,
    };
    [of("radius", row.radius), of("x", row.place[0]), of("y", row.place[1])]
}

/// Every wheel by itself.
fn wheels(robot: &Robot<'_>, notes: &mut Vec<String>) -> Vec<Row> {
    if robot.layout == Layout::Tricycle {
        notes.push("each wheel has a column; take out that of wheels whose turning is not recorded".to_owned());
    }
    robot.wheels.iter().map(|wheel| row(robot, wheel, robot.roller(wheel))).collect()
}

fn row(robot: &Robot<'_>, wheel: &Wheel, roller: f64) -> Row {
    let [x, y] = robot.place(wheel).map(metres);
    Row {
        name: wheel.name.clone(),
        place: [x, y],
        direction_deg: degrees(robot.direction(wheel)),
        roller_deg: Some(degrees(roller)).filter(|r| *r != 0.0),
        radius: metres(wheel.radius),
        radius_sigma: Some(metres(SETTINGS.spreads.stated * wheel.radius)),
        column: Some(robot.model.joints[wheel.joint].name.clone()),
        steered: matches!(wheel.hangs, Hangs::Steered(_)).then_some(true),
        caster: None,
        source: format!("{}: joint {}", robot.model.form, robot.model.joints[wheel.joint].name),
    }
}

/// Sides that skid, as two wheels with the effective track between them.
fn sides(robot: &Robot<'_>) -> Vec<Row> {
    let sides = robot.sides();
    let y = |side: usize| mean(sides[side].iter().map(|w| robot.place(w)[1]));
    let x = mean(robot.wheels.iter().map(|w| robot.place(w)[0]));
    let (middle, half) = (0.5 * (y(0) + y(1)), 0.5 * SETTINGS.skid.wider * (y(0) - y(1)));
    let row = |(name, side, place): (&str, usize, f64)| {
        let radius = mean(sides[side].iter().map(|w| w.radius));
        let of = sides[side].iter().map(|w| robot.model.joints[w.joint].name.clone()).collect::<Vec<_>>();
        Row {
            name: name.to_owned(),
            place: [metres(x), metres(place)],
            direction_deg: degrees(robot.direction(sides[side][0])),
            roller_deg: None,
            radius: metres(radius),
            radius_sigma: Some(metres(SETTINGS.spreads.stated * radius)),
            column: of.first().cloned(),
            steered: None,
            caster: None,
            source: format!("{}: joints {}", robot.model.form, of.join(", ")),
        }
    };
    [("left side", 0, middle + half), ("right side", 1, middle - half)].map(row).into()
}
