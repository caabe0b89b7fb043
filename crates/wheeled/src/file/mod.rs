//! Robots of any wheels as files, and drives as tables or messages: text in, a robot and its drives out.

mod rows;
mod table;

use crate::robot::AnyWheels;
use hierarchical_fit::CaseError as WheeledError;
pub use hierarchical_fit::{Column, Table};

/// Robots that are there by name.
pub const BUILT_IN: &[(&str, &str)] = &[
    ("torque-tricycle", include_str!("../../robots/torque-tricycle.toml")),
    ("torque-car", include_str!("../../robots/torque-car.toml")),
    ("torque-omni-3", include_str!("../../robots/torque-omni-3.toml")),
    ("torque-mecanum-4", include_str!("../../robots/torque-mecanum-4.toml")),
    ("torque-six-wheel", include_str!("../../robots/torque-six-wheel.toml")),
];

/// A robot with the columns in which its drives are recorded.
#[derive(Debug, Clone, PartialEq)]
pub struct RobotFile {
    /// The robot.
    pub robot: AnyWheels,
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
    pub(crate) second: f64,
    /// Columns of the motors' torques, with N m per unit of each.
    pub torque: Vec<(String, f64)>,
    /// Columns of the angles of joints, with rad per unit of each.
    pub joints: Vec<(String, f64)>,
    /// Columns of the measured wheels.
    pub wheels: Vec<String>,
    pub(crate) is_speed: bool,
    /// rad/s, or rad, per unit of the wheels' columns.
    pub(crate) turning: f64,
    /// Radians per unit of yaw.
    pub(crate) angle: f64,
    /// rad/s per unit of the yaw rate.
    pub(crate) rate: f64,
    /// Column of the yaw rate, rad/s.
    pub gyro: Option<String>,
    /// Columns of x, y and yaw.
    pub pose: Option<[String; 3]>,
}

impl RobotFile {
    /// Whether a robot file is one of this kind.
    pub fn is_one(text: &str) -> bool {
        odometry::file::is_of_kind(text, "wheeled")
    }

    /// Reads a robot file.
    ///
    /// # Errors
    /// Syntax, unknown keys, parts that are named and not there, and numbers that no robot can have, with what to do.
    pub fn parse(file: &str, text: &str) -> Result<Self, WheeledError> {
        let wrong = |what: String| WheeledError::Robot { robot: file.to_owned(), what };
        let read: rows::File = toml::from_str(text).map_err(|e| wrong(e.message().to_owned()))?;
        if read.kind != "wheeled" {
            return Err(wrong(format!(
                "kind = \"{}\"; wheels, motors and joints belong to kind = \"wheeled\"",
                read.kind
            )));
        }
        let Some(names) = &read.columns else {
            return Err(wrong("no [columns]; say at least which column holds the time".to_owned()));
        };
        let columns = rows::columns(&read, names).map_err(wrong)?;
        let robot = rows::robot(&read).map_err(wrong)?;
        robot.plant.checked().map_err(|e| wrong(e.to_string()))?;
        Ok(Self { robot, description: read.description, columns })
    }

    /// All columns but that of the time.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        let names = &self.columns;
        let inputs = names.torque.iter().chain(&names.joints).map(|(c, _)| c);
        inputs.chain(&names.wheels).chain(&names.gyro).chain(names.pose.iter().flatten()).map(String::as_str)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn built_in_robots_stand_and_name_columns() {
        for (name, text) in BUILT_IN {
            let file = RobotFile::parse(name, text).unwrap_or_else(|e| panic!("{name}: {e}"));
            assert!(RobotFile::is_one(text) && file.names().count() > file.robot.motors.len(), "{name}");
        }
    }

    #[test]
    fn what_is_wrong_with_a_file_is_one_clear_sentence() {
        let (_, text) = BUILT_IN[0];
        let refused = |from: &str, to: &str| {
            assert!(text.contains(from), "{from}");
            RobotFile::parse("robot.toml", &text.replace(from, to)).unwrap_err().to_string()
        };
        assert!(refused("kind = \"wheeled\"", "kind = \"car\"").contains("belong to kind = \"wheeled\""));
        assert!(
            refused("motor = \"front\"", "motor = \"rear\"")
                .contains("names the motor 'rear', which is not there; it has front")
        );
        assert!(refused("steered_by = \"front\"", "steered_by = \"x\"").contains("names the joint 'x'"));
        assert!(
            refused("name = \"rear left\"", "name = \"front\"").contains("wheel 'front': two wheels have this name")
        );
        assert!(refused("place = [0.8, 0.0]\nradius", "place = [0.0, 0.0]\nradius").contains("stand on one line"));
        assert!(
            refused("radius = 0.11", "radius = -0.11").contains("radius of a wheel is -0.11, but it must be larger")
        );
        assert!(
            refused("coulomb_sigma = 0.15", "coulomb_sigma = 0").contains("coulomb_sigma is 0; it has to be above 0")
        );
        assert!(refused("wheels = \"speed\"", "wheels = \"rpm\"").contains("write speed or angle"));
        assert!(
            refused("column = \"steer_rad\"", "column = \"steer_rad\"\nangle_per_unit = 0")
                .contains("joint 'front': angle_per_unit is 0; give what one unit")
        );
        assert!(
            refused("[columns]", "[ground]\nslope_deg = [0, 60]\n[columns]")
                .contains("slope_deg holds 60; give how far")
        );
        assert!(refused("yaw = \"yaw_rad\"\n", "").contains("names a part of the pose"));
        assert!(refused("mass = {", "mas = {").contains("mas"));
        let more =
            |k: usize| format!("\n[[wheel]]\nname = \"w{k}\"\nplace = [0.1, 0.1]\nradius = 0.1\ninertia = 0.01\n");
        let nine: String = (0..7).map(more).collect();
        assert!(refused("\n[[motor]]", &format!("{nine}\n[[motor]]")).contains("10 wheels, but a robot has 8 at most"));
        assert!(refused("motor = \"front\"\n", "").contains("motor 'front' turns no wheel"));
        assert!(
            refused("place = [0.8, 0.0]\ncolumn", "place = [0.0, 0.0]\ncolumn")
                .contains("unsteered_axle_x is that of the joint itself")
        );
    }
}
