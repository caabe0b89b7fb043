//! Small bags of robots, made in the test.

use std::collections::BTreeMap;

use mcap::WriteOptions;
use mcap::records::MessageHeader;

/// A topic and its message at a time in s.
pub struct Topic {
    name: String,
    message_type: &'static str,
    /// Encoding of messages, encoding of the schema, schema.
    form: (&'static str, &'static str, &'static str),
    message: Box<dyn Fn(f64) -> Vec<u8>>,
}

fn json(name: &str, message_type: &'static str, message: impl Fn(f64) -> String + 'static) -> Topic {
    let message = Box::new(move |t| message(t).into_bytes());
    Topic { name: name.to_owned(), message_type, form: ("json", "jsonschema", "{}"), message }
}

/// A topic of CDR messages with their definition.
pub fn cdr(
    name: &str,
    message_type: &'static str,
    definition: &'static str,
    message: impl Fn(f64) -> Vec<u8> + 'static,
) -> Topic {
    Topic { name: name.to_owned(), message_type, form: ("cdr", "ros2msg", definition), message: Box::new(message) }
}

/// Joints with angles, speeds and efforts.
pub fn joint_states(name: &str, joints: &[&str]) -> Topic {
    let names = joints.iter().map(|joint| format!("\"{joint}\"")).collect::<Vec<_>>().join(",");
    let count = joints.len();
    let message = move |t: f64| {
        let list = |value: f64| vec![format!("{value:.4}"); count].join(",");
        let (angle, speed) = (3.0 * t, 3.0 + (2.0 * t).sin());
        format!(
            r#"{{"header":{},"name":[{names}],"position":[{}],"velocity":[{}],"effort":[{}]}}"#,
            header(t),
            list(angle),
            list(speed),
            list(0.2 * speed)
        )
    };
    json(name, "sensor_msgs/msg/JointState", message)
}

/// An inertial unit.
pub fn imu(name: &str) -> Topic {
    let message = |t: f64| {
        let vector = |z: f64| format!(r#"{{"x":{:.4},"y":0.01,"z":{z:.4}}}"#, 0.1 * t.cos());
        let header = header(t);
        let (rate, force) = (vector(0.3 * t.sin()), vector(9.81));
        format!(r#"{{"header":{header},"angular_velocity":{rate},"linear_acceleration":{force}}}"#)
    };
    json(name, "sensor_msgs/msg/Imu", message)
}

/// Speeds wanted of the body.
pub fn cmd_vel(name: &str) -> Topic {
    let message = |t: f64| format!(r#"{{"header":{},"twist":{{"linear":{{"x":0.5}}}}}}"#, header(t));
    json(name, "geometry_msgs/msg/TwistStamped", message)
}

fn header(t: f64) -> String {
    let ns = (t * 1e9).round() as u64;
    format!(r#"{{"stamp":{{"sec":{},"nanosec":{}}}}}"#, ns / 1_000_000_000, ns % 1_000_000_000)
}

/// Four seconds of all topics at 50 Hz, as MCAP.
pub fn bag(topics: &[Topic]) -> Vec<u8> {
    bag_with_filler(topics, ("/filler", "std_msgs/msg/Empty", ""), &[], &[])
}

/// Four seconds of some topics at 50 Hz, then a filler (topic, type, definition) and its messages, then other topics.
pub fn bag_with_filler(
    before: &[Topic],
    (name, message_type, definition): (&str, &'static str, &'static str),
    filler: &[Vec<u8>],
    after: &[Topic],
) -> Vec<u8> {
    let mut out = std::io::Cursor::new(Vec::new());
    let mut writer = WriteOptions::new().profile("ros2").create(&mut out).unwrap();
    let mut stretch = |topics: &[Topic], rows: u32, start: f64| {
        let channel = |topic: &Topic, writer: &mut mcap::Writer<_>| {
            let (encoding, written_as, schema) = topic.form;
            let schema = writer.add_schema(topic.message_type, written_as, schema.as_bytes()).unwrap();
            writer.add_channel(schema, &topic.name, encoding, &BTreeMap::new()).unwrap()
        };
        let ids: Vec<u16> = topics.iter().map(|topic| channel(topic, &mut writer)).collect();
        for k in 0..rows {
            let t = start + f64::from(k) * 0.02;
            for (topic, &channel_id) in topics.iter().zip(&ids) {
                let log_time = (t * 1e9).round() as u64;
                let header = MessageHeader { channel_id, sequence: k, log_time, publish_time: log_time };
                writer.write_to_known_channel(&header, &(topic.message)(t)).unwrap();
            }
        }
    };
    stretch(before, 200, 100.0);
    if !filler.is_empty() {
        let messages = filler.to_vec();
        let message = move |t: f64| messages[((t - 104.0) * 50.0).round() as usize].clone();
        stretch(&[cdr(name, message_type, definition, message)], filler.len() as u32, 104.0);
    }
    stretch(after, 200, 105.0);
    writer.finish().unwrap();
    drop(writer);
    out.into_inner()
}

/// A message of JSON: number of its topic, time of its stamp and of the log in s, text; `STAMP` stands for the header.
pub type Said = (usize, f64, String);

/// A bag of messages on topics (name, type), in the order of their times.
pub fn bag_of(topics: &[(&str, &str)], mut said: Vec<Said>) -> Vec<u8> {
    said.sort_by(|a, b| a.1.total_cmp(&b.1));
    let mut out = std::io::Cursor::new(Vec::new());
    let mut writer = WriteOptions::new().profile("ros2").create(&mut out).unwrap();
    let ids: Vec<u16> = topics
        .iter()
        .map(|(name, message_type)| {
            let schema = writer.add_schema(message_type, "jsonschema", b"{}").unwrap();
            writer.add_channel(schema, name, "json", &BTreeMap::new()).unwrap()
        })
        .collect();
    for (k, (topic, t, text)) in said.iter().enumerate() {
        let log_time = (t * 1e9).round() as u64;
        let header = MessageHeader { channel_id: ids[*topic], sequence: k as u32, log_time, publish_time: log_time };
        let text = text.replace("STAMP", &header_at(*t));
        writer.write_to_known_channel(&header, text.as_bytes()).unwrap();
    }
    writer.finish().unwrap();
    drop(writer);
    out.into_inner()
}

fn header_at(t: f64) -> String {
    format!(r#""header":{}"#, header(t))
}
