use std::collections::BTreeMap;

use approx::assert_relative_eq;
use odometry::file::{BUILT_IN, RobotFile};
use verdict::{Cause, Diagnosis, Estimate, Verdict};

use super::*;

const CAR: &str = r#"
name = "model car"   # 1:10
kind = "car"
wheelbase = { value = 0.26, sigma = 0.002, source = "tape measure" }    # m
mass = { value = 2.0 }
front_axle_mass = { value = 1.0 }
yaw_inertia = { value = 0.02 }
wheel_radius = { value = 0.033, sigma = 0.0005 }

[steering]
full_angle = { value = 0.40, sigma = 0.02, source = "protractor" }      # rad
centre = { value = 0.0, sigma = 0.02 }

[columns]
time = "t"
throttle = "duty"
steering = "servo"
encoder = "speed"
"#;

/// A verdict with these values, of which those of a cause are told.
fn verdict(tuning: &[(&str, f64)], told: &[(&str, f64)]) -> Diagnosis {
    let mut out = Diagnosis::withheld();
    out.verdict = Verdict::Explained;
    out.sentences = vec!["Something is off.".to_owned()];
    out.tuning = tuning.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
    let estimate = |value| Estimate { value, sigma: Some(0.02 * value), at_bound: false };
    let parameters: BTreeMap<String, Estimate> =
        told.iter().map(|(name, value)| ((*name).to_owned(), estimate(*value))).collect();
    out.ranked = vec![Cause { parameters: parameters.into_iter().collect(), ..Cause::plain("some", "some", 0.9) }];
    out
}

fn robot(kind: Kind, text: &str, diagnosis: Option<Diagnosis>) -> ColumnsRobot {
    ColumnsRobot { kind, name: "robot.toml".to_owned(), text: text.to_owned(), diagnosis, is_nominal: false }
}

fn built_in(name: &str) -> &'static str {
    BUILT_IN.iter().find(|b| b.0 == name).expect("built in").1
}

/// Every constant of a robot off by another share.
fn off(text: &str) -> Vec<(String, f64)> {
    let robot = RobotFile::parse("robot.toml", text).expect("a robot").robot;
    let places = |axis: usize| robot.wheels.iter().map(move |w| w.place[axis]);
    let extent = |axis: usize| places(axis).fold(f64::MIN, f64::max) - places(axis).fold(f64::MAX, f64::min);
    let value = |constant: &odometry::Constant| match constant.quantity {
        odometry::Quantity::Radius(k) => robot.wheels[robot.measured()[k]].radius * (1.01 + 0.001 * k as f64),
        odometry::Quantity::Across => 1.02 * extent(1),
        odometry::Quantity::Along => 0.97 * extent(0),
        odometry::Quantity::Reach => 1.03 * robot.wheels[0].place[0].hypot(robot.wheels[0].place[1]),
        odometry::Quantity::SteeringOffset => 0.0123,
        odometry::Quantity::SteeringGain => 1.0,
        _ => 0.001,
    };
    odometry::constants(&robot, odometry::Measured::POSE).iter().map(|c| (c.name.clone(), value(c))).collect()
}

fn corrected(name: &str) -> ColumnsRobot {
    let off = off(built_in(name));
    let tuning: Vec<(&str, f64)> = off.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    robot(Kind::Odometry, built_in(name), Some(verdict(&tuning, &[("rate of the clocks", 0.001)])))
}

#[test]
fn a_corrected_file_reads_back_as_the_corrected_robot_and_keeps_what_its_owner_wrote() {
    for (name, text) in BUILT_IN {
        let written = corrected(name).robot_file().expect("a file");
        let read = RobotFile::parse("corrected.toml", &written.text).unwrap_or_else(|e| panic!("{name}: {e}"));
        let stated = RobotFile::parse("robot.toml", text).expect("a robot");
        let wanted = wheels::corrected(&stated.robot, &corrected(name).tuning());
        assert_eq!((&read.columns, &read.description), (&stated.columns, &stated.description));
        for (read, wanted) in read.robot.wheels.iter().zip(&wanted.wheels) {
            assert_relative_eq!(read.radius, wanted.radius, max_relative = 1e-8);
            assert_relative_eq!(read.direction, wanted.direction, epsilon = 1e-8);
            for axis in 0..2 {
                assert_relative_eq!(read.place[axis], wanted.place[axis], epsilon = 1e-8);
            }
        }
        // What was corrected once is right by itself.
        let measured = read.robot.measured()[0];
        let [radius, before] = [&read, &stated].map(|file| file.robot.wheels[measured].radius);
        assert_relative_eq!(radius, 1.01 * before, max_relative = 1e-8);
        assert!(written.text.contains("re-tuned by lacuna from"), "{}", written.text);
        assert!(written.text.starts_with("# Corrected by lacuna") && written.text.contains("The verdict: Something"));
        let clock = "rate of the clocks is 0.001000 ± 0.000033 (90 %), which a robot file of kind odometry cannot \
                     hold: correct the time stamps of the counts by it.";
        assert_eq!(written.not_held, [clock]);
        assert!(written.text.contains(&format!("# {clock}\n")), "{}", written.text);
    }
    let commented = built_in("differential").replacen("radius = 0.042\n", "radius = 0.042   # m, with a calliper\n", 1);
    let mut robot = corrected("differential");
    robot.text = commented.clone();
    let text = robot.robot_file().expect("a file").text;
    assert!(
        text.contains("radius = 0.04242   # m, with a calliper") && text.contains("m; Sousa et al. (2022)"),
        "{text}"
    );
    assert_eq!(robot.nominal().robot_file().expect("a file").text, commented);
}

#[test]
fn a_zero_of_the_steering_is_the_direction_of_the_steered_wheel() {
    let text = corrected("tricycle").robot_file().expect("a file").text;
    let front = &RobotFile::parse("robot.toml", &text).expect("a robot").robot.wheels[0];
    assert_relative_eq!(front.direction, 0.0123, epsilon = 1e-9);
    let controllers = corrected("tricycle").controllers().expect("parameters").text;
    assert!(controllers.contains("wheelbase: 0.1455\n"), "{controllers}");
    let zero = "# - steering zero is 0.0123 rad, which tricycle_controller cannot hold: add it to the steering angle";
    assert!(controllers.contains(zero), "{controllers}");
}

#[test]
fn what_may_as_well_not_be_there_is_not_told() {
    let within = [("offset of the clocks", -0.001), ("rate of the clocks", 0.001)];
    let mut diagnosis = verdict(&[], &within);
    diagnosis.ranked[0].parameters.get_mut("offset of the clocks").expect("told").sigma = Some(0.2);
    let written = robot(Kind::Odometry, built_in("differential"), Some(diagnosis)).robot_file().expect("a file");
    assert!(written.not_held.len() == 1 && written.not_held[0].starts_with("rate"), "{:?}", written.not_held);
}

#[test]
fn a_corrected_car_reads_back_with_all_that_was_fitted_and_as_well_known_as_before() {
    let stated = single_track::file::RobotFile::parse("car.toml", CAR).expect("a car").car;
    let all = single_track::constants(&stated);
    let off = |c: &single_track::Constant| if c.is_factor { 1.07 * c.given } else { c.given + 0.013 };
    let values: Vec<(&str, f64)> = all.iter().map(|c| (c.name, off(c))).collect();
    let written = robot(Kind::Car, CAR, Some(verdict(&values, &values))).robot_file().expect("a file");
    assert_eq!(written.not_held, Vec::<String>::new(), "{}", written.text);
    let read = single_track::file::RobotFile::parse("car.toml", &written.text).expect("a car").car;
    let found = single_track::constants(&read);
    // A motor of which its owner states nothing has no finer laws either.
    assert_eq!(found.len(), all.len());
    for ((before, after), (name, value)) in all.iter().zip(&found).zip(&values) {
        assert_relative_eq!(after.given, value, max_relative = 1e-8);
        // What the file says, to which the model adds its own.
        assert!(
            after.sigma < 1.2 * before.sigma && after.sigma > 0.9 * before.sigma,
            "{name}: {} {}",
            before.sigma,
            after.sigma
        );
    }
    for part in
        ["name = \"model car\"   # 1:10", "re-tuned by lacuna from 0.26 m; tape measure", "from the usual 0.5 m/s²"]
    {
        assert!(written.text.contains(part), "no `{part}` in\n{}", written.text);
    }

    // Without a mass the file holds what shows of the yaw inertia.
    let weightless = CAR.replace("mass = { value = 2.0 }\n", "").replace("yaw_inertia = { value = 0.02 }\n", "");
    let weightless = weightless.replace("front_axle_mass = { value = 1.0 }\n", "");
    let found = [("yaw inertia over mass", 0.0123)];
    let text = robot(Kind::Car, &weightless, Some(verdict(&found, &[]))).robot_file().expect("a file").text;
    let read = single_track::file::RobotFile::parse("car.toml", &text).expect("a car").car;
    assert_relative_eq!(read.gyration.value, 0.0123, max_relative = 1e-8);

    // What belongs to the day stays out where it is not told.
    let untold = robot(Kind::Car, CAR, Some(verdict(&values, &values[..1]))).robot_file().expect("a file").text;
    assert!(
        !untold.contains("[ground]") && !untold.contains("bias") && untold.contains("front_compliance"),
        "{untold}"
    );
}

#[test]
fn a_steering_that_is_asked_for_angles_keeps_what_it_makes_of_them_as_a_gain() {
    let asked = CAR.replace("steering = \"servo\"", "steering = \"servo\"\nsteering_unit = \"deg\"");
    let found = [("steering angle at full command", 0.34)];
    let written = robot(Kind::Car, &asked, Some(verdict(&found, &found))).robot_file().expect("a file");
    let read = single_track::file::RobotFile::parse("car.toml", &written.text).expect("a car");
    assert_relative_eq!(read.full_asked, 0.40);
    assert_relative_eq!(read.car.full_steering.value, 0.34, max_relative = 1e-8);
    assert!(
        written.text.contains("gain = { value = 0.85, source = \"re-tuned by lacuna from 1\" }"),
        "{}",
        written.text
    );
    let again = robot(Kind::Car, &written.text, Some(verdict(&[("steering angle at full command", 0.36)], &[])));
    let text = again.robot_file().expect("a file").text;
    assert!(text.contains("gain = { value = 0.9, source"), "{text}");

    // Of commands without a unit the angle is corrected, and a gain beside it stays.
    let with_gain = CAR.replace("[columns]", "gain = { value = 0.5 }\n\n[columns]");
    let found = [("steering angle at full command", 0.22)];
    let text = robot(Kind::Car, &with_gain, Some(verdict(&found, &found))).robot_file().expect("a file").text;
    let read = single_track::file::RobotFile::parse("car.toml", &text).expect("a car");
    assert_relative_eq!(read.car.full_steering.value, 0.22, max_relative = 1e-8);
    assert!(text.contains("gain = { value = 0.5 }") && text.contains("full_angle = { value = 0.44"), "{text}");
}

#[test]
fn a_controller_of_a_car_has_its_lengths_and_says_what_it_cannot_hold() {
    let tuning = [
        ("wheelbase", 0.25),
        ("steering angle at full command", 0.42),
        ("steering angle at no command", -0.03),
        ("encoder speed over ground speed", 1.1),
    ];
    let told = [("encoder speed over ground speed", 1.1), ("compliance of the front tyres", 0.02)];
    let car = robot(Kind::Car, CAR, Some(verdict(&tuning, &told)));

    // Wheels that are smaller than stated make the encoder's speed too large.
    let ros2 = car.controllers().expect("parameters");
    assert!(
        ros2.text.contains("rear_wheel_radius: 0.03\n") && ros2.text.contains("wheelbase: 0.25\n"),
        "{}",
        ros2.text
    );
    let parts = ["front tyres is 0.02000 ± 0.00066", "full command is 0.420 rad", "no command is -0.0300 rad"];
    assert!(ros2.not_held.len() == 3, "{:?}", ros2.not_held);
    assert!(parts.iter().all(|part| ros2.not_held.iter().any(|s| s.contains(part))), "{:?}", ros2.not_held);
    assert!(!ros2.text.contains("covariance_diagonal") && ros2.text.contains("from throttle and steering"));
    let unstated = robot(Kind::Car, &CAR.replace("wheel_radius = { value = 0.033, sigma = 0.0005 }", ""), None);
    let text = unstated.controllers().expect("parameters").text;
    assert!(text.contains("states no wheel_radius") && !text.contains("rear_wheel_radius:"), "{text}");
}

#[test]
fn every_built_in_robot_has_its_controller() {
    let parts: [(&str, &[&str]); 6] = [
        (
            "differential",
            &[
                "wheel_separation: 0.2\n",
                "wheel_separation_multiplier: 1.02\n",
                "wheel_radius: 0.042\n",
                "left_wheel_radius_multiplier: 1.01\n",
                "right_wheel_radius_multiplier: 1.011\n",
            ],
        ),
        ("skid-steer-4", &["- left_side_joint\n", "wheel_separation: 0.75\n", "wheel_separation_multiplier: 1.02\n"]),
        (
            "tricycle",
            &["type: tricycle_controller/TricycleController\n", "steering_joint_name: front_steering_joint\n"],
        ),
        ("mecanum-4", &["sum_of_robot_center_projection_on_X_Y_axis: 0.199\n"]),
        ("omni-3", &["- wheel_2_joint\n    - wheel_3_joint\n    - wheel_1_joint\n", "robot_radius: 0.20085\n"]),
        ("omni-4", &["- front_left_joint\n    - rear_left_joint\n", "turns the robot counter-clockwise"]),
    ];
    for (name, parts) in parts {
        let written = corrected(name).controllers().expect("parameters");
        for part in parts {
            assert!(written.text.contains(part), "{name}: no `{part}` in\n{}", written.text);
        }
        assert!(written.not_held.iter().any(|s| s.contains("time stamps")), "{name}: {:?}", written.not_held);
    }
    // One number for four radii that differ by 0.3 %.
    let mecanum = corrected("mecanum-4").controllers().expect("parameters");
    assert!(mecanum.not_held.iter().any(|s| s.contains("radii of wheels differ (front left 0.03030 m")), "{mecanum:?}");
    assert!(mecanum.text.contains("# front right, rear right: counts backwards"), "{}", mecanum.text);
}

#[test]
fn driven_wheels_behind_a_steered_one_ask_for_the_steering_controllers() {
    let rear = "[[wheel]]\nname = \"rear axle\"\nplace = [0, 0]\nradius = 0.0325\n\
                source = \"only says that the axle does not slide sideways\"\n";
    let tricycle = built_in("tricycle").replace("column = \"tick\"\n", "");
    let wheel = |name: &str, y: f64| {
        format!(
            "[[wheel]]\nname = \"{name}\"\nplace = [0, {y}]\nradius = 0.03\ncounts_per_turn = 1600.0\n\
             column = \"{name}\"\n"
        )
    };
    let written = |rear_wheels: &str| {
        let text = tricycle.replace(rear, rear_wheels);
        robot(Kind::Odometry, &text, None).controllers().expect("parameters").text
    };
    let two = written(&(wheel("l", 0.1) + &wheel("r", -0.1)));
    assert!(two.contains("rear_wheels_names:\n    - r_joint\n    - l_joint\n"), "right first: {two}");
    assert!(two.contains("wheel_track: 0.2\n") && two.contains("front_wheels_radius: 0.0325\n"), "{two}");
    let one = written(&wheel("back", 0.0));
    assert!(one.contains("bicycle_steering_controller") && one.contains("rear_wheel_radius: 0.03\n"), "{one}");
}

#[test]
fn what_no_controller_has_is_one_clear_sentence() {
    let refused = |text: &str| robot(Kind::Odometry, text, None).controllers().unwrap_err().to_string();
    let text = built_in("omni-3").replace("place = [-0.195, 0]", "place = [-0.25, 0]");
    assert!(refused(&text).contains("'omni-3': no controller of ros2_controllers holds it"), "{}", refused(&text));
    let text = built_in("differential")
        .replace("name = \"right\"", "name = \"left side\"")
        .replace("\"left\"", "\"left_side\"");
    assert!(refused(&text).contains("would share a joint"), "{}", refused(&text));
}

#[test]
fn forecasts_of_the_verdict_become_covariances() {
    let mut diagnosis = corrected("differential").diagnosis.expect("a verdict");
    diagnosis.free_runs = hierarchical_fit::telling::free_runs("run", "counts alone", [2.0, 10.0, 30.0], |row, k| {
        let size = (1 + row) as f64 * 1e-3 * (1 + k) as f64;
        Some([1.177_41 * size, 0.674_49 * size].map(Some))
    });
    let robot = robot(Kind::Odometry, built_in("differential"), Some(diagnosis));
    let corrected = robot.controllers().expect("parameters").text;
    assert!(
        corrected.contains("is 3.00 mm and 3.00 mrad after 2 s and 9.00 mm and 9.00 mrad after 30 s"),
        "{corrected}"
    );
    // σ_v² = σ_p² f / T = 9e-6 · 50 / 2
    assert!(corrected.contains("twist_covariance_diagonal:\n    - 0.000225\n"), "{corrected}");
    assert!(corrected.contains("errors are larger"), "{corrected}");
    let nominal = robot.nominal().controllers().expect("parameters");
    assert!(nominal.text.contains("is 1.00 mm and 1.00 mrad after 2 s") && nominal.not_held.is_empty());
}

#[test]
fn a_verdict_that_did_not_keep_the_robot_file_is_refused_with_the_remedy() {
    let envelope =
        ColumnsEnvelope::new(Kind::Odometry, ["my.toml", CAR], &Default::default(), &[], Diagnosis::withheld());
    let mut json = serde_json::to_value(&envelope).expect("JSON");
    json.as_object_mut().expect("an object").remove("robot_file");
    let older: ColumnsEnvelope = serde_json::from_value(json).expect("older verdicts are read");
    let refused = ColumnsRobot::of_verdict("old.json", older).unwrap_err().to_string();
    assert!(refused.contains("did not keep the robot file in it: run `lacuna diagnose"), "{refused}");
}

#[test]
fn a_robot_of_any_wheels_has_the_corrected_numbers_and_says_what_has_no_key() {
    let (_, text) = wheeled::file::BUILT_IN[0];
    let tuning = [
        ("mass", 75.0),
        ("centre of mass, forward", 0.4),
        ("factor on the torque of front", 0.8),
        ("dry friction of front", 1.1),
        ("radius of front", 0.105),
        ("rolling resistance", 0.03),
        ("distances along the robot", 1.02),
        ("tracked point, left", 0.01),
        ("steering zero of front", 0.05),
        ("steering gain of front", 1.1),
        ("bias of the gyro", 0.01),
    ];
    let corrected = robot(Kind::Wheeled, text, Some(verdict(&tuning, &[("bias of the gyro", 0.01)])));
    let written = corrected.robot_file().expect("a file");
    let file = wheeled::file::RobotFile::parse("robot.toml", &written.text).expect("a robot");
    let plant = file.robot.plant;
    assert_eq!((plant.mass, plant.com[0], plant.ground.rolling), (75.0, 0.4, 0.03));
    let front = plant.wheels[0].expect("a wheel");
    assert_eq!((front.radius, front.place[0]), (0.105, 0.816));
    assert_eq!((plant.motors[0].expect("a motor").coulomb, file.columns.torque[0].1), (1.1, 0.8));
    assert_eq!((plant.joints[0].expect("a joint").place[0], file.robot.point[1]), (0.816, 0.01));
    assert!(written.text.contains("re-tuned by lacuna from 60"), "{}", written.text);
    approx::assert_relative_eq!(plant.joints[0].expect("a joint").offset, 0.05, max_relative = 1e-5);
    approx::assert_relative_eq!(file.columns.joints[0].1, 1.1, max_relative = 1e-9);
    assert!(
        written.not_held.iter().any(|s| s.contains("subtract it from the gyro's readings")),
        "{:?}",
        written.not_held
    );
    // As a model of a simulator: what a unit of the motor's column is, and the offset of the steering, are the actuators'.
    let model = corrected.model(Engine::Mjcf).expect("a model");
    assert!(
        model.text.contains("gainprm=\"0.8\"") && model.text.contains("mass: 75 kg, re-tuned from 60"),
        "{}",
        model.text
    );
    // 0.05 rad and 1.1 rad per unit at a servo of 1500 N m/rad.
    assert!(
        model.text.contains("gainprm=\"1650\"") && model.text.contains("biasprm=\"75 -1500 -30\""),
        "{}",
        model.text
    );
    assert!(model.not_held.iter().any(|s| s.contains("a model in MJCF cannot hold")), "{:?}", model.not_held);
    let refused = corrected.controllers().unwrap_err().to_string();
    assert!(refused.contains("driven by torques") && refused.contains("--to toml"), "{refused}");
}

#[test]
fn a_corrected_robot_of_any_wheels_reads_back_in_every_constant_that_its_file_can_hold() {
    use wheeled::Quantity as Q;
    for (name, text) in wheeled::file::BUILT_IN {
        let all = |text: &str| {
            let file = wheeled::file::RobotFile::parse("robot.toml", text).unwrap_or_else(|e| panic!("{name}: {e}"));
            wheeled::constants(&file.robot, true, true)
        };
        let stated = all(text);
        let off: Vec<(&str, f64)> = stated.iter().map(|c| (c.name.as_str(), 1.01 * c.given + 0.002)).collect();
        let written = robot(Kind::Wheeled, text, Some(verdict(&off, &[]))).robot_file().expect("a file");
        let corrected = all(&written.text);
        assert_eq!(corrected.len(), stated.len(), "{name}");
        for (constant, (_, wanted)) in corrected.iter().zip(&off) {
            match constant.quantity {
                // Factors are in the numbers that they scale, and what is of sensors and clocks has no key.
                Q::Gain(_)
                | Q::SteeringGain(_)
                | Q::Across
                | Q::Along
                | Q::Delay
                | Q::GyroScale
                | Q::GyroBias
                | Q::Clock => {}
                _ => approx::assert_relative_eq!(constant.given, *wanted, max_relative = 1e-6, epsilon = 1e-9),
            }
        }
        assert_eq!(written.text.matches("is that of the ground of these drives").count(), 1, "{}", written.text);
    }
}
