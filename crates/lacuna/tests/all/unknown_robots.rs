//! Bags of robots that no built-in mapping knows: mapped by themselves for `check`, refused with the way on elsewhere.

use crate::common::bags::{bag, bag_with_filler, cdr, cmd_vel, imu, joint_states};
use crate::common::{Bench, ROBOT};
use serde_json::Value;

const JACKAL: [&str; 4] =
    ["front_left_wheel_joint", "front_right_wheel_joint", "rear_left_wheel_joint", "rear_right_wheel_joint"];

fn check(bench: &Bench, args: &[&str]) -> Value {
    let run = bench.run(&[&["check"], args, &["--json", "-"]].concat());
    assert_eq!(run.code(), Some(0), "{}", run.err());
    serde_json::from_str(&run.out()).unwrap()
}

/// The column of each signal.
fn columns(json: &Value) -> Vec<(String, String)> {
    let text = |value: &Value| value.as_str().unwrap().to_owned();
    let channels = json["recordings"][0]["channels"].as_array().unwrap();
    channels.iter().map(|channel| (text(&channel["signal"]), text(&channel["column"]))).collect()
}

fn said(json: &Value) -> String {
    json["mapping"]["inferred"].to_string()
}

#[test]
fn robots_are_mapped_by_themselves() {
    for (joints_topic, joints, imu_topic, left, right) in [
        ("/joint_states", &JACKAL[..], "/imu/data", JACKAL[0], JACKAL[1]),
        ("/j100_0000/platform/joint_states", &JACKAL[..], "/j100_0000/sensors/imu_0/data", JACKAL[0], JACKAL[1]),
        // The names of the Husky's mapping, without the topic of its currents.
        (
            "/joint_states",
            &["front_left_wheel", "front_right_wheel", "rear_left_wheel", "rear_right_wheel"],
            "/imu/data",
            "front_left_wheel",
            "front_right_wheel",
        ),
        // The Kobuki has these joints as well, and another inertial unit.
        ("/joint_states", &["wheel_left_joint", "wheel_right_joint"], "/imu", "wheel_left_joint", "wheel_right_joint"),
        (
            "/joint_states",
            &["wheel_drop_left_joint", "wheel_drop_right_joint", "left_wheel_joint", "right_wheel_joint"],
            "/imu",
            "left_wheel_joint",
            "right_wheel_joint",
        ),
        ("/joint_states", &["base_l_wheel", "base_r_wheel"], "/imu", "base_l_wheel", "base_r_wheel"),
        ("/robot/joint_states", &["wheel_rr", "wheel_rl", "wheel_fr", "wheel_fl"], "/imu", "wheel_rl", "wheel_rr"),
    ] {
        let bench = Bench::empty();
        bench.write_bytes("a.mcap", &bag(&[joint_states(joints_topic, joints), imu(imu_topic), cmd_vel("/cmd_vel")]));
        let json = check(&bench, &["a.mcap"]);
        assert_eq!(json["mapping"]["name"], "proposed", "{json}");
        let columns = columns(&json);
        assert_eq!(columns.len(), 12, "{columns:?}");
        for (signal, column) in [
            ("wheel_speed_left", format!("{joints_topic}.velocity[{left}]")),
            ("wheel_speed_right", format!("{joints_topic}.velocity[{right}]")),
            ("torque_left", format!("{joints_topic}.effort[{left}]")),
            ("gyro_z", format!("{imu_topic}.angular_velocity.z")),
        ] {
            assert!(columns.contains(&(signal.to_owned(), column.clone())), "{column}: {columns:?}");
        }
        assert!(said(&json).contains("/cmd_vel: left out"), "{json}");
        let clearpath = joints[0].starts_with("front");
        assert_eq!(said(&json).contains("no torques for sure"), clearpath, "{json}");
    }
}

#[test]
fn all_that_was_inferred_is_reported_in_words_too() {
    let bench = Bench::empty();
    bench.write_bytes("a.mcap", &bag(&[joint_states("/joint_states", &JACKAL), imu("/imu/data")]));
    let run = bench.run(&["check", "a.mcap"]);
    assert_eq!((run.code(), run.err().as_str()), (Some(0), ""));
    for part in ["No built-in mapping fits. One was proposed for a.mcap", "--write-mapping", "REP 103", "torque_left"] {
        assert!(run.out().contains(part), "{part}: {}", run.out());
    }
    let json = check(&bench, &["a.mcap"]);
    for sentence in json["mapping"]["inferred"].as_array().unwrap() {
        assert!(run.out().contains(sentence.as_str().unwrap()), "{sentence}: {}", run.out());
    }
}

#[test]
fn what_is_in_doubt_is_reported_and_not_mapped() {
    let bench = Bench::empty();
    bench.write_bytes("a.mcap", &bag(&[joint_states("/joint_states", &["wheel_1", "wheel_2"]), imu("/imu")]));
    let json = check(&bench, &["a.mcap"]);
    assert_eq!(columns(&json).len(), 6, "{json}");
    assert!(said(&json).contains("wheel_1, wheel_2 not mapped: the name says no side"), "{json}");
}

#[test]
fn a_diagnosis_of_an_unknown_robot_says_what_to_do_and_that_works() {
    let bench = Bench::new();
    bench.remove("case/reference");
    bench.remove("case/recordings");
    let robot = |joint: &str| bag(&[joint_states("/joint_states", &["left_wheel", joint]), imu("/imu")]);
    bench.write_bytes("case/reference/walk/walk_0.mcap", &robot("right_wheel"));
    bench.write_bytes(
        "case/recordings/walk_1.mcap",
        &bag(&[joint_states("/joint_states", &["left_wheel", "right_wheel"])]),
    );
    let command = "lacuna check case/reference/walk/walk_0.mcap --write-mapping my-robot.toml";
    bench.refuses(&[
        "is a bag that no built-in mapping fits (husky-bag, kobuki-bag, lacuna)",
        command,
        "--mapping my-robot.toml",
    ]);
    // The same for every command that reads signals.
    bench.write("robot.toml", ROBOT);
    bench.run(&["identify", "robot.toml", "case/recordings/walk_1.mcap"]).failed(&["--write-mapping my-robot.toml"]);
    bench.run(&["convert", "case/recordings/walk_1.mcap", "--out", "a.csv"]).failed(&["--write-mapping my-robot.toml"]);
    let words: Vec<&str> = command.split(' ').skip(1).collect();
    let run = bench.run(&words);
    assert_eq!(run.code(), Some(0), "{}", run.err());
    let run =
        bench.run(&["convert", "case/reference/walk/walk_0.mcap", "--mapping", "my-robot.toml", "--out", "a.csv"]);
    assert_eq!(run.code(), Some(0), "{}", run.err());
}

#[test]
fn a_bag_without_anything_to_propose_is_refused_with_another_way() {
    let bench = Bench::new();
    bench.remove("case/reference");
    bench.write_bytes("case/reference/my walk.mcap", &bag(&[cmd_vel("/cmd_vel")]));
    bench.remove("case/recordings");
    bench.write_bytes("case/recordings/b.mcap", &bag(&[cmd_vel("/cmd_vel")]));
    bench.refuses(&["none can be proposed", "lacuna check 'case/reference/my walk.mcap' --fields", "by hand"]);
}

#[test]
fn a_known_robot_is_read_without_a_word() {
    let bench = Bench::empty();
    let joints = ["wheel_left_joint", "wheel_right_joint"];
    bench.write_bytes("a.mcap", &bag(&[joint_states("/joint_states", &joints), imu("/imu/data")]));
    assert_eq!(check(&bench, &["a.mcap"])["mapping"]["name"], "kobuki-bag");
    let run = bench.run(&["convert", "a.mcap", "--out", "a.csv"]);
    assert_eq!(run.code(), Some(0), "{}", run.err());
    assert!(run.out().starts_with("7 channels"), "{}", run.out());
}

#[test]
fn currents_of_clearpaths_drives_are_read_item_by_item() {
    const FEEDBACK: &str = "builtin_interfaces/Time stamp\nclearpath_platform_msgs/DriveFeedback[] drivers\n\
        ================================================================================\n\
        MSG: clearpath_platform_msgs/DriveFeedback\nfloat32 current\nfloat32 measured_velocity\n\
        ================================================================================\n\
        MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n";
    let message = |t: f64| {
        let mut bytes = vec![0, 1, 0, 0];
        bytes.extend([t as i32, 0, 2].iter().flat_map(|word| word.to_le_bytes()));
        bytes.extend(
            [1.5 + t.sin() as f32, 3.0, 4.5 + t.sin() as f32, 6.0].iter().flat_map(|value| value.to_le_bytes()),
        );
        bytes
    };
    let feedback = cdr("/platform/motors/feedback", "clearpath_platform_msgs/msg/Feedback", FEEDBACK, message);
    let bench = Bench::empty();
    bench.write_bytes("a.mcap", &bag(&[feedback, joint_states("/platform/joint_states", &JACKAL)]));
    let json = check(&bench, &["a.mcap"]);
    let right = ("current_right".to_owned(), "/platform/motors/feedback.drivers[1].current".to_owned());
    assert!(columns(&json).contains(&right), "{json}");
    assert!(said(&json).contains("drivers[0] taken for the left side"), "{json}");
}

#[test]
fn a_panic_that_a_reader_catches_is_no_defect() {
    // The parser of definitions cuts the quotes off a default that is one quote.
    let topic = cdr("/odd", "test_msgs/msg/Odd", "string text \"\n", |_| vec![0, 1, 0, 0]);
    let bench = Bench::empty();
    bench.write_bytes("a.mcap", &bag(&[topic, imu("/imu")]));
    let run = bench.run(&["check", "a.mcap"]);
    assert_eq!((run.code(), run.err().as_str()), (Some(0), ""));
    assert!(run.out().contains("/odd: its schema does not parse") && run.out().contains("gyro_z"), "{}", run.out());
}

#[test]
fn a_bag_is_mapped_by_all_that_is_inside_not_by_its_beginning() {
    // Scans fill the beginning that is looked at; one topic comes before them, the other after.
    let scans = |count: usize| {
        let mut random = 1_u64;
        let mut scan = move || {
            let mut bytes = vec![0, 1, 0, 0, 0, 0, 16, 0];
            while bytes.len() < 8 + (1 << 20) {
                random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                bytes.extend(((random >> 32) as u32).to_le_bytes());
            }
            bytes.truncate(8 + (1 << 20));
            bytes
        };
        (0..count).map(|_| scan()).collect::<Vec<_>>()
    };
    let filler = || ("/scan", "test_msgs/msg/Scan", "uint8[] data");
    let bench = Bench::empty();
    bench.write_bytes(
        "a.mcap",
        &bag_with_filler(&[joint_states("/joint_states", &JACKAL)], filler(), &scans(24), &[imu("/imu/data")]),
    );
    let json = check(&bench, &["a.mcap"]);
    assert!(json["bags"][0]["bytes"].as_u64() > Some(20 << 20), "{json}");
    assert_eq!(columns(&json).len(), 12, "{json}");
    assert!(said(&json).contains("/imu/data"), "{json}");
    assert_eq!(json["bags"][0]["topics"].as_array().map(Vec::len), Some(3), "{json}");
}
