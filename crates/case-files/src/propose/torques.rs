//! Columns of robots of any wheels under torque: which field is which motor, which steering joint and which wheel.

use anyhow::{Result, bail};
use recordings::TopicContents;
use toml_edit::{Item, TableLike};

use super::columns::{Draft, column, has, items};
use super::draft::{is_wanted, says};
use super::joints;
use crate::edit::{set, tables};

/// Words in a topic's name that make its numbers torques or currents.
const TORQUES: [&str; 3] = ["torque", "effort", "current"];
/// What the name of a joint that steers holds.
const STEERING: &str = "steer";
/// What columns begin with in files that `lacuna robot` made.
const BEFORE_JOINTS: [&str; 3] = ["torque_", "speed_", "angle_"];

/// A part of the robot with the words that may be its joint's: its name, its column, and those of what it turns.
struct Part {
    name: String,
    words: Vec<String>,
}

impl Part {
    /// The name of the list that means this part.
    fn among<'b>(&self, list: &'b [String]) -> Option<&'b str> {
        let exact = self.words.iter().find_map(|word| list.iter().find(|name| *name == word).map(String::as_str));
        exact.or_else(|| self.words.iter().find_map(|word| joints::same_wheel(word, list)))
    }
}

/// The joint's name in a column: without what `lacuna robot` writes before it, or of a field such as `/topic.effort[joint]`.
fn bare(column: &str) -> String {
    let inside = column.split_once('[').and_then(|(_, rest)| rest.split_once(']')).map(|(name, _)| name);
    let name = inside.unwrap_or(column);
    BEFORE_JOINTS.iter().find_map(|before| name.strip_prefix(before)).unwrap_or(name).to_owned()
}

fn steers(joint: &str) -> bool {
    joint.to_lowercase().contains(STEERING)
}

/// What else the name of a steering joint says.
fn without_steering(joint: &str) -> String {
    let name = joint.to_lowercase();
    ["steering", "steer"].iter().fold(name, |name, word| name.replace(word, ""))
}

impl<'a> Draft<'a> {
    /// Torques of motors, angles of joints and turning of wheels.
    pub(super) fn torques(&mut self) -> Result<()> {
        let [motors, joints, wheels] = ["motor", "joint", "wheel"].map(|list| self.parts(list));
        let mut lacking = Vec::new();
        for (k, motor) in motors.iter().enumerate() {
            if !self.torque(k, motor, motors.len() == 1) {
                lacking.push(format!("the torque or current of motor {}", motor.name));
            }
        }
        for (k, joint) in joints.iter().enumerate() {
            if !self.angle(k, joint, joints.len() == 1) {
                lacking.push(format!("the angle of joint {}", joint.name));
            }
        }
        if !lacking.is_empty() {
            let names = |list: &str| {
                let all: Vec<&str> =
                    self.joint_states().iter().flat_map(|topic| items(topic, list)).map(String::as_str).collect();
                if all.is_empty() { "none".to_owned() } else { all.join(", ") }
            };
            bail!(
                "not found in the bag: {}. Joints with an effort are: {}; with a position: {}. Call motors and joints of the robot \
                 file like these, or name the fields under column (lacuna check --fields lists them)",
                lacking.join(", "),
                names("effort"),
                names("position")
            );
        }
        self.turning(&wheels);
        self.gyro();
        self.leave_out(&["angle_unit"]);
        Ok(())
    }

    /// Parts of a list of the robot file.
    fn parts(&mut self, list: &str) -> Vec<Part> {
        let text = |row: &dyn TableLike, key: &str| row.get(key).and_then(Item::as_str).map(str::to_owned);
        let mut turned: Vec<(String, String)> = Vec::new();
        for row in self.rows("wheel") {
            if let (Some(motor), Some(name)) = (text(row, "motor"), text(row, "name")) {
                turned.push((motor, name));
            }
        }
        let rows = self.rows(list).into_iter().map(|row| {
            let name = text(row, "name").unwrap_or_default();
            let column = text(row, "column").map(|column| bare(&column));
            (name, column)
        });
        rows.map(|(name, column)| {
            let wheels = turned.iter().filter(|(motor, _)| list == "motor" && *motor == name);
            let wheels: Vec<String> = wheels.map(|(_, wheel)| wheel.clone()).collect();
            let words = [Some(name.clone()), column].into_iter().flatten().chain(wheels).collect();
            Part { name, words }
        })
        .collect()
    }

    /// Rows of a list of the robot file.
    fn rows(&mut self, list: &str) -> Vec<&mut dyn TableLike> {
        self.file.get_mut(list).map(tables).unwrap_or_default()
    }

    /// Gives a row its column.
    fn set_column(&mut self, list: &str, k: usize, topic: &'a TopicContents, field: &str) {
        if let Some(row) = self.rows(list).into_iter().nth(k) {
            set(row, "column", column(topic, field));
        }
        self.used.push(topic);
    }

    fn torque(&mut self, k: usize, motor: &Part, is_only: bool) -> bool {
        let states = self.joint_states();
        let found = states.into_iter().find_map(|topic| Some((topic, motor.among(items(topic, "effort"))?)));
        if let Some((topic, joint)) = found {
            self.infer(
                topic,
                &format!(
                    "effort of {joint} taken for the torque of motor {} in N m; where it is a current, torque_per_unit is torque constant \
                     times gear, and where it is that of one of several wheels, their number",
                    motor.name
                ),
            );
            self.set_column("motor", k, topic, &format!("effort[{joint}]"));
            return true;
        }
        let is_one = |topic: &&TopicContents| says(topic, &TORQUES) && has(topic, "data") && !is_wanted(topic);
        let topics: Vec<&TopicContents> = self.topics.iter().copied().filter(is_one).collect();
        let names: Vec<String> = topics.iter().map(|topic| topic.name.clone()).collect();
        let named = motor.among(&names).and_then(|name| topics.iter().find(|topic| topic.name == name));
        let found = named.or_else(|| topics.first().filter(|_| is_only && topics.len() == 1));
        let Some(topic) = found.copied() else { return false };
        self.infer(
            topic,
            &format!(
                "taken for the torque of motor {} in N m; where it is a current, torque_per_unit is torque constant times gear",
                motor.name
            ),
        );
        self.set_column("motor", k, topic, "data");
        true
    }

    fn angle(&mut self, k: usize, joint: &Part, is_only: bool) -> bool {
        for topic in self.joint_states() {
            let list = items(topic, "position");
            let steering: Vec<&str> = list.iter().map(String::as_str).filter(|name| steers(name)).collect();
            let exact = joint.words.iter().find_map(|word| list.iter().find(|name| *name == word).map(String::as_str));
            let own = exact.or_else(|| {
                let places: Vec<String> = steering.iter().map(|name| without_steering(name)).collect();
                let found = joint.among(&places)?;
                places.iter().position(|place| place == found).map(|at| steering[at])
            });
            let Some(found) = own.or_else(|| steering.first().copied().filter(|_| is_only)) else { continue };
            let several = if own.is_none() && steering.len() > 1 {
                ", the first of several: a joint that steers two wheels stands in their middle and turns by another angle"
            } else {
                ""
            };
            self.infer(
                topic,
                &format!(
                    "position of {found} taken for the angle of joint {} in rad, left positive{several}; where it counts to the right, \
                     angle_per_unit = -1",
                    joint.name
                ),
            );
            self.set_column("joint", k, topic, &format!("position[{found}]"));
            return true;
        }
        let paths = ["drive.steering_angle", "steering_angle"];
        let found =
            self.topics.iter().find_map(|topic| Some((*topic, paths.into_iter().find(|path| has(topic, path))?)));
        let Some((topic, path)) = found.filter(|_| is_only) else { return false };
        self.infer(topic, "taken for the steering angle in rad, left positive; it is asked for and not measured");
        self.set_column("joint", k, topic, path);
        true
    }

    /// Speeds of wheels, or angles where the bag has no speeds; of a wheel that it does not have, none.
    fn turning(&mut self, wheels: &[Part]) {
        for topic in self.joint_states() {
            for (list, data) in [("velocity", "speed"), ("position", "angle")] {
                let found: Vec<Option<String>> =
                    wheels.iter().map(|wheel| wheel.among(items(topic, list)).map(str::to_owned)).collect();
                if found.iter().all(Option::is_none) {
                    continue;
                }
                let mut said = Vec::new();
                for (k, (wheel, joint)) in wheels.iter().zip(&found).enumerate() {
                    match joint {
                        Some(joint) => {
                            self.set_column("wheel", k, topic, &format!("{list}[{joint}]"));
                            said.push(format!("{joint} as wheel {}", wheel.name));
                        }
                        None => self.leave_out_column(k),
                    }
                }
                self.infer(topic, &format!("{list} of {}", said.join(", ")));
                set(self.columns(), "wheels", data);
                return;
            }
        }
        (0..wheels.len()).for_each(|k| self.leave_out_column(k));
        self.leave_out(&["wheels"]);
        self.inferred.push("no joint of a wheel is in the bag: the turning of wheels is not compared".to_owned());
    }

    fn leave_out_column(&mut self, k: usize) {
        if let Some(row) = self.rows("wheel").into_iter().nth(k) {
            row.remove("column");
        }
    }
}
