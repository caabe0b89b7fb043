//! What each topic gives, by the type of its messages.

use std::collections::BTreeMap;

use recordings::{Field, TopicContents};

use super::joints;

/// Words in a topic's name that make its values set-points.
const COMMANDS: [&str; 4] = ["cmd", "command", "desired", "setpoint"];
/// Words in a topic's name that make a pose one that is wanted, not one that was measured.
const GOALS: [&str; 6] = ["goal", "target", "initial", "cmd", "desired", "setpoint"];

/// A signal of a topic as the mapping writes it.
pub(super) struct Line {
    pub(super) signal: String,
    pub(super) field: String,
    pub(super) unit: &'static str,
    /// A recording without it is as good.
    pub(super) optional: bool,
}

/// What is being proposed.
#[derive(Default)]
pub(super) struct Draft {
    /// Signals and the topics that give them.
    taken: BTreeMap<String, String>,
    /// Topics that repeat what others give: topic, the other one, signals.
    repeated: Vec<(String, String, Vec<String>)>,
    inferred: Vec<String>,
}

/// Signal, field, unit.
type Known = (&'static str, &'static str, &'static str);

const IMU: [Known; 6] = [
    ("gyro_x", "angular_velocity.x", "rad/s"),
    ("gyro_y", "angular_velocity.y", "rad/s"),
    ("gyro_z", "angular_velocity.z", "rad/s"),
    ("accel_x", "linear_acceleration.x", "m/s^2"),
    ("accel_y", "linear_acceleration.y", "m/s^2"),
    ("accel_z", "linear_acceleration.z", "m/s^2"),
];

const POSE: [Known; 2] = [("pose_x", "pose.position.x", "m"), ("pose_y", "pose.position.y", "m")];

/// Feedback of Clearpath's drives; the message itself does not say which of them is which.
const DRIVES: [Known; 2] = [("current_left", "drivers[0].current", "A"), ("current_right", "drivers[1].current", "A")];

pub(super) fn fields(topic: &TopicContents) -> &[Field] {
    topic.fields.as_deref().unwrap_or_default()
}

/// The name of the message type without its package.
pub(super) fn message(topic: &TopicContents) -> &str {
    topic.message_type.rsplit('/').next().unwrap_or_default()
}

pub(super) fn says(topic: &TopicContents, words: &[&str]) -> bool {
    let name = topic.name.to_lowercase();
    words.iter().any(|word| name.contains(word))
}

/// Whether a topic's name makes its values wanted, not measured.
pub(super) fn is_wanted(topic: &TopicContents) -> bool {
    says(topic, &COMMANDS) || says(topic, &GOALS)
}

/// Topics of low rank come first: joints before what repeats them, filtered sensors before raw ones.
pub(super) fn rank(topic: &TopicContents) -> u8 {
    match message(topic) {
        "JointState" => u8::from(says(topic, &COMMANDS)),
        "Imu" if says(topic, &["raw"]) => 3,
        _ => 2,
    }
}

impl Draft {
    /// All inferences, in sentences.
    pub(super) fn inferred(self) -> Vec<String> {
        let repeated = self
            .repeated
            .into_iter()
            .map(|(topic, other, signals)| format!("{topic}: {} left out; taken from {other}", signals.join(", ")));
        self.inferred.into_iter().chain(repeated).collect()
    }

    fn infer(&mut self, topic: &TopicContents, what: &str) {
        let sentence = format!("{}: {what}", topic.name);
        if !self.inferred.contains(&sentence) {
            self.inferred.push(sentence);
        }
    }

    /// The signals of a topic.
    pub(super) fn lines(&mut self, topic: &TopicContents) -> Vec<Line> {
        match message(topic) {
            "JointState" => self.joints(topic),
            "Imu" => self.plain(topic, &IMU, "axes as in REP 103, x forward, y left, z up"),
            "PoseStamped" if says(topic, &GOALS) => {
                self.left_out(topic, "by its name a pose that is wanted, not one that was measured")
            }
            "PoseStamped" => {
                self.plain(topic, &POSE, "x and y as they stand; the heading is a quaternion, which is not mapped")
            }
            "Odometry" => {
                self.left_out(topic, "odometry is mostly computed from the encoders, so that it does not show slip")
            }
            "Twist" | "TwistStamped" => {
                self.left_out(topic, "a speed wanted of the body; the drive decides what the wheels are commanded")
            }
            "Feedback" if topic.message_type.starts_with("clearpath") || topic.message_type.starts_with("jackal") => {
                let what = "drivers[0] taken for the left side and drivers[1] for the right, as Clearpath counts them; \
                            where the currents have no sign, add magnitude_only = true";
                self.plain(topic, &DRIVES, what)
            }
            "MultiFeedback" | "LynxMultiFeedback" | "PumaMultiFeedback" => {
                self.left_out(topic, "which item is which wheel stands in text beside; map currents by --fields")
            }
            _ => Vec::new(),
        }
    }

    fn left_out(&mut self, topic: &TopicContents, why: &str) -> Vec<Line> {
        self.infer(topic, &format!("left out; {why}"));
        Vec::new()
    }

    /// Takes a signal that no topic has given yet; what has, is reported.
    fn take(&mut self, topic: &TopicContents, signal: &str) -> bool {
        if let Some(other) = self.taken.get(signal) {
            let known = self.repeated.iter_mut().find(|(name, from, _)| *name == topic.name && from == other);
            match known {
                Some((.., signals)) => signals.push(signal.to_owned()),
                None => self.repeated.push((topic.name.clone(), other.clone(), vec![signal.to_owned()])),
            }
            return false;
        }
        self.taken.insert(signal.to_owned(), topic.name.clone());
        true
    }

    /// Fields whose meaning the message type fixes.
    fn plain(&mut self, topic: &TopicContents, known: &[Known], what: &str) -> Vec<Line> {
        let mut lines = Vec::new();
        for &(signal, field, unit) in known {
            if holds(topic, field) && self.take(topic, signal) {
                lines.push(Line { signal: signal.to_owned(), field: field.to_owned(), unit, optional: false });
            }
        }
        if !lines.is_empty() {
            self.infer(topic, what);
        }
        lines
    }

    /// The driven joints of each side.
    fn joints(&mut self, topic: &TopicContents) -> Vec<Line> {
        let (command, current) = (says(topic, &COMMANDS), says(topic, &["current"]));
        let mut out = Vec::new();
        for (list, quantity, unit) in [
            ("position", if command { "command_angle" } else { "wheel_angle" }, "rad"),
            ("velocity", if command { "command_speed" } else { "wheel_speed" }, "rad/s"),
            if current { ("effort", "current", "A") } else { ("effort", "torque", "N m") },
        ] {
            let Some(field) = fields(topic).iter().find(|f| f.path == list && !f.names.is_empty()) else { continue };
            let sides = joints::sides(&field.names);
            for remark in sides.remarks() {
                self.infer(topic, &remark);
            }
            // The vocabulary has no word for angles that are set.
            if quantity == "command_angle" {
                continue;
            }
            let before = out.len();
            for (side, joints) in [("left", &sides.left), ("right", &sides.right)] {
                let Some(joint) = joints.first() else { continue };
                let signal = format!("{quantity}_{side}");
                if self.take(topic, &signal) {
                    // ROS leaves efforts that nobody measures empty, or fills them with NaN.
                    let optional = list == "effort";
                    out.push(Line { signal, field: format!("{list}[{joint}]"), unit, optional });
                }
            }
            if out.len() > before {
                for what in meaning(quantity, sides.clearpath) {
                    self.infer(topic, what);
                }
            }
        }
        out
    }
}

/// What is taken for granted of a quantity.
fn meaning(quantity: &str, clearpath: bool) -> &'static [&'static str] {
    const TORQUE: &str = "effort taken for torques of a side in N m; where the driver gives currents, make it current_left \
                          and current_right in A";
    const CLEARPATH: &str = "joints of these names are those of Clearpath's Jackal, Husky and Warthog, whose efforts are no \
                             torques for sure: drivers leave them 0 or give currents";
    match quantity {
        "torque" if clearpath => &[TORQUE, CLEARPATH],
        "torque" => &[TORQUE],
        "current" => &[
            "effort taken for currents in A, as the topic's name says; where they have no sign, add magnitude_only = true",
        ],
        "wheel_speed" => &[
            "speeds taken for measured ones; where the driver repeats its set-points, make them command_speed_left and \
             command_speed_right",
        ],
        "command_speed" => &["speeds taken for set-points, as the topic's name says"],
        _ => &[],
    }
}

/// Whether messages of a topic have this field, or this item of a list.
pub(crate) fn holds(topic: &TopicContents, column: &str) -> bool {
    let find = |path: &str| fields(topic).iter().find(|field| field.path == path);
    let Some((before, (item, after))) =
        column.split_once('[').and_then(|(before, rest)| Some((before, rest.split_once(']')?)))
    else {
        return find(column).is_some();
    };
    let path = if after.is_empty() { before.to_owned() } else { format!("{before}[]{after}") };
    find(&path).is_some_and(|field| match item.parse::<usize>() {
        Ok(index) => field.lengths.is_some_and(|(_, most)| index < most),
        Err(_) => field.names.iter().any(|name| name == item),
    })
}
