use recordings::{Contents, Field, Mapping, TopicContents};

use super::{Proposal, mapping};

const JOINTS: &str = "sensor_msgs/msg/JointState";
const IMU: &str = "sensor_msgs/msg/Imu";

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

fn proposed(topics: Vec<TopicContents>) -> Proposal {
    let proposal = mapping("mine", &contents(topics)).expect("something is known");
    let parsed = Mapping::parse("mine.toml", &proposal.toml);
    assert!(parsed.is_ok(), "{parsed:?}\n{}", proposal.toml);
    let told: std::collections::BTreeSet<&String> = proposal.inferred.iter().collect();
    assert_eq!(told.len(), proposal.inferred.len(), "said twice: {:?}", proposal.inferred);
    for sentence in &proposal.inferred {
        assert!(proposal.toml.contains(sentence.as_str()), "{sentence}: {}", proposal.toml);
    }
    proposal
}

/// Left and right joint of a topic with these joints, and what was inferred.
fn sides(names: &[&str]) -> (Option<String>, Option<String>, String) {
    let bag = contents(vec![
        topic("/joint_states", JOINTS, &[("velocity", names)]),
        topic("/imu", IMU, &[("angular_velocity.z", &[])]),
    ]);
    let Proposal { toml, inferred } = mapping("m", &bag).expect("the gyro is known");
    let joint = |side: &str| {
        let line = toml.lines().find(|line| line.starts_with(&format!("wheel_speed_{side} = ")))?;
        Some(line.split(['[', ']']).nth(1)?.to_owned())
    };
    (joint("left"), joint("right"), inferred.join("\n"))
}

#[test]
fn four_wheels_a_gyro_and_odometry_become_a_mapping_that_parses() {
    let joints: &[&str] = &["front_left_wheel", "front_right_wheel", "rear_left_wheel", "rear_right_wheel", "arm"];
    let proposal = proposed(vec![
        topic("/joint_states", JOINTS, &[("header.stamp", &[]), ("velocity", joints), ("effort", joints)]),
        topic("/imu/data", IMU, &[("angular_velocity.z", &[]), ("linear_acceleration.x", &[])]),
        topic("/odom", "nav_msgs/msg/Odometry", &[("pose.pose.position.x", &[])]),
        topic("/cmd_vel", "geometry_msgs/msg/TwistStamped", &[("twist.linear.x", &[])]),
    ]);
    let parsed = Mapping::parse("mine.toml", &proposal.toml).expect("parsed before");
    assert_eq!(parsed.files.len(), 2);
    let speeds = &parsed.files[0];
    assert_eq!((speeds.topic.as_deref(), speeds.columns.len()), (Some("/joint_states"), 4));
    assert_eq!(speeds.time.rate_hz, Some(50.0));
    assert_eq!(parsed.files[1].columns.len(), 2);
    for part in [
        "of front_left_wheel, rear_left_wheel the first",
        "effort taken for torques",
        "no torques for sure",
        "/odom: left out",
        "/cmd_vel: left out",
        "REP 103",
    ] {
        assert!(proposal.inferred.iter().any(|s| s.contains(part)), "{part}: {:?}", proposal.inferred);
    }
}

#[test]
fn sides_are_found_in_the_names_that_robots_have() {
    for (names, left, right) in [
        // Clearpath Jackal, Husky, Warthog.
        (&["front_left_wheel", "front_right_wheel", "rear_left_wheel", "rear_right_wheel"][..], 0, 1),
        (&["front_left_wheel_joint", "rear_left_wheel_joint", "front_right_wheel_joint", "left_diff_unit_joint"], 0, 2),
        // The pair is on one axle, whatever the order.
        (&["rear_right_wheel", "front_left_wheel", "front_right_wheel", "rear_left_wheel"], 1, 2),
        // TurtleBot3, and TurtleBot4 on Create 3.
        (&["wheel_left_joint", "wheel_right_joint"], 0, 1),
        (&["wheel_drop_left_joint", "wheel_drop_right_joint", "left_wheel_joint", "right_wheel_joint"], 2, 3),
        // Others.
        (&["left_wheel", "right_wheel"], 0, 1),
        (&["base_l_wheel", "base_r_wheel", "base_caster_l_wheel"], 0, 1),
        (&["wheel_fl", "wheel_fr", "wheel_rl", "wheel_rr"], 0, 1),
        (&["fl_wheel_joint", "fr_wheel_joint", "bl_wheel_joint", "br_wheel_joint"], 0, 1),
        (&["wheel_r_r", "wheel_r_l", "wheel_f_r", "wheel_f_l"], 1, 0),
        (&["lf", "rf", "lr", "rr"], 0, 1),
        (&["back_right", "back_left", "front_right", "front_left"], 1, 0),
        (&["robot1/WheelLeft", "robot1/WheelRight"], 0, 1),
        (&["frontLeftMotor", "frontRightMotor"], 0, 1),
        (&["leftwheel", "rightwheel"], 0, 1),
        (&["lwheel", "rwheel", "left_joint", "right_joint"], 0, 1),
        (&["drivewhl_l_joint", "drivewhl_r_joint"], 0, 1),
        (&["left_track_1", "right_track_1", "right_track_2"], 0, 1),
    ] {
        let found = sides(names);
        let wanted = (Some(names[left].to_owned()), Some(names[right].to_owned()));
        assert_eq!((found.0, found.1), wanted, "{names:?}: {}", found.2);
    }
}

#[test]
fn joints_whose_side_is_in_doubt_are_not_mapped_and_the_reason_is_reported() {
    for (names, why) in [
        (&["wheel_1", "wheel_2"][..], "wheel_1, wheel_2 not mapped: the name says no side"),
        (&["wheel_f", "wheel_r"], "wheel_r not mapped: `r` in the name may be no side"),
        (&["l_wheel"], "`l` in the name may be no side"),
        (&["left_right_wheel"], "left_right_wheel not mapped: the name says left and right"),
        (&["left_caster_wheel", "right_caster_wheel"], "by `caster` in the name a joint that does not drive"),
        (&["front_left_steer_motor"], "by `steer` in the name a joint that does not drive"),
        (
            &["left_arm_joint", "right_arm_joint", "left_elbow", "upright", "head_l", "bright_wheel"],
            "bright_wheel not mapped",
        ),
    ] {
        let (left, right, inferred) = sides(names);
        assert_eq!((left, right), (None, None), "{names:?}: {inferred}");
        assert!(inferred.contains(why), "{why}: {inferred}");
    }
    let (left, right, inferred) = sides(&["left_wheel", "wheel_2"]);
    assert_eq!((left.as_deref(), right), (Some("left_wheel"), None));
    assert!(inferred.contains("no joint of the right side was found"), "{inferred}");
    let (.., inferred) = sides(&["back_left", "back_right"]);
    assert!(
        inferred.contains("back_left, back_right taken for driven wheels, which their names do not say"),
        "{inferred}"
    );
}

#[test]
fn names_that_were_made_up_take_no_time() {
    let long = "lr".repeat(50_000) + "x";
    let names: Vec<String> = (0..200).map(|i| format!("{long}{i}")).collect();
    assert_eq!(sides(&names.iter().map(String::as_str).collect::<Vec<_>>()).0, None);
}

#[test]
fn commands_are_set_points_and_of_signals_that_are_there_twice_one_is_reported() {
    let wheels: &[&str] = &["left_wheel", "right_wheel"];
    let proposal = proposed(vec![
        topic("/cmd_joints", JOINTS, &[("velocity", wheels)]),
        topic("/joint_states", JOINTS, &[("velocity", wheels)]),
        topic("/joint_states_2", JOINTS, &[("velocity", wheels)]),
        topic("/imu/data_raw", IMU, &[("angular_velocity.z", &[]), ("linear_acceleration.x", &[])]),
        topic("/imu/data", IMU, &[("angular_velocity.z", &[])]),
        topic("/goal_pose", "geometry_msgs/msg/PoseStamped", &[("pose.position.x", &[])]),
        topic("/mocap/pose", "geometry_msgs/msg/PoseStamped", &[("pose.position.x", &[]), ("pose.position.y", &[])]),
    ]);
    let (text, told) = (&proposal.toml, proposal.inferred.join("\n"));
    assert!(text.contains("command_speed_left") && !text.contains("topic = \"/joint_states_2\""), "{text}");
    assert_eq!(text.matches("wheel_speed_left = ").count(), 1);
    assert!(
        told.contains("/joint_states_2: wheel_speed_left, wheel_speed_right left out; taken from /joint_states"),
        "{told}"
    );
    assert!(told.contains("/imu/data_raw: gyro_z left out; taken from /imu/data"), "{told}");
    assert!(told.contains("/goal_pose: left out") && text.contains("topic = \"/mocap/pose\""), "{told}");
}

#[test]
fn of_several_robots_in_a_bag_the_first_is_proposed() {
    let wheels: &[&str] = &["left_wheel", "right_wheel"];
    let proposal = proposed(vec![
        topic("/j100_0001/sensors/imu_0/data", IMU, &[("angular_velocity.z", &[])]),
        topic("/j100_0000/platform/joint_states", JOINTS, &[("velocity", wheels)]),
        topic("/j100_0001/platform/joint_states", JOINTS, &[("velocity", wheels)]),
    ]);
    assert!(!proposal.toml.contains("topic = \"/j100_0001"), "{}", proposal.toml);
    assert_eq!(proposal.inferred[0], "several robots are in this bag: proposed for /j100_0000, not for /j100_0001");
}

#[test]
fn of_what_has_no_word_nothing_is_proposed() {
    let bag = contents(vec![topic("/camera", "sensor_msgs/msg/Image", &[("height", &[])])]);
    assert_eq!(mapping("m", &bag), None);
}
