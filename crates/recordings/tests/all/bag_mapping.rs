//! Mappings of topics: clocks, parts, optional fields, stamps in disorder, and what is said when something is missing.

use std::io::Cursor;

use crate::common::{Bag, Kept, gyro, messages, wheel};
use recordings::{Input, LossKind, Mapping, Policy, Read, ReadOptions, RecordingError, Signal, contents, read};

const MAPPING: &str = r#"
[[files]]
topic = "/wheel"
time = { column = "stamp" }
[files.signals]
wheel_speed_left = { column = "speed", unit = "rev/s", sign = -1 }

[[files]]
topic = "/gyro"
time = { column = "log_time", rate_hz = 50 }
[files.signals]
gyro_z = { column = "angular_velocity.z", unit = "rad/s" }
"#;

fn run(mapping: &str, policy: Policy, files: &[(&str, &[u8])]) -> Result<Read, RecordingError> {
    let mapping = Mapping::parse("m.toml", mapping)?;
    let inputs: Vec<Input<'_>> = files.iter().map(|&(name, bytes)| Input { name, bytes }).collect();
    read(&mapping, "a", &inputs, &ReadOptions { policy })
}

fn bag(messages: &[Kept]) -> Vec<u8> {
    Bag::default().write(messages)
}

fn message(result: Result<Read, RecordingError>) -> String {
    result.unwrap_err().to_string()
}

#[test]
fn two_topics_on_two_clocks_with_units_and_signs() {
    let bytes = bag(&messages(20));
    let read = run(MAPPING, Policy::Strict, &[("walk.mcap", &bytes)]).unwrap();
    let speed = read.recording.require(Signal::WheelSpeedLeft).unwrap();
    assert_eq!((speed.len(), speed.t_ns()[1]), (10, 1_020_000_000));
    assert!((speed.values()[1] - 0.5 * std::f64::consts::TAU).abs() < 1e-12);
    let gyro = read.recording.require(Signal::GyroZ).unwrap();
    assert_eq!((gyro.t_ns()[0], gyro.values()[0]), (1_010_000_000, -0.75));
    let clocks: Vec<&str> = read.recording.clocks().iter().map(|clock| clock.name.as_str()).collect();
    assert_eq!(clocks, ["walk.mcap stamps", "walk.mcap log"]);
    assert_eq!((read.sources.len(), read.sources[0].bytes), (1, bytes.len()));
    let one = MAPPING.replace("topic =", "clock = \"robot\"\ntopic =");
    let read = run(&one, Policy::Strict, &[("walk.mcap", &bytes)]).unwrap();
    assert_eq!(read.recording.clocks()[0].name, "walk.mcap robot");
    assert_eq!(read.recording.clocks().len(), 1);
}

#[test]
fn parts_of_a_split_bag_are_one_run_and_a_missing_one_is_reported() {
    let all = messages(30);
    let [first, second, third] = [0, 10, 20].map(|start| bag(&all[start..start + 10]));
    let files = [("w/walk/walk_2.mcap", &*third), ("w/walk/walk_0.mcap", &*first), ("w/walk/walk_1.mcap", &*second)];
    let whole = run(MAPPING, Policy::Strict, &files).unwrap();
    let gyro = whole.recording.require(Signal::GyroZ).unwrap();
    assert_eq!((gyro.len(), whole.losses.len(), whole.sources.len()), (15, 0, 3));
    assert_eq!(whole.sources[0].name, "w/walk/walk_0.mcap");
    let torn = run(MAPPING, Policy::Normal, &files[..2]).unwrap();
    assert_eq!(torn.losses[0].kind, LossKind::MissingFile);
    assert!(torn.losses[0].file.contains("walk_1"), "{}", torn.losses[0]);
    assert!(message(run(MAPPING, Policy::Normal, &[files[0], files[0]])).contains("a second file"));
}

#[test]
fn a_damaged_bag_is_an_error_only_where_reading_is_strict() {
    let bytes = bag(&messages(20));
    let cut = &bytes[..bytes.len() / 2];
    let read = run(MAPPING, Policy::Normal, &[("walk.mcap", cut)]).unwrap();
    assert!(read.losses.iter().any(|loss| loss.kind == LossKind::CutOff), "{:?}", read.losses);
    assert!(!read.recording.require(Signal::GyroZ).unwrap().is_empty());
    let strict = message(run(MAPPING, Policy::Strict, &[("walk.mcap", cut)]));
    assert!(strict.contains("1 file without its end: it was cut off") && strict.contains("strict"), "{strict}");
}

#[test]
fn a_topic_that_was_not_recorded_is_a_loss_beside_others_that_were() {
    let bytes = bag(&messages(20));
    let files = [("walk.mcap", &*bytes)];
    let mapping = MAPPING.replace("\"/gyro\"", "\"/imu/data\"");
    let read = run(&mapping, Policy::Normal, &files).unwrap();
    assert_eq!(read.losses.len(), 1, "{:?}", read.losses);
    assert_eq!((read.losses[0].kind, read.losses[0].column.as_deref()), (LossKind::EmptyTopic, Some("/imu/data")));
    assert!(read.recording.get(Signal::GyroZ).is_none());
    assert!(message(run(&mapping, Policy::Strict, &files)).contains("no topic `/imu/data`"));
}

#[test]
fn missing_topics_fields_and_messages_are_named() {
    let bytes = bag(&messages(20));
    let files = [("walk.mcap", &*bytes)];
    assert_eq!(
        message(run(&MAPPING.replace("\"/gyro\"", "\"/gyros\""), Policy::Normal, &files)),
        "walk.mcap: no topic `/gyros` (needed by mapping m.toml); did you mean `/gyro`?"
    );
    assert_eq!(
        message(run(&MAPPING.replace("\"speed\"", "\"sped\""), Policy::Normal, &files)),
        "walk.mcap: `/wheel.sped`: test_msgs/Wheel has no field `sped`; did you mean `speed`?"
    );
    let optional = MAPPING.replace(", sign = -1", ", optional = true").replace("\"speed\"", "\"sped\"");
    assert!(message(run(&optional, Policy::Normal, &files)).contains("not one sample could be read"));
    let elsewhere = MAPPING.replace("topic = \"", "topic = \"/x").replace("unit =", "optional = true, unit =");
    assert!(message(run(&elsewhere, Policy::Normal, &files)).contains("none of the mapped topics is there"));
    assert!(message(run(MAPPING, Policy::Normal, &[("walk.mcap", b"hello")])).contains("stretch of damaged bytes"));
    let mut bad = messages(6);
    bad[2].2.truncate(15);
    bad[3].2 = b"{\"angular_velocity\": 3".to_vec();
    let bytes = bag(&bad);
    let read = run(MAPPING, Policy::Normal, &[("walk.mcap", &bytes)]).unwrap();
    let told: Vec<String> = read.losses.iter().map(ToString::to_string).collect();
    assert_eq!(told, ["walk.mcap: 1 message skipped: it does not decode, message 2"; 2]);
    assert_eq!(
        message(run(MAPPING, Policy::Strict, &[("walk.mcap", &bytes)])),
        "walk.mcap: message 2 of `/wheel` does not decode by its schema; read without strict mode to take what is left"
    );
}

#[test]
fn stamps_in_disorder_and_repeated_follow_the_policy() {
    let mut disorder = messages(10);
    disorder.swap(2, 4);
    disorder[8].2 = wheel(1_060_000_000, 9.0);
    let bytes = bag(&disorder);
    let files = [("walk.mcap", &*bytes)];
    let backwards = message(run(MAPPING, Policy::Strict, &files));
    assert!(backwards.starts_with("walk.mcap: message 3, column /wheel.stamp: time runs backwards"), "{backwards}");
    let read = run(MAPPING, Policy::Normal, &files).unwrap();
    let kinds: Vec<_> = read.losses.iter().map(|loss| (loss.kind, loss.lines.clone())).collect();
    assert_eq!(kinds, [(LossKind::OutOfOrder, vec![3]), (LossKind::DuplicateStamp, vec![5])]);
    assert_eq!(read.recording.require(Signal::WheelSpeedLeft).unwrap().len(), 4);
}

#[test]
fn numbers_that_are_not_finite() {
    let with = |speed: f64| {
        let mut all = messages(6);
        all[2].2 = wheel(1_020_000_000, speed);
        bag(&all)
    };
    // ROS writes NaN for what is not known: a gap.
    let read = run(MAPPING, Policy::Strict, &[("walk.mcap", &with(f64::NAN))]).unwrap();
    assert_eq!(read.recording.require(Signal::WheelSpeedLeft).unwrap().len(), 2);
    let infinite = with(f64::INFINITY);
    let error = message(run(MAPPING, Policy::Normal, &[("walk.mcap", &infinite)]));
    assert!(error.starts_with("walk.mcap: message 2, column /wheel.speed: `inf` is not a finite number"), "{error}");
    let read = run(MAPPING, Policy::Tolerant, &[("walk.mcap", &infinite)]).unwrap();
    assert_eq!(read.losses[0].kind, LossKind::BadCell);
}

#[test]
fn mistakes_in_the_mapping_of_topics() {
    let line = "signals.gyro_z = { column = \"z\", unit = \"rad/s\" }\n";
    let file = |keys: &str| message(run(&format!("[[files]]\n{keys}\n{line}"), Policy::Normal, &[]));
    let time = "time = { column = \"log_time\" }";
    assert!(file(time).contains("or the `topic` of a bag"));
    assert!(file("topic = \"/a\"\ntime = { rate_hz = 5 }").contains("\"header.stamp\", \"log_time\""));
    assert!(file(&format!("topic = \"/a\"\ndelimiter = \";\"\n{time}")).contains("neither `delimiter` nor `decimal`"));
    assert!(file("topic = \"/a\"\ntime = { column = \"header.stamp\", unit = \"s\" }").contains("leave out `unit`"));
    let twice = MAPPING.replace("/gyro", "/wheel");
    assert!(message(run(&twice, Policy::Normal, &[])).contains("topic `/wheel` of"));
}

#[test]
fn json_and_cdr_show_their_fields() {
    let mut all = messages(4);
    all.push(("/gyro".to_owned(), 2_000_000_000, b"{\"name\": [\"a\", \"b\"], \"v\": [1, 2]}".to_vec()));
    all.push(("/gyro".to_owned(), 2_000_000_001, gyro(1.0)));
    let bytes = bag(&all);
    let inside = contents("a.mcap", &mut Cursor::new(&bytes)).unwrap();
    let paths = |index: usize| -> Vec<String> {
        inside.topics[index].fields.as_ref().unwrap().iter().map(|field| field.path.clone()).collect()
    };
    assert_eq!(paths(0), ["stamp", "speed"]);
    assert_eq!(paths(1), ["header.stamp", "angular_velocity.z", "v"]);
    let list = &inside.topics[1].fields.as_ref().unwrap()[2];
    assert_eq!((list.lengths, list.names.clone()), (Some((2, 2)), vec!["a".to_owned(), "b".to_owned()]));
    assert_eq!((inside.topics[1].count, inside.topics[1].log_time_ns), (4, (1_010_000_000, 2_000_000_001)));
    let by_name = MAPPING.replace("angular_velocity.z", "v[b]");
    let read = run(&by_name, Policy::Strict, &[("a.mcap", &bytes)]).unwrap();
    assert_eq!(read.recording.require(Signal::GyroZ).unwrap().values(), [2.0]);
}
