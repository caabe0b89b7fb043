//! Columns of a robot file proposed from what a bag holds: which field is which wheel, which steering and which pose.

use anyhow::{Context, Result, bail};
use recordings::{Contents, HEADER_STAMP, LOG_TIME, TopicContents};
use toml_edit::{DocumentMut, Item, TableLike};

use super::draft::{fields, is_wanted, message, says};
use super::{Proposal, joints, stamped};
use crate::columns::{Kind, robot_text};
use crate::edit::{document, one_line, set, tables};

/// Words in a topic's name that make its numbers counts of encoders.
const COUNTS: [&str; 3] = ["tick", "encoder", "count"];
/// Words that make an odometry one that is not computed from the wheels.
const MEASURED: [&str; 12] =
    ["truth", "vicon", "mocap", "optitrack", "qualisys", "vrpn", "gps", "visual", "vio", "lidar", "lio", "slam"];

/// What is proposed for a robot file.
pub(super) struct Draft<'a> {
    pub(super) topics: Vec<&'a TopicContents>,
    pub(super) file: DocumentMut,
    /// Topics that are used.
    pub(super) used: Vec<&'a TopicContents>,
    pub(super) inferred: Vec<String>,
}

/// The file of a robot that names its columns itself, with columns that are fields of this bag; what it says else stays.
///
/// # Errors
/// A robot of another kind, and a bag in which wheels, or the commands of a car, are not found.
pub fn columns(robot: &str, kind: Kind, contents: &Contents) -> Result<Proposal> {
    let text = robot_text(robot, kind)?.with_context(|| format!("robot '{robot}' is not of kind {}", kind.name()))?;
    let (file, topics) = (document(robot, &text)?, contents.topics.iter().collect());
    let mut draft = Draft { topics, file, used: Vec::new(), inferred: Vec::new() };
    match kind {
        Kind::Odometry => draft.wheels()?,
        Kind::Car => draft.car()?,
        Kind::Wheeled => draft.torques()?,
    }
    draft.pose(kind);
    draft.time();
    let mut lines = vec![format!("# {}", super::FIRST_LINE)];
    lines.extend(draft.inferred.iter().map(|sentence| format!("# - {}", one_line(sentence))));
    lines.push(draft.file.to_string());
    Ok(Proposal { toml: lines.join("\n"), inferred: draft.inferred })
}

/// A field of a topic as a robot file names it.
pub(super) fn column(topic: &TopicContents, field: &str) -> String {
    format!("{}.{field}", topic.name)
}

pub(super) fn has(topic: &TopicContents, path: &str) -> bool {
    fields(topic).iter().any(|field| field.path == path)
}

/// Names of the items of a list of a topic.
pub(super) fn items<'a>(topic: &'a TopicContents, list: &str) -> &'a [String] {
    fields(topic).iter().find(|field| field.path == list).map_or(&[], |field| &field.names)
}

impl<'a> Draft<'a> {
    pub(super) fn infer(&mut self, topic: &TopicContents, what: &str) {
        self.inferred.push(format!("{}: {what}", topic.name));
    }

    pub(super) fn columns(&mut self) -> &mut dyn TableLike {
        let item = self.file.entry("columns").or_insert_with(toml_edit::table);
        if !item.is_table_like() {
            *item = toml_edit::table();
        }
        item.as_table_like_mut().expect("made one above")
    }

    fn set(&mut self, key: &str, topic: &'a TopicContents, field: &str) {
        set(self.columns(), key, column(topic, field));
        self.used.push(topic);
    }

    /// Topics of measured joints, those that are set aside.
    pub(super) fn joint_states(&self) -> Vec<&'a TopicContents> {
        let is_one = |topic: &&TopicContents| message(topic) == "JointState" && !is_wanted(topic);
        self.topics.iter().copied().filter(is_one).collect()
    }

    /// Names and columns of the wheels that are measured.
    fn measured(&mut self) -> Vec<[String; 2]> {
        let mut wheels = self.file.get_mut("wheel").map(tables).unwrap_or_default();
        let text = |row: &dyn TableLike, key: &str| row.get(key).and_then(Item::as_str).map(str::to_owned);
        wheels.iter_mut().filter_map(|row| Some([text(*row, "name")?, text(*row, "column")?])).collect()
    }

    /// Gives the wheels that are measured these columns, in their order.
    fn set_wheels(&mut self, data: &str, topics: &[(&'a TopicContents, String)]) {
        let rows = self.file.get_mut("wheel").map(tables).unwrap_or_default();
        for (row, (topic, field)) in rows.into_iter().filter(|row| row.contains_key("column")).zip(topics) {
            set(row, "column", column(topic, field));
        }
        self.used.extend(topics.iter().map(|(topic, _)| *topic));
        set(self.columns(), "wheels", data);
        self.leave_out(&["angle_unit", "length_unit"]);
    }

    /// Takes out keys that mean something in a table only: units, which ROS fixes, and channels that the bag does not have.
    pub(super) fn leave_out(&mut self, keys: &[&str]) {
        for key in keys {
            self.columns().remove(key);
        }
    }

    fn wheels(&mut self) -> Result<()> {
        let wheels = self.measured();
        let names: Vec<&str> = wheels.iter().map(|[name, _]| name.as_str()).collect();
        let joint = |wheel: &[String; 2], list: &'a [String]| -> Option<&'a str> {
            let exact =
                |joint: &&String| wheel.iter().any(|name| name == *joint || name.ends_with(&format!("[{joint}]")));
            list.iter().find(exact).map(String::as_str).or_else(|| joints::same_wheel(&wheel[0], list))
        };
        for topic in self.joint_states() {
            for (list, data) in [("position", "angle"), ("velocity", "speed")] {
                let found: Vec<&str> = wheels.iter().filter_map(|wheel| joint(wheel, items(topic, list))).collect();
                if found.len() < wheels.len() || !all_differ(&found) {
                    continue;
                }
                let pairs: Vec<String> =
                    names.iter().zip(&found).map(|(wheel, joint)| format!("{joint} as wheel {wheel}")).collect();
                self.infer(topic, &format!("{list} of {}", pairs.join(", ")));
                let fields: Vec<_> = found.iter().map(|joint| (topic, format!("{list}[{joint}]"))).collect();
                self.set_wheels(data, &fields);
                self.steering(topic);
                return Ok(());
            }
        }
        if self.counts(&wheels) {
            return Ok(());
        }
        let joints: Vec<&String> = self.joint_states().into_iter().flat_map(|topic| items(topic, "position")).collect();
        bail!(
            "no joints or counts of the wheels {} are found in the bag; joints are: {}. Call the wheels of the robot file like their \
             joints, or name the fields under column (lacuna check --fields lists them)",
            names.join(", "),
            if joints.is_empty() {
                "none".to_owned()
            } else {
                joints.into_iter().cloned().collect::<Vec<_>>().join(", ")
            }
        )
    }

    /// Counts of encoders, a topic for each wheel.
    fn counts(&mut self, wheels: &[[String; 2]]) -> bool {
        let is_one =
            |topic: &&&TopicContents| says(topic, &COUNTS) && has(topic, "data") && !message(topic).contains("Array");
        let topics: Vec<&TopicContents> = self.topics.iter().filter(is_one).copied().collect();
        let names: Vec<String> = topics.iter().map(|topic| topic.name.clone()).collect();
        let of = |[name, _]: &[String; 2]| {
            let found = joints::same_wheel(name, &names)?;
            topics.iter().find(|topic| topic.name == found).copied()
        };
        let found: Vec<&TopicContents> = wheels.iter().filter_map(of).collect();
        let differ: Vec<&str> = found.iter().map(|topic| topic.name.as_str()).collect();
        if found.len() < wheels.len() || !all_differ(&differ) {
            return false;
        }
        for (topic, [name, _]) in found.iter().zip(wheels) {
            self.infer(
                topic,
                &format!("counts of wheel {name} since any instant, as its name says; they may wrap around"),
            );
        }
        let fields: Vec<_> = found.iter().map(|topic| (*topic, "data".to_owned())).collect();
        self.set_wheels("counter", &fields);
        self.joint_states().into_iter().for_each(|topic| self.steering(topic));
        true
    }

    /// The angle of a steering joint, where the robot has one.
    fn steering(&mut self, topic: &'a TopicContents) {
        if self.columns().get("steering").is_none() {
            return;
        }
        let joints: Vec<&String> =
            items(topic, "position").iter().filter(|joint| joint.to_lowercase().contains("steer")).collect();
        match joints.as_slice() {
            [] => self.infer(
                topic,
                "no joint is called steering; name the field of the steering angle under [columns] steering",
            ),
            [joint, others @ ..] => {
                let others = if others.is_empty() { "" } else { ", the first of several" };
                self.infer(topic, &format!("{joint} taken for the steering angle in rad, left positive{others}"));
                let field = format!("position[{joint}]");
                self.set("steering", topic, &field);
            }
        }
    }

    /// Where the robot is, measured by something else than its wheels.
    fn pose(&mut self, kind: Kind) {
        let ways = [
            ("PoseStamped", "pose.position", "pose.orientation"),
            ("TransformStamped", "transform.translation", "transform.rotation"),
            ("PoseWithCovarianceStamped", "pose.pose.position", "pose.pose.orientation"),
            ("Odometry", "pose.pose.position", "pose.pose.orientation"),
        ];
        for (pose, place, turn) in ways {
            let is_one = |topic: &&&TopicContents| {
                let is_measured = pose != "Odometry" || says(topic, &MEASURED);
                message(topic) == pose && is_measured && !is_wanted(topic) && has(topic, &format!("{place}.x"))
            };
            let found: Vec<&TopicContents> = self.topics.iter().filter(is_one).copied().collect();
            if let Some((topic, others)) = found.split_first() {
                self.infer(
                    topic,
                    "pose taken for the measured one of the robot, x and y in m, yaw from its quaternion",
                );
                for other in others {
                    self.infer(other, &format!("another pose, left out; {} is taken", topic.name));
                }
                self.set("x", topic, &format!("{place}.x"));
                self.set("y", topic, &format!("{place}.y"));
                self.set("yaw", topic, turn);
                if kind == Kind::Odometry {
                    self.leave_out(&["gyro"]);
                }
                return;
            }
        }
        let is_enough = match kind {
            Kind::Odometry => self.gyro(),
            Kind::Car => self.columns().contains_key("gyro") && self.columns().contains_key("encoder"),
            Kind::Wheeled => self.columns().contains_key("wheels"),
        };
        if is_enough {
            self.leave_out(&["x", "y", "yaw"]);
            let shown = match kind {
                Kind::Wheeled => "wheels, and a gyro if there is one, show how the robot moves, and not where it is",
                _ => "the gyro shows how the robot turns, and not how far it goes",
            };
            self.inferred.push(format!("no topic of a measured pose is in the bag: {shown}"));
            return;
        }
        let odometry: Vec<&str> =
            self.topics.iter().filter(|topic| message(topic) == "Odometry").map(|topic| topic.name.as_str()).collect();
        let beside = if odometry.is_empty() {
            String::new()
        } else {
            format!("; {} is mostly computed from the wheels and shows nothing beside them", odometry.join(", "))
        };
        self.inferred.push(format!(
            "no topic of a measured pose (PoseStamped, TransformStamped, PoseWithCovarianceStamped) is in the bag{beside}: name its \
             fields under [columns] x, y and yaw"
        ));
    }

    /// Commands and what a car reports.
    fn car(&mut self) -> Result<()> {
        let find = |draft: &Self, words: &[&str]| -> Option<&'a TopicContents> {
            draft.topics.iter().copied().find(|topic| says(topic, words) && has(topic, "data"))
        };
        let ackermann = self.topics.iter().copied().find_map(|topic| {
            let path = ["drive.steering_angle", "steering_angle"].into_iter().find(|path| has(topic, path))?;
            Some((topic, path))
        });
        match (find(self, &["servo", "steering"]), ackermann) {
            (Some(topic), _) => {
                self.infer(topic, "taken for the steering command from -1 (right) to 1 (left); where it is an angle, write steering_unit");
                self.set("steering", topic, "data");
            }
            (None, Some((topic, path))) => {
                self.infer(topic, "taken for the steering angle that is asked for, in rad, left positive");
                self.set("steering", topic, path);
                set(self.columns(), "steering_unit", "rad");
            }
            (None, None) => bail!(
                "no topic of a steering command (servo, steering, AckermannDrive) is in the bag; name it in the robot file"
            ),
        }
        match find(self, &["throttle", "duty"]) {
            Some(topic) => {
                self.infer(topic, "taken for the throttle from -1 to 1");
                self.set("throttle", topic, "data");
            }
            None => self.inferred.push(
                "no topic of a throttle (throttle, duty) is in the bag; name its field under [columns] throttle. A speed that is asked \
                 for is no throttle: a loop of the motor's controller lies between"
                    .to_owned(),
            ),
        }
        self.gyro();
        match find(self, &["speed", "wheel", "encoder"]).filter(|topic| !is_wanted(topic)) {
            Some(topic) => {
                self.infer(topic, "taken for the speed by the encoder in m/s");
                self.set("encoder", topic, "data");
            }
            None => self.leave_out(&["encoder"]),
        }
        self.leave_out(&["car_time", "enabled"]);
        Ok(())
    }

    /// The yaw rate by an inertial unit, if there is one.
    pub(super) fn gyro(&mut self) -> bool {
        let is_one = |topic: &&TopicContents| message(topic) == "Imu" && has(topic, "angular_velocity.z");
        let Some(topic) = self.topics.iter().copied().find(is_one) else {
            self.leave_out(&["gyro"]);
            return false;
        };
        self.infer(topic, "angular_velocity.z taken for the yaw rate in rad/s, z up");
        self.set("gyro", topic, "angular_velocity.z");
        true
    }

    /// One clock for all: stamps where every topic has them.
    fn time(&mut self) {
        self.leave_out(&["time_unit"]);
        let without: Vec<String> =
            self.used.iter().filter(|topic| !stamped(topic)).map(|topic| topic.name.clone()).collect();
        if without.is_empty() {
            set(self.columns(), "time", HEADER_STAMP);
            return;
        }
        set(self.columns(), "time", LOG_TIME);
        let mut names = without;
        names.sort();
        names.dedup();
        self.inferred
            .push(format!("log times taken for all topics, since {} has no stamps of its own", names.join(", ")));
    }
}

fn all_differ(names: &[&str]) -> bool {
    names.iter().enumerate().all(|(k, name)| !names[..k].contains(name))
}
