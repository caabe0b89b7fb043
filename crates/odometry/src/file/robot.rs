//! The robot file of `kind = "odometry"`.

use hierarchical_fit::CaseError;
use serde::Deserialize;

use crate::drive::WheelData;
use crate::error::OdometryError;
use crate::wheel::{Sigmas, Wheel, WheeledRobot};

/// Robots that are built in, each with its file.
pub const BUILT_IN: &[(&str, &str)] = &[
    ("differential", include_str!("../../robots/differential.toml")),
    ("tricycle", include_str!("../../robots/tricycle.toml")),
    ("omni-3", include_str!("../../robots/omni-3.toml")),
    ("omni-4", include_str!("../../robots/omni-4.toml")),
    ("mecanum-4", include_str!("../../robots/mecanum-4.toml")),
    ("skid-steer-4", include_str!("../../robots/skid-steer-4.toml")),
];

/// A robot with the columns in which its drives are recorded.
#[derive(Debug, Clone, PartialEq)]
pub struct RobotFile {
    /// The robot.
    pub robot: WheeledRobot,
    /// What it is, for people.
    pub description: Option<String>,
    /// Where its drives are recorded.
    pub columns: Columns,
}

/// Columns of a drive.
#[derive(Debug, Clone, PartialEq)]
pub struct Columns {
    /// Column of the time.
    pub time: String,
    /// Seconds per unit of the time.
    pub second: f64,
    /// What the columns of the wheels hold.
    pub data: WheelData,
    /// Column of each measured wheel, in their order.
    pub wheels: Vec<String>,
    /// Column of the steering angle.
    pub steering: Option<String>,
    /// Columns of x, y and yaw.
    pub pose: Option<[String; 3]>,
    /// Column of the yaw rate, which stands for the pose where that is not recorded.
    pub gyro: Option<String>,
    /// Metres per unit of x and y.
    pub length: f64,
    /// Radians per unit of yaw and steering.
    pub angle: f64,
    /// What separates a file's session from the rest of its name; every file is a session where there is none.
    pub session_separator: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    name: String,
    description: Option<String>,
    kind: String,
    wheel: Vec<WheelRow>,
    #[serde(default)]
    known: Known,
    columns: Option<ColumnNames>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WheelRow {
    name: String,
    place: [f64; 2],
    #[serde(default)]
    direction_deg: f64,
    #[serde(default)]
    roller_deg: f64,
    radius: f64,
    radius_sigma: Option<f64>,
    counts_per_turn: Option<f64>,
    column: Option<String>,
    #[serde(default)]
    steered: bool,
    /// Swivels freely: determines nothing, and is left out.
    #[serde(default)]
    caster: bool,
    /// Where its numbers come from; read by people.
    #[serde(rename = "source")]
    _source: Option<String>,
}

/// How well other numbers are known: one sigma, and where that comes from.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Known {
    track_sigma: Option<f64>,
    wheelbase_sigma: Option<f64>,
    steering_sigma_deg: Option<f64>,
    steering_gain_sigma: Option<f64>,
    pose_direction_sigma_deg: Option<f64>,
    pose_origin_sigma: Option<f64>,
    #[serde(rename = "source")]
    _source: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ColumnNames {
    time: String,
    time_unit: Option<String>,
    wheels: String,
    steering: Option<String>,
    x: Option<String>,
    y: Option<String>,
    yaw: Option<String>,
    gyro: Option<String>,
    length_unit: Option<String>,
    angle_unit: Option<String>,
    session_separator: Option<String>,
}

/// Whether a robot file says that it is of a kind.
pub fn is_of_kind(text: &str, kind: &str) -> bool {
    let quoted = |rest: &str| ["\"", "'"].iter().any(|quote| rest.contains(&format!("{quote}{kind}{quote}")));
    text.lines().map(str::trim).any(|l| l.strip_prefix("kind").is_some_and(quoted))
}

/// Every sigma that is stated is above zero.
fn known_above_none(read: &File) -> Result<(), String> {
    let known = &read.known;
    let stated = [
        ("track_sigma", known.track_sigma),
        ("wheelbase_sigma", known.wheelbase_sigma),
        ("steering_sigma_deg", known.steering_sigma_deg),
        ("steering_gain_sigma", known.steering_gain_sigma),
        ("pose_direction_sigma_deg", known.pose_direction_sigma_deg),
        ("pose_origin_sigma", known.pose_origin_sigma),
    ];
    let of_wheels = read.wheel.iter().map(|w| ("radius_sigma", w.radius_sigma));
    let mut wrong = of_wheels.chain(stated).filter_map(|(name, sigma)| Some((name, sigma?)));
    wrong.find(|(_, sigma)| sigma.is_nan() || *sigma <= 0.0).map_or(Ok(()), |(name, sigma)| {
        Err(format!(
            "{name} is {sigma}; it has to be above 0: give one sigma of how well this is known, or leave it out"
        ))
    })
}

/// Seconds in a unit of time, which is the second where none is stated.
///
/// # Errors
/// Another unit than s, ms, us and ns.
pub fn seconds_in(unit: Option<&str>) -> Result<f64, String> {
    match unit {
        None | Some("s") => Ok(1.0),
        Some("ms") => Ok(1e-3),
        Some("us") => Ok(1e-6),
        Some("ns") => Ok(1e-9),
        Some(other) => Err(format!("time_unit = \"{other}\"; write s, ms, us or ns")),
    }
}

/// Columns of x, y and yaw; none where a gyro stands for them.
fn pose_columns(names: &ColumnNames) -> Result<Option<[String; 3]>, String> {
    match (&names.x, &names.y, &names.yaw) {
        (Some(x), Some(y), Some(yaw)) => Ok(Some([x, y, yaw].map(Clone::clone))),
        (None, None, None) if names.gyro.is_some() => Ok(None),
        (None, None, None) => Err(
            "[columns] names neither a pose nor a gyro; give x, y and yaw, or gyro with the column of the yaw rate, so that there is \
             something to compare the wheels with"
                .to_owned(),
        ),
        _ => Err("[columns] names a part of the pose; give x, y and yaw, or none of them: a position without a heading is not compared".to_owned()),
    }
}

impl RobotFile {
    /// Whether a robot file is one of this kind.
    pub fn is_one(text: &str) -> bool {
        is_of_kind(text, "odometry")
    }

    /// A built-in robot; `None` where there is none of this name.
    ///
    /// # Errors
    /// As [`RobotFile::parse`].
    pub fn built_in(name: &str) -> Option<Result<Self, OdometryError>> {
        BUILT_IN.iter().find(|b| b.0 == name).map(|(name, text)| Self::parse(&format!("{name}.toml"), text))
    }

    /// Reads a robot file.
    ///
    /// # Errors
    /// Syntax, unknown keys, units and numbers that cannot be, with what to do.
    pub fn parse(file: &str, text: &str) -> Result<Self, OdometryError> {
        let wrong = |what: String| OdometryError::Case(CaseError::Robot { robot: file.to_owned(), what });
        let mut read: File = toml::from_str(text).map_err(|e| wrong(e.message().to_owned()))?;
        if read.kind != "odometry" {
            return Err(wrong(format!("kind = \"{}\"; wheels and columns belong to kind = \"odometry\"", read.kind)));
        }
        known_above_none(&read).map_err(wrong)?;
        let Some(names) = read.columns else {
            return Err(wrong("no [columns]; say which columns hold time, wheels and pose".to_owned()));
        };

        if let Some(caster) = read.wheel.iter().find(|w| w.caster && (w.column.is_some() || w.steered)) {
            return Err(wrong(format!(
                "wheel '{}' is a caster and yet has a column or is steered; a caster follows and its counts tell no motion: \
                 leave out column and steered, or caster",
                caster.name
            )));
        }
        read.wheel.retain(|w| !w.caster);
        let steered = read.wheel.iter().find(|w| w.steered);
        if let (Some(wheel), None) = (steered, &names.steering) {
            return Err(wrong(format!(
                "wheel '{}' is steered, but [columns] has no steering; name the column of its angle",
                wheel.name
            )));
        }
        if let (None, Some(column)) = (steered, &names.steering) {
            return Err(wrong(format!(
                "[columns] steering = \"{column}\", but no wheel is steered; write steered = true at the wheel, or leave \
                 the column out"
            )));
        }
        let known = &read.known;
        let measured: Vec<&WheelRow> = read.wheel.iter().filter(|w| w.column.is_some()).collect();
        let relative = |row: &&WheelRow| row.radius_sigma.map(|s| s / row.radius);
        let sigmas: Vec<f64> = measured.iter().filter_map(relative).collect();
        let extent = |axis: usize| {
            let places = || read.wheel.iter().map(|w| w.place[axis]);
            places().fold(f64::MIN, f64::max) - places().fold(f64::MAX, f64::min)
        };
        let share = |sigma: Option<f64>, axis: usize| sigma.filter(|_| extent(axis) > 0.0).map(|s| s / extent(axis));
        let robot = WheeledRobot {
            name: read.name.clone(),
            wheels: read.wheel.iter().map(wheel).collect(),
            sigmas: Sigmas {
                radius: inference::robust::median(sigmas),
                across: share(known.track_sigma, 1),
                along: share(known.wheelbase_sigma, 0),
                steering: known.steering_sigma_deg.map(f64::to_radians),
                steering_gain: known.steering_gain_sigma,
                mounting: known.pose_direction_sigma_deg.map(f64::to_radians),
                origin: known.pose_origin_sigma,
            },
        };
        robot.checked()?;

        let data = match names.wheels.as_str() {
            "counts" => WheelData::Counts,
            "counter" => WheelData::Counter,
            "angle" => WheelData::Angle,
            "speed" => WheelData::Speed,
            other => {
                return Err(wrong(format!("[columns] wheels = \"{other}\"; write counts, counter, angle or speed")));
            }
        };
        let lacking = measured.iter().find(|w| w.counts_per_turn.is_none());
        if let (WheelData::Counts | WheelData::Counter, Some(wheel)) = (data, lacking) {
            let what = format!("wheel '{}' has counts but no counts_per_turn; give the counts of one turn", wheel.name);
            return Err(wrong(what));
        }
        let length = match names.length_unit.as_deref() {
            None | Some("m") => 1.0,
            Some("mm") => 1.0 / crate::settings::SETTINGS.drive.milli,
            Some(other) => return Err(wrong(format!("length_unit = \"{other}\"; write m or mm"))),
        };
        let angle = match names.angle_unit.as_deref() {
            None | Some("rad") => 1.0,
            Some("deg") => 1.0_f64.to_radians(),
            Some(other) => return Err(wrong(format!("angle_unit = \"{other}\"; write rad or deg"))),
        };
        let pose = pose_columns(&names).map_err(wrong)?;
        let second = seconds_in(names.time_unit.as_deref()).map_err(wrong)?;
        let columns = Columns {
            time: names.time,
            second,
            data,
            wheels: measured.iter().filter_map(|w| w.column.clone()).collect(),
            steering: names.steering,
            pose,
            gyro: names.gyro,
            length,
            angle,
            session_separator: names.session_separator,
        };
        Ok(Self { robot, description: read.description, columns })
    }
}

fn wheel(row: &WheelRow) -> Wheel {
    Wheel {
        name: row.name.clone(),
        place: row.place,
        direction: row.direction_deg.to_radians(),
        roller: row.roller_deg.to_radians(),
        radius: row.radius,
        counts_per_turn: row.counts_per_turn,
        measured: row.column.is_some(),
        steered: row.steered,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn built_in_robots_are_those_of_their_kinds() {
        for (name, text) in BUILT_IN {
            let file = RobotFile::built_in(name).expect("a file").unwrap_or_else(|e| panic!("{name}: {e}"));
            assert!(RobotFile::is_one(text) && file.columns.wheels.len() == file.robot.measured().len(), "{name}");
        }
        let near = |a: &WheeledRobot, b: &WheeledRobot| {
            for (a, b) in a.wheels.iter().zip(&b.wheels) {
                for axis in 0..2 {
                    approx::assert_abs_diff_eq!(a.place[axis], b.place[axis], epsilon = 1e-5);
                }
                approx::assert_abs_diff_eq!(a.direction.cos(), b.direction.cos(), epsilon = 1e-9);
                approx::assert_abs_diff_eq!(a.roller, b.roller, epsilon = 1e-9);
            }
        };
        let of = |name: &str| RobotFile::built_in(name).expect("a file").expect("a robot").robot;
        near(&of("omni-3"), &WheeledRobot::omni_3(0.051, 0.195));
        near(&of("tricycle"), &WheeledRobot::tricycle(0.0325, 0.15));
        near(&of("omni-4"), &WheeledRobot::omni_4(0.05, 0.2));
    }

    #[test]
    fn what_is_wrong_with_a_file_is_one_clear_sentence() {
        let (_, text) = BUILT_IN[0];
        let refused = |from: &str, to: &str| {
            assert!(text.contains(from), "{from}");
            RobotFile::parse("robot.toml", &text.replace(from, to)).unwrap_err().to_string()
        };
        assert!(refused("counts_per_turn = 2796.8", "").contains("has counts but no counts_per_turn"));
        assert!(refused("kind = \"odometry\"", "kind = \"car\"").contains("belong to kind"));
        assert!(refused("wheels = \"counts\"", "wheels = \"tacho\"").contains("counts, counter, angle or speed"));
        assert!(refused("time = ", "tim = ").contains("tim"));
        assert!(refused("time = ", "time_unit = \"min\"\ntime = ").contains("write s, ms, us or ns"));
        assert!(refused("yaw = \"yaw_rad\"\n", "").contains("names a part of the pose"));
        let neither = refused("x = \"x_m\"\ny = \"y_m\"\nyaw = \"yaw_rad\"\n", "");
        assert!(neither.contains("names neither a pose nor a gyro; give x, y and yaw, or gyro"), "{neither}");
        assert!(refused("time = ", "steering = \"a\"\ntime = ").contains("no wheel is steered; write steered = true"));
        assert!(
            refused(
                "[known]",
                "[[wheel]]\nname = \"back\"\nplace = [-0.1, 0.0]\nradius = 0.02\ncaster = true\n\
             column = \"c\"\n[known]"
            )
            .contains("wheel 'back' is a caster and yet has a column")
        );
        assert!(refused("radius_sigma = ", "radius_sigma = -").contains("it has to be above 0: give one sigma"));
        assert!(refused("track_sigma = ", "track_sigma = -").contains("track_sigma is -"));
        assert!(RobotFile::is_one("kind = 'odometry'") && !RobotFile::is_one("kind = 'car'"));
        assert!(refused("name = \"right\"", "name = \"left\"").contains("wheel 'left': two wheels have this name"));
        let (_, tricycle) = BUILT_IN[1];
        let unsteered = tricycle.replace("steering = \"steer_rad\"\n", "");
        let refusal = RobotFile::parse("robot.toml", &unsteered).unwrap_err().to_string();
        assert!(refusal.contains("wheel 'front' is steered, but [columns] has no steering"), "{refusal}");
    }

    #[test]
    fn a_caster_is_left_out_of_the_wheels() {
        let (_, text) = BUILT_IN[0];
        let caster = "[[wheel]]\nname = \"back\"\nplace = [-0.1, 0.0]\nradius = 0.02\ncaster = true\n[known]";
        let with = RobotFile::parse("robot.toml", &text.replace("[known]", caster)).expect("a robot");
        assert_eq!(with.robot, RobotFile::parse("robot.toml", text).expect("a robot").robot);
    }
}
