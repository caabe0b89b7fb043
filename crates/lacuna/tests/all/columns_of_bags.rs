//! Robots whose files name their columns, of which bags are recorded: wheel counts beside a pose, and cars.

use crate::common::bags::{Said, bag_of};
use crate::common::{Bench, CART as ROBOT};
use serde_json::Value;

const EVERY: f64 = 0.05;

/// Angles of both wheels at 20 Hz, and pose 20 ms later each time; the right wheel is 5 % larger than the file says.
fn drive(phase: f64) -> Vec<([f64; 2], [f64; 3])> {
    let (mut pose, mut angles) = ([0.0_f64; 3], [0.0; 2]);
    let rolled = |pose: [f64; 3], speeds: [f64; 2], dt: f64| {
        let (l, r) = (0.05 * speeds[0] * dt, 0.0525 * speeds[1] * dt);
        let turned = (r - l) / 0.3;
        let (sin, cos) = (pose[2] + 0.5 * turned).sin_cos();
        [pose[0] + 0.5 * (l + r) * cos, pose[1] + 0.5 * (l + r) * sin, pose[2] + turned]
    };
    (0..1200_u32)
        .map(|k| {
            let level = f64::from(k / 60) + phase;
            let speeds = [4.0 + 2.0 * (1.7 * level).sin(), 4.0 + 2.0 * (2.9 * level).cos()];
            let rough = |s: f64| 5e-4 * (f64::from(k) * 7.3 + s).sin();
            let later = rolled(pose, speeds, 0.02);
            let row = (angles, [later[0] + rough(0.0), later[1] + rough(1.0), later[2] + rough(2.0)]);
            pose = rolled(pose, speeds, EVERY);
            angles = [0, 1].map(|wheel| angles[wheel] + speeds[wheel] * EVERY);
            row
        })
        .collect()
}

fn pose_message([x, y, yaw]: [f64; 3]) -> String {
    let (sin, cos) = (0.5 * yaw).sin_cos();
    format!(
        r#"{{STAMP,"pose":{{"position":{{"x":{x},"y":{y},"z":0.2}},"orientation":{{"x":0.0,"y":0.0,"z":{sin},"w":{cos}}}}}}}"#
    )
}

/// A bag of joint states and a pose.
fn joints(phase: f64) -> Vec<u8> {
    let topics = [
        ("/joint_states", "sensor_msgs/msg/JointState"),
        ("/vicon/cart", "geometry_msgs/msg/PoseStamped"),
        ("/odom", "nav_msgs/msg/Odometry"),
    ];
    let said = drive(phase).into_iter().enumerate().flat_map(|(k, ([left, right], pose))| -> [Said; 2] {
        let t = 1e9 + EVERY * k as f64;
        let joints = format!(
            r#"{{STAMP,"name":["wheel_right_joint","wheel_left_joint","arm"],"position":[{right},{left},0.3],"velocity":[],"effort":[]}}"#
        );
        [(0, t, joints), (1, t + 0.02, pose_message(pose))]
    });
    bag_of(&topics, said.collect())
}

/// A bag of encoder counts without stamps, which wrap around at 16 bits.
fn ticks(phase: f64) -> Vec<u8> {
    let topics = [
        ("/encoders/left_ticks", "std_msgs/msg/Int32"),
        ("/encoders/right_ticks", "std_msgs/msg/Int32"),
        ("/vicon/cart", "geometry_msgs/msg/PoseStamped"),
    ];
    let said = drive(phase).into_iter().enumerate().flat_map(|(k, (angles, pose))| -> [Said; 3] {
        let t = 1e9 + EVERY * k as f64;
        let [left, right] = angles.map(|angle| {
            let count = (angle / std::f64::consts::TAU * 4000.0).round() as i64;
            format!(r#"{{"data":{}}}"#, count.rem_euclid(65_536))
        });
        [(0, t, left), (1, t + 0.001, right), (2, t + 0.02, pose_message(pose))]
    });
    bag_of(&topics, said.collect())
}

/// The radius of the right wheel that a diagnosis with this robot file found.
fn radius(bench: &Bench, robot: &str, drives: &str) -> f64 {
    let run = bench.run(&["diagnose", "--robot", robot, "--recordings", drives, "--json", "out.json"]);
    assert_eq!(run.code(), Some(0), "{}", run.err());
    assert!(run.out().contains("radius of one wheel (right)"), "{}", run.out());
    let json: Value = serde_json::from_str(&bench.read("out.json")).unwrap();
    json["diagnosis"]["tuning"]["radius of right"].as_f64().unwrap()
}

#[test]
fn a_bag_of_joint_states_and_a_pose_is_proposed_read_and_diagnosed() {
    let bench = Bench::empty();
    bench.write("cart.toml", ROBOT);
    for (k, phase) in [0.0, 0.4, 0.8].into_iter().enumerate() {
        bench.write_bytes(&format!("drives/run{k}/run{k}_0.mcap"), &joints(phase));
        bench.write(&format!("drives/run{k}/metadata.yaml"), "");
    }
    let refused = bench.run(&["diagnose", "--robot", "cart.toml", "--recordings", "drives"]);
    refused.failed(&["recording 'run0' is a bag", "'left', which is a column of a table", "--write-mapping FILE"]);

    let run = bench.run(&["check", "drives", "--robot", "cart.toml", "--write-mapping", "new.toml"]);
    assert_eq!(run.code(), Some(0), "{}{}", run.out(), run.err());
    for part in ["Robot file proposed: new.toml", "wheel_left_joint as wheel left", "pose taken for the measured one"] {
        assert!(run.out().contains(part), "no `{part}` in {}", run.out());
    }
    let new = bench.read("new.toml");
    for part in [
        "# looking ahead",
        "column = \"/joint_states.position[wheel_left_joint]\"",
        "wheels = \"angle\"",
        "time = \"header.stamp\"",
        "yaw = \"/vicon/cart.pose.orientation\"",
    ] {
        assert!(new.contains(part), "no `{part}` in {new}");
    }

    let run = bench.run(&["check", "drives", "--robot", "new.toml", "--json", "check.json"]);
    assert_eq!(run.code(), Some(0), "{}{}", run.out(), run.err());
    assert!(run.out().contains("run1: 1199 rows in 59.9 s, a pose in 1199 of them"), "{}", run.out());
    let json: Value = serde_json::from_str(&bench.read("check.json")).unwrap();
    assert_eq!(json["robot"]["recordings"].as_array().map(Vec::len), Some(3));

    let found = radius(&bench, "new.toml", "drives");
    assert!((found - 0.0525).abs() < 2e-4, "{found}");
}

#[test]
fn counts_without_stamps_that_wrap_around_are_read_by_log_times() {
    let bench = Bench::empty();
    bench.write("cart.toml", ROBOT);
    for (k, phase) in [0.0, 0.4, 0.8].into_iter().enumerate() {
        bench.write_bytes(&format!("drives/run_{k}.mcap"), &ticks(phase));
    }
    let run = bench.run(&["check", "drives/run_0.mcap", "--robot", "cart.toml", "--write-mapping", "new.toml"]);
    assert!(run.out().contains("log times taken for all topics"), "{}{}", run.out(), run.err());
    let new = bench.read("new.toml");
    for part in ["\"/encoders/left_ticks.data\"", "wheels = \"counter\"", "time = \"log_time\""] {
        assert!(new.contains(part), "no `{part}` in {new}");
    }
    let found = radius(&bench, "new.toml", "drives");
    assert!((found - 0.0525).abs() < 2e-4, "{found}");
    assert!(bench.read("out.json").contains("wraps around at 65536"));
}

#[test]
fn without_a_pose_the_gyro_is_proposed_and_the_wheel_is_named_by_it() {
    let bench = Bench::empty();
    bench.write("cart.toml", ROBOT);
    let topics = [("/joint_states", "sensor_msgs/msg/JointState"), ("/imu/data", "sensor_msgs/msg/Imu")];
    for (run, phase) in [0.0, 0.4, 0.8].into_iter().enumerate() {
        let rows = drive(phase);
        let said = rows.iter().enumerate().skip(1).flat_map(|(k, ([left, right], _))| -> [Said; 2] {
            let t = 1e9 + EVERY * k as f64;
            let joints = format!(
                r#"{{STAMP,"name":["wheel_right_joint","wheel_left_joint"],"position":[{right},{left}],"velocity":[],"effort":[]}}"#
            );
            // The yaw rate in the middle between two angles.
            let [before_left, before_right] = rows[k - 1].0;
            let rate = (0.0525 * (right - before_right) - 0.05 * (left - before_left)) / 0.3 / EVERY;
            let imu = format!(r#"{{STAMP,"angular_velocity":{{"x":0.0,"y":0.0,"z":{rate}}}}}"#);
            [(0, t, joints), (1, t - 0.5 * EVERY, imu)]
        });
        bench.write_bytes(&format!("drives/run_{run}.mcap"), &bag_of(&topics, said.collect()));
    }
    let run = bench.run(&["check", "drives", "--robot", "cart.toml", "--write-mapping", "new.toml"]);
    assert_eq!(run.code(), Some(0), "{}{}", run.out(), run.err());
    assert!(run.out().contains("the gyro shows how the robot turns"), "{}", run.out());
    let new = bench.read("new.toml");
    assert!(new.contains("gyro = \"/imu/data.angular_velocity.z\"") && !new.contains("x = "), "{new}");

    // By turning alone a larger right wheel is a smaller left one on a robot with another track.
    let run = bench.run(&["diagnose", "--robot", "new.toml", "--recordings", "drives"]);
    assert_eq!(run.code(), Some(0), "{}", run.err());
    for part in
        ["Wheels and gyro disagree", "Radius of one wheel", "a gyro shows how the body turns and not how far it goes"]
    {
        assert!(run.out().contains(part), "no `{part}` in {}", run.out());
    }
}

#[test]
fn a_car_finds_its_commands_in_a_bag() {
    let bench = Bench::empty();
    let topics = [
        ("/commands/throttle", "std_msgs/msg/Float64"),
        ("/drive", "ackermann_msgs/msg/AckermannDriveStamped"),
        ("/imu", "sensor_msgs/msg/Imu"),
        ("/mocap/car", "geometry_msgs/msg/PoseStamped"),
    ];
    let said = (0..400).flat_map(|k| -> [Said; 4] {
        let t = 1e9 + 0.02 * f64::from(k);
        let way = 0.01 * f64::from(k);
        [
            (0, t, r#"{"data":0.3}"#.to_owned()),
            (1, t + 0.001, r#"{STAMP,"drive":{"steering_angle":0.1,"speed":0.5}}"#.to_owned()),
            (2, t + 0.002, r#"{STAMP,"angular_velocity":{"x":0.0,"y":0.0,"z":0.02}}"#.to_owned()),
            (3, t + 0.003, pose_message([way, 0.0, 0.0])),
        ]
    });
    bench.write_bytes("lap.mcap", &bag_of(&topics, said.collect()));
    let run = bench.run(&["check", "lap.mcap", "--robot", "car", "--write-mapping", "mine.toml"]);
    assert_eq!(run.code(), Some(0), "{}{}", run.out(), run.err());
    let mine = bench.read("mine.toml");
    for part in [
        "throttle = \"/commands/throttle.data\"",
        "steering = \"/drive.drive.steering_angle\"",
        "steering_unit = \"rad\"",
        "gyro = \"/imu.angular_velocity.z\"",
        "time = \"log_time\"",
    ] {
        assert!(mine.contains(part), "no `{part}` in {mine}");
    }
    assert!(!mine.contains("encoder ="), "{mine}");
    let run = bench.run(&["check", "lap.mcap", "--robot", "mine.toml"]);
    assert_eq!(run.code(), Some(0), "{}{}", run.out(), run.err());
    assert!(run.out().contains("lap: 8.0 s, with a pose"), "{}", run.out());
}

#[test]
fn messages_without_a_stamp_backwards_or_without_a_value_are_left_out_and_told() {
    let bench = Bench::empty();
    bench.write("cart.toml", ROBOT);
    let topics = [("/joint_states", "sensor_msgs/msg/JointState"), ("/vicon/cart", "geometry_msgs/msg/PoseStamped")];
    let said = drive(0.0).into_iter().enumerate().flat_map(|(k, ([left, right], pose))| -> [Said; 2] {
        let t = 1e9 + EVERY * k as f64;
        let joints = format!(
            r#"{{STAMP,"name":["wheel_left_joint","wheel_right_joint"],"position":[{left},{right}],"velocity":[],"effort":[]}}"#
        );
        let joints = match k {
            10 => joints.replace("STAMP", r#""header":{"stamp":{"sec":0,"nanosec":0}}"#),
            20 | 21 => joints.replace("STAMP", r#""header":{"stamp":{"sec":999999999,"nanosec":0}}"#),
            30 => joints.replace("\"position\":[", "\"position\":[null,"),
            _ => joints,
        };
        [(0, t, joints), (1, t + 0.02, pose_message(pose))]
    });
    bench.write_bytes("run.mcap", &bag_of(&topics, said.collect()));
    bench.run(&["check", "run.mcap", "--robot", "cart.toml", "--write-mapping", "new.toml"]);
    let run = bench.run(&["check", "run.mcap", "--robot", "new.toml"]);
    assert_eq!(run.code(), Some(0), "{}{}", run.out(), run.err());
    for part in [
        "1 messages have a header.stamp of 0",
        "2 messages are not later than the one before them; they were left out",
        "1 messages do not decode, or lack a value",
        "Can be diagnosed",
    ] {
        assert!(run.out().contains(part), "no `{part}` in {}", run.out());
    }
}

#[test]
fn a_car_without_a_pose_is_read_by_gyro_and_encoder_and_keeps_no_column_that_a_bag_lacks() {
    let bench = Bench::empty();
    let topics = [
        ("/commands/throttle", "std_msgs/msg/Float64"),
        ("/commands/servo", "std_msgs/msg/Float64"),
        ("/imu", "sensor_msgs/msg/Imu"),
        ("/wheel_speed", "std_msgs/msg/Float64"),
    ];
    let said = (0..400).flat_map(|k| -> [Said; 4] {
        let t = 1e9 + 0.02 * f64::from(k);
        [
            (0, t, r#"{"data":0.3}"#.to_owned()),
            (1, t, r#"{"data":0.1}"#.to_owned()),
            (2, t, r#"{STAMP,"angular_velocity":{"x":0.0,"y":0.0,"z":0.02}}"#.to_owned()),
            (3, t, r#"{"data":0.5}"#.to_owned()),
        ]
    });
    bench.write_bytes("lap.mcap", &bag_of(&topics, said.collect()));
    let run = bench.run(&["check", "lap.mcap", "--robot", "dart", "--write-mapping", "mine.toml"]);
    assert_eq!(run.code(), Some(0), "{}{}", run.out(), run.err());
    assert!(run.out().contains("lap: 8.0 s, without a pose"), "{}", run.out());
    let mine = bench.read("mine.toml");
    assert!(["x = ", "car_time = ", "enabled = "].iter().all(|key| !mine.contains(&format!("\n{key}\""))), "{mine}");
}

#[test]
fn what_a_bag_lacks_is_said_with_what_to_do() {
    let bench = Bench::empty();
    bench.write("cart.toml", ROBOT);
    bench.write_bytes("run.mcap", &joints(0.0));
    bench.run(&["check", "run.mcap", "--robot", "husky-a200"]).failed(&["reads its signals by a mapping"]);
    let other =
        ROBOT.replace("\"left\"            #", "\"arm_left\"  #").replace("name = \"right\"", "name = \"arm_right\"");
    bench.write("other.toml", &other);
    bench
        .run(&["check", "run.mcap", "--robot", "other.toml", "--write-mapping", "new.toml"])
        .failed(&["wheels arm_left, arm_right", "joints are: wheel_right_joint, wheel_left_joint, arm"]);
    let with = |from: &str, to: &str| {
        let named = ROBOT
            .replace("\"left\"\n", "\"/joint_states.position[wheel_left_joint]\"\n")
            .replace("column = \"right\"", "column = \"/joint_states.position[wheel_right_joint]\"")
            .replace("wheels = \"counts\"", "wheels = \"angle\"")
            .replace("time = \"t\"", "time = \"header.stamp\"")
            .replace("x = \"x\"", "x = \"/vicon/cart.pose.position.x\"")
            .replace("y = \"y\"", "y = \"/vicon/cart.pose.position.y\"")
            .replace("yaw = \"yaw\"", "yaw = \"/vicon/cart.pose.orientation\"");
        assert!(named.contains(from), "{named}");
        bench.write("named.toml", &named.replace(from, to));
        bench.run(&["diagnose", "--robot", "named.toml", "--recordings", "run.mcap"])
    };
    with("header.stamp", "stamp").failed(&["takes the time from 'stamp'", "time = \"log_time\""]);
    with("position.y", "position.why").failed(&[
        "topic /vicon/cart: 1200 messages do not decode, or lack a value",
        "'/vicon/cart.pose.position.x' has no values",
    ]);
    with("/joint_states.position[wheel_left_joint]", "/joints.position[wheel_left_joint]")
        .failed(&["topic /joints: no message of it is there", "'/joints.position[wheel_left_joint]' has no values"]);
}

/// A robot file of a tricycle whose columns are those of a table.
fn tricycle() -> String {
    include_str!("../../../wheeled/robots/torque-tricycle.toml").to_owned()
}

/// A tricycle that drives straight on, its bag with these joints and efforts.
fn tricycle_bag(effort: &str) -> Vec<u8> {
    let topics = [
        ("/joint_states", "sensor_msgs/msg/JointState"),
        ("/imu", "sensor_msgs/msg/Imu"),
        ("/mocap/base", "geometry_msgs/msg/PoseStamped"),
    ];
    let said = (0..600).flat_map(|k| -> [Said; 3] {
        let t = 1e9 + 0.02 * f64::from(k);
        let speed = 1.0 + 0.5 * (0.05 * f64::from(k)).sin();
        let joints = format!(
            r#"{{STAMP,"name":["front_steering_joint","front_wheel_joint","rear_left_wheel_joint"],"position":[0.1,{k},{k}],"velocity":[0.0,{speed},{speed}],"effort":{effort}}}"#
        );
        [
            (0, t, joints),
            (1, t, r#"{STAMP,"angular_velocity":{"x":0.0,"y":0.0,"z":0.02}}"#.to_owned()),
            (2, t, pose_message([0.02 * f64::from(k), 0.0, 0.0])),
        ]
    });
    bag_of(&topics, said.collect())
}

#[test]
fn torques_and_joints_of_a_robot_of_any_wheels_are_proposed_by_their_names() {
    let bench = Bench::empty();
    bench.write("mine.toml", &tricycle());
    bench.write_bytes("run.mcap", &tricycle_bag("[0.0,1.5,0.0]"));
    let run = bench.run(&["check", "run.mcap", "--robot", "mine.toml", "--write-mapping", "new.toml"]);
    assert_eq!(run.code(), Some(0), "{}{}", run.out(), run.err());
    let new = bench.read("new.toml");
    for part in [
        "column = \"/joint_states.effort[front_wheel_joint]\"",
        "column = \"/joint_states.position[front_steering_joint]\"",
        "column = \"/joint_states.velocity[front_wheel_joint]\"",
        // A wheel without a column gets one where the bag has it.
        "column = \"/joint_states.velocity[rear_left_wheel_joint]\"",
        "gyro = \"/imu.angular_velocity.z\"",
        "yaw = \"/mocap/base.pose.orientation\"",
        "wheels = \"speed\"",
        "where it is a current, torque_per_unit is torque constant times gear",
    ] {
        assert!(new.contains(part), "no `{part}` in {new}");
    }
    let run = bench.run(&["check", "run.mcap", "--robot", "new.toml"]);
    assert_eq!(run.code(), Some(0), "{}{}", run.out(), run.err());
    assert!(run.out().contains("run: 12.0 s, with a pose"), "{}", run.out());
}

#[test]
fn a_bag_without_torques_or_without_the_steering_says_which_joints_it_has() {
    let bench = Bench::empty();
    bench.write("mine.toml", &tricycle());
    bench.write_bytes("run.mcap", &tricycle_bag("[]"));
    bench.run(&["check", "run.mcap", "--robot", "mine.toml", "--write-mapping", "new.toml"]).failed(&[
        "the torque or current of motor front",
        "Joints with an effort are: none; with a position: front_steering_joint, front_wheel_joint",
    ]);
    let topics = [("/drive/current", "std_msgs/msg/Float64"), ("/drive", "ackermann_msgs/msg/AckermannDriveStamped")];
    let said = (0..200).flat_map(|k| -> [Said; 2] {
        let t = 1e9 + 0.02 * f64::from(k);
        [
            (0, t, r#"{"data":3.0}"#.to_owned()),
            (1, t, r#"{STAMP,"drive":{"steering_angle":0.1,"speed":0.5}}"#.to_owned()),
        ]
    });
    bench.write_bytes("bare.mcap", &bag_of(&topics, said.collect()));
    bench.run(&["check", "bare.mcap", "--robot", "mine.toml", "--write-mapping", "new.toml"]);
    let new = bench.read("new.toml");
    for part in [
        "column = \"/drive/current.data\"",
        "column = \"/drive.drive.steering_angle\"",
        "it is asked for and not measured",
        "the turning of wheels is not compared",
        "no topic of a measured pose",
    ] {
        assert!(new.contains(part), "no `{part}` in {new}");
    }
}
