//! A mapping proposed from what a bag holds: by message types and joint names, every inference named.

use std::collections::BTreeSet;

use recordings::{Contents, Field, TopicContents};

/// A mapping file, and what was inferred on the way and should be looked at.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Proposal {
    /// The mapping as TOML, with the inferences as comments.
    pub toml: String,
    /// What was inferred, in sentences.
    pub inferred: Vec<String>,
}

const FIRST_LINE: &str =
    "Proposed by `lacuna check --write-mapping`. Look at each of these before you believe a diagnosis:";
/// Words in a joint's name that make it one that drives.
const DRIVES: [&str; 3] = ["wheel", "motor", "drive"];
/// Words in a topic's name that make its values set-points.
const COMMANDS: [&str; 4] = ["cmd", "command", "desired", "setpoint"];

/// The signals of one topic.
struct Entry<'a> {
    topic: &'a TopicContents,
    /// Signal, field, unit.
    signals: Vec<(String, String, &'static str)>,
}

/// What is being proposed.
#[derive(Default)]
struct Draft {
    taken: BTreeSet<String>,
    inferred: Vec<String>,
}

/// Proposes a mapping; `None` if no topic holds anything that the vocabulary has a word for.
pub fn mapping(name: &str, contents: &Contents) -> Option<Proposal> {
    let mut draft = Draft::default();
    let entries: Vec<Entry<'_>> =
        contents.topics.iter().filter_map(|topic| draft.entry(topic)).filter(|e| !e.signals.is_empty()).collect();
    if entries.is_empty() {
        return None;
    }
    let mut lines = vec![format!("# {FIRST_LINE}")];
    lines.extend(draft.inferred.iter().map(|sentence| format!("# - {sentence}")));
    lines.push(format!("name = {}", quoted(name)));
    for entry in &entries {
        let time = if stamped(entry.topic) { "header.stamp" } else { "log_time" };
        lines.push(format!("\n[[files]]\ntopic = {}", quoted(&entry.topic.name)));
        lines.push(format!("time = {{ column = \"{time}\"{} }}\n\n[files.signals]", rate(entry.topic)));
        let column = |(signal, field, unit): &(String, String, &str)| {
            format!("{signal} = {{ column = {}, unit = \"{unit}\" }}", quoted(field))
        };
        lines.extend(entry.signals.iter().map(column));
    }
    let toml = lines.join("\n") + "\n";
    Some(Proposal { toml, inferred: draft.inferred })
}

/// The nominal rate as the mapping writes it; nothing where the stamps do not say.
fn rate(topic: &TopicContents) -> String {
    let (from, to) = topic.log_time_ns;
    let seconds = (to - from) as f64 * 1e-9;
    if topic.count < 2 || seconds <= 0.0 {
        return String::new();
    }
    let rate = (topic.count - 1) as f64 / seconds;
    // Half a hertz is what a name-plate rate is rounded to.
    let rate = if rate > 5.0 { (2.0 * rate).round() / 2.0 } else { (100.0 * rate).round() / 100.0 };
    format!(", rate_hz = {rate}")
}

/// Whether a topic has header stamps, and its driver sets them.
fn stamped(topic: &TopicContents) -> bool {
    let unset = topic.stamps.as_ref().is_some_and(|stamps| stamps.set == 0);
    !unset && fields(topic).iter().any(|f| f.path == "header.stamp")
}

fn fields(topic: &TopicContents) -> &[Field] {
    topic.fields.as_deref().unwrap_or_default()
}

/// A TOML string.
fn quoted(text: &str) -> String {
    toml::Value::from(text).to_string()
}

impl Draft {
    fn entry<'a>(&mut self, topic: &'a TopicContents) -> Option<Entry<'a>> {
        let message = topic.message_type.rsplit('/').next()?;
        let signals = match message {
            "JointState" => self.joints(topic),
            "Imu" => self.plain(topic, &IMU),
            "PoseStamped" => {
                self.inferred.push(format!("{}: the heading is a quaternion, which is not mapped", topic.name));
                self.plain(topic, &POSE)
            }
            "Odometry" => {
                let reason = "odometry is mostly computed from the encoders, so that it is no witness of slip";
                self.inferred.push(format!("{}: left out; {reason}", topic.name));
                Vec::new()
            }
            _ => Vec::new(),
        };
        let has_header = fields(topic).iter().any(|f| f.path == "header.stamp");
        if has_header && !stamped(topic) && !signals.is_empty() {
            self.inferred.push(format!("{}: log times taken, header.stamp is 0 in every message", topic.name));
        }
        Some(Entry { topic, signals })
    }

    /// Fields whose meaning the message type fixes.
    fn plain(&mut self, topic: &TopicContents, known: &[Known]) -> Vec<(String, String, &'static str)> {
        let there = |path: &str| fields(topic).iter().any(|f| f.path == path);
        let found: Vec<_> = known.iter().filter(|k| there(k.1) && self.taken.insert(k.0.to_owned())).collect();
        if !found.is_empty() {
            self.inferred.push(format!("{}: axes as in REP 103, x forward, y left, z up", topic.name));
        }
        found.into_iter().map(|(signal, path, unit)| ((*signal).to_owned(), (*path).to_owned(), *unit)).collect()
    }

    /// The driven joints of each side.
    fn joints(&mut self, topic: &TopicContents) -> Vec<(String, String, &'static str)> {
        let lower = topic.name.to_lowercase();
        let command = COMMANDS.iter().any(|word| lower.contains(word));
        let current = lower.contains("current");
        let mut out = Vec::new();
        for (list, signal, unit) in [
            ("position", "wheel_angle", "rad"),
            ("velocity", if command { "command_speed" } else { "wheel_speed" }, "rad/s"),
            if current { ("effort", "current", "A") } else { ("effort", "torque", "N m") },
        ] {
            let Some(field) = fields(topic).iter().find(|f| f.path == list) else { continue };
            let before = out.len();
            for side in ["left", "right"] {
                let Some(joint) = self.joint(topic, field, side) else { continue };
                let signal = format!("{signal}_{side}");
                if self.taken.insert(signal.clone()) {
                    out.push((signal, format!("{list}[{joint}]"), unit));
                }
            }
            let what = match out[before..]
                .last()
                .map(|(signal, ..)| signal.trim_end_matches("_right").trim_end_matches("_left"))
            {
                Some("torque") => {
                    "effort taken for torques of a side in N m; where the driver gives currents, make it current_left and \
                     current_right in A"
                }
                Some("current") => {
                    "effort taken for currents in A, as the topic's name says; where they have no sign, add \
                     magnitude_only = true"
                }
                Some("wheel_speed") => {
                    "speeds taken for measured ones; where the driver repeats its set-points, make them command_speed_left \
                     and command_speed_right"
                }
                _ => continue,
            };
            self.inferred.push(format!("{}: {what}", topic.name));
        }
        out
    }

    /// The joint that stands for a side; the first of several.
    fn joint(&mut self, topic: &TopicContents, field: &Field, side: &str) -> Option<String> {
        let of_side = |name: &&String| {
            let name = name.to_lowercase();
            name.contains(side) && DRIVES.iter().any(|word| name.contains(word))
        };
        let all: Vec<&String> = field.names.iter().filter(of_side).collect();
        let first = *all.first()?;
        if all.len() > 1 {
            let names: Vec<&str> = all.iter().map(|n| n.as_str()).collect();
            let sentence = format!("{}: of {} the first stands for the {side} side", topic.name, names.join(", "));
            if !self.inferred.contains(&sentence) {
                self.inferred.push(sentence);
            }
        }
        Some(first.clone())
    }
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

#[cfg(test)]
mod tests {
    use recordings::{Contents, Field, Mapping, TopicContents};

    use super::mapping;

    fn topic(name: &str, message: &str, fields: &[(&str, &[&str])]) -> TopicContents {
        let field = |(path, names): &(&str, &[&str])| Field {
            path: (*path).to_owned(),
            lengths: (!names.is_empty()).then_some((names.len(), names.len())),
            names: names.iter().map(|n| (*n).to_owned()).collect(),
        };
        TopicContents {
            name: name.to_owned(),
            message_type: message.to_owned(),
            encoding: "cdr".to_owned(),
            count: 501,
            undecodable: 0,
            log_time_ns: (0, 10_000_000_000),
            stamps: None,
            fields: Ok(fields.iter().map(field).collect()),
        }
    }

    fn contents(topics: Vec<TopicContents>) -> Contents {
        Contents { topics, losses: Vec::new(), unchecked: 0, bytes: 0, sha256: String::new() }
    }

    #[test]
    fn four_wheels_a_gyro_and_odometry_become_a_mapping_that_parses() {
        let joints: &[&str] = &["front_left_wheel", "front_right_wheel", "rear_left_wheel", "rear_right_wheel", "arm"];
        let bag = contents(vec![
            topic(
                "/joint_states",
                "sensor_msgs/msg/JointState",
                &[("header.stamp", &[]), ("velocity", joints), ("effort", joints)],
            ),
            topic("/imu/data", "sensor_msgs/msg/Imu", &[("angular_velocity.z", &[]), ("linear_acceleration.x", &[])]),
            topic("/odom", "nav_msgs/msg/Odometry", &[("pose.pose.position.x", &[])]),
        ]);
        let proposal = mapping("mine", &bag).expect("something is known");
        let parsed = Mapping::parse("mine.toml", &proposal.toml).unwrap_or_else(|e| panic!("{e}\n{}", proposal.toml));
        assert_eq!(parsed.files.len(), 2);
        let speeds = &parsed.files[0];
        assert_eq!((speeds.topic.as_deref(), speeds.columns.len()), (Some("/joint_states"), 4));
        assert_eq!(speeds.time.rate_hz, Some(50.0));
        assert_eq!(parsed.files[1].columns.len(), 2);
        let told: std::collections::BTreeSet<&String> = proposal.inferred.iter().collect();
        assert_eq!(told.len(), proposal.inferred.len(), "said twice: {:?}", proposal.inferred);
        for part in
            ["of front_left_wheel, rear_left_wheel the first", "effort taken for torques", "/odom: left out", "REP 103"]
        {
            assert!(proposal.inferred.iter().any(|s| s.contains(part)), "{part}: {:?}", proposal.inferred);
            assert!(proposal.toml.contains(part), "{part}: {}", proposal.toml);
        }
    }

    #[test]
    fn commands_are_set_points_and_no_signal_is_taken_twice() {
        let sides: &[&str] = &["left_wheel", "right_wheel"];
        let bag = contents(vec![
            topic("/joint_states", "sensor_msgs/msg/JointState", &[("velocity", sides)]),
            topic("/cmd_joints", "sensor_msgs/msg/JointState", &[("velocity", sides)]),
            topic("/joint_states_2", "sensor_msgs/msg/JointState", &[("velocity", sides)]),
        ]);
        let text = mapping("m", &bag).expect("something is known").toml;
        assert!(text.contains("command_speed_left") && !text.contains("/joint_states_2"), "{text}");
        assert_eq!(text.matches("wheel_speed_left").count(), 1);
    }

    #[test]
    fn of_what_has_no_word_nothing_is_proposed() {
        let bag = contents(vec![topic("/camera", "sensor_msgs/msg/Image", &[("height", &[])])]);
        assert_eq!(mapping("m", &bag), None);
    }
}
