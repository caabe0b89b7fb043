use std::f64::consts::FRAC_PI_4;

use approx::assert_relative_eq;
use serde_yaml_ng::Value;

use super::*;

/// Type of a parameter, as ROS 2 tells them apart.
#[derive(Clone, Copy)]
enum Type {
    Bool,
    Double,
    Text,
    Texts,
    Doubles(usize),
    Bools(usize),
}

/// Names and types of ros2_controllers 4.x (Jazzy), of their managers, and of robot_localization.
const SCHEMA: &[(&str, &[(&str, Type)])] = &[
    (
        "diff_drive_controller",
        &[
            ("left_wheel_names", Type::Texts),
            ("right_wheel_names", Type::Texts),
            ("wheel_separation", Type::Double),
            ("wheel_radius", Type::Double),
            ("wheel_separation_multiplier", Type::Double),
            ("left_wheel_radius_multiplier", Type::Double),
            ("right_wheel_radius_multiplier", Type::Double),
            ("pose_covariance_diagonal", Type::Doubles(6)),
            ("twist_covariance_diagonal", Type::Doubles(6)),
        ],
    ),
    (
        "tricycle_controller",
        &[
            ("traction_joint_name", Type::Text),
            ("steering_joint_name", Type::Text),
            ("wheelbase", Type::Double),
            ("wheel_radius", Type::Double),
            ("pose_covariance_diagonal", Type::Doubles(6)),
            ("twist_covariance_diagonal", Type::Doubles(6)),
        ],
    ),
    (
        "tricycle_steering_controller",
        &[
            ("front_steering", Type::Bool),
            ("rear_wheels_names", Type::Texts),
            ("front_wheels_names", Type::Texts),
            ("wheel_track", Type::Double),
            ("wheelbase", Type::Double),
            ("front_wheels_radius", Type::Double),
            ("rear_wheels_radius", Type::Double),
            ("pose_covariance_diagonal", Type::Doubles(6)),
            ("twist_covariance_diagonal", Type::Doubles(6)),
        ],
    ),
    (
        "bicycle_steering_controller",
        &[
            ("front_steering", Type::Bool),
            ("rear_wheels_names", Type::Texts),
            ("front_wheels_names", Type::Texts),
            ("wheelbase", Type::Double),
            ("front_wheel_radius", Type::Double),
            ("rear_wheel_radius", Type::Double),
            ("pose_covariance_diagonal", Type::Doubles(6)),
            ("twist_covariance_diagonal", Type::Doubles(6)),
        ],
    ),
    (
        "mecanum_drive_controller",
        &[
            ("front_left_wheel_command_joint_name", Type::Text),
            ("front_right_wheel_command_joint_name", Type::Text),
            ("rear_left_wheel_command_joint_name", Type::Text),
            ("rear_right_wheel_command_joint_name", Type::Text),
            ("kinematics.wheels_radius", Type::Double),
            ("kinematics.sum_of_robot_center_projection_on_X_Y_axis", Type::Double),
            ("pose_covariance_diagonal", Type::Doubles(6)),
            ("twist_covariance_diagonal", Type::Doubles(6)),
        ],
    ),
    (
        "omni_wheel_drive_controller",
        &[
            ("wheel_names", Type::Texts),
            ("robot_radius", Type::Double),
            ("wheel_radius", Type::Double),
            ("wheel_offset", Type::Double),
            ("diagonal_covariance.pose", Type::Doubles(6)),
            ("diagonal_covariance.twist", Type::Doubles(6)),
        ],
    ),
    ("ekf_filter_node", &[("two_d_mode", Type::Bool), ("odom0", Type::Text), ("odom0_config", Type::Bools(15))]),
];

/// Names with points, as ROS 2 has those of nested parameters.
fn flat(value: &Value, name: &str, out: &mut Vec<(String, Value)>) {
    match value {
        Value::Mapping(inside) => {
            for (key, value) in inside {
                let key = key.as_str().expect("a name");
                flat(value, &if name.is_empty() { key.to_owned() } else { format!("{name}.{key}") }, out);
            }
        }
        other => out.push((name.to_owned(), other.clone())),
    }
}

fn is_double(value: &Value) -> bool {
    value.as_f64().is_some_and(f64::is_finite) && !value.is_i64() && !value.is_u64()
}

fn fits(value: &Value, of: Type) -> bool {
    let all = |is: fn(&Value) -> bool, count: Option<usize>| {
        value.as_sequence().is_some_and(|s| count.is_none_or(|n| s.len() == n) && !s.is_empty() && s.iter().all(is))
    };
    match of {
        Type::Bool => value.is_bool(),
        Type::Double => is_double(value),
        Type::Text => value.is_string(),
        Type::Texts => all(Value::is_string, None),
        Type::Doubles(count) => all(is_double, Some(count)),
        Type::Bools(count) => all(Value::is_bool, Some(count)),
    }
}

/// Reads a file back, and refuses what the schema does not have.
fn checked(controllers: &Controllers) -> Value {
    let text = controllers.yaml().expect("YAML");
    let file: Value = serde_yaml_ng::from_str(&text).expect("YAML that reads back");
    let name = controllers.geometry.controller();
    let plugin = &file["controller_manager"]["ros__parameters"][name]["type"];
    assert!(plugin.as_str().is_some_and(|p| p.starts_with(&format!("{name}/"))), "{text}");
    assert_eq!(file.as_mapping().map(serde_yaml_ng::Mapping::len), Some(3), "{text}");
    for node in [name, "ekf_filter_node"] {
        let (_, schema) = SCHEMA.iter().find(|s| s.0 == node).expect("a schema");
        let mut parameters = Vec::new();
        flat(&file[node]["ros__parameters"], "", &mut parameters);
        for (key, value) in &parameters {
            let (_, of) = schema.iter().find(|s| s.0 == key).unwrap_or_else(|| panic!("{node} has no {key}"));
            assert!(fits(value, *of), "{node}: {key} is {value:?}");
        }
        let complete = controllers.scatter.is_some();
        assert!(!complete || parameters.len() == schema.len(), "{node} lacks parameters: {text}");
    }
    // PyYAML, with which launch files are read, takes numbers like 2e-6 for a text.
    for line in text.lines().filter(|line| !line.starts_with('#') && line.contains("e-")) {
        let last = line.split_whitespace().last().unwrap_or_default();
        assert!(last.parse::<f64>().is_err() || last.contains('.'), "{line}");
    }
    file[name]["ros__parameters"].clone()
}

fn length(stated: f64, corrected: f64) -> Length {
    Length { stated, corrected }
}

fn joints<const N: usize>(names: [&str; N]) -> [String; N] {
    names.map(|name| format!("{name}_joint"))
}

fn differential() -> Geometry {
    let side = |name: &str, corrected| Side { joints: joints([name]).to_vec(), radius: length(0.05, corrected) };
    Geometry::Differential { left: side("left", 0.05), right: side("right", 0.0525), separation: length(0.3, 0.309) }
}

fn geometries() -> Vec<Geometry> {
    let front = || "front_steering_joint".to_owned();
    vec![
        differential(),
        Geometry::DriveAndSteer {
            traction: "front_joint".to_owned(),
            steering: front(),
            wheelbase: length(0.15, 0.147),
            radius: length(0.0325, 0.033),
        },
        Geometry::Tricycle {
            rear: joints(["left", "right"]).to_vec(),
            steering: front(),
            track: length(0.6, 0.6),
            wheelbase: length(1.0, 1.02),
            front_radius: length(0.1, 0.1),
            rear_radius: length(0.1, 0.11),
        },
        Geometry::Bicycle {
            rear: "rear_joint".to_owned(),
            steering: front(),
            wheelbase: length(0.26, 0.25),
            radii: Some([length(0.033, 0.033); 2]),
        },
        Geometry::Mecanum {
            joints: joints(["front_left", "front_right", "rear_left", "rear_right"]),
            radius: length(0.03, 0.031),
            reach: length(0.2, 0.21),
        },
        Geometry::Omni {
            joints: joints(["wheel_1", "wheel_2", "wheel_3"]).to_vec(),
            radius: length(0.051, 0.05),
            reach: length(0.195, 0.19),
            offset: -FRAC_PI_4,
        },
    ]
}

fn of(geometry: Geometry, scatter: Option<Scatter>) -> Controllers {
    let not_held = vec!["rate of the clocks is 0.00135: correct the time stamps of the counts by it.".to_owned()];
    Controllers { robot: "cart".to_owned(), geometry, scatter, told: Vec::new(), not_held }
}

fn scatter() -> Scatter {
    let forecast = |after, position, heading| Forecast { after, position, heading };
    Scatter { short: forecast(2.0, 1e-3, 2e-3), long: forecast(30.0, 5e-3, 1e-2), drives: 3 }
}

#[test]
fn every_file_holds_parameters_of_its_controller_alone() {
    for geometry in geometries() {
        checked(&of(geometry.clone(), Some(scatter())));
        let without = checked(&of(geometry, None));
        assert!(without.get("twist_covariance_diagonal").is_none() && without.get("diagonal_covariance").is_none());
    }
}

#[test]
fn corrections_are_multipliers_where_the_controller_has_them() {
    let read = checked(&of(differential(), None));
    let number = |key: &str| read[key].as_f64().expect("a number");
    assert_eq!((number("wheel_separation"), number("wheel_radius")), (0.3, 0.05));
    assert_relative_eq!(number("wheel_separation_multiplier"), 1.03, epsilon = 1e-12);
    assert_relative_eq!(number("left_wheel_radius_multiplier"), 1.0, epsilon = 1e-12);
    assert_relative_eq!(number("right_wheel_radius_multiplier"), 1.05, epsilon = 1e-12);

    let tricycle = checked(&of(geometries().swap_remove(1), None));
    assert_eq!((tricycle["wheelbase"].as_f64(), tricycle["wheel_radius"].as_f64()), (Some(0.147), Some(0.033)));
}

#[test]
fn noise_that_is_white_from_sample_to_sample_adds_up_to_the_errors_of_forecasts() {
    let read = checked(&of(differential(), Some(scatter())));
    let twist = |k: usize| read["twist_covariance_diagonal"][k].as_f64().expect("a number");
    let (rate, after) = (50.0, 2.0);
    // 100 errors of a velocity, each for 0.02 s.
    let adds_up = |variance: f64| (rate * after * variance / (rate * rate)).sqrt();
    assert_relative_eq!(adds_up(twist(0)), 1e-3, max_relative = 1e-5);
    assert_relative_eq!(adds_up(twist(5)), 2e-3, max_relative = 1e-5);
    assert_eq!([1, 2, 3, 4].map(twist), [1e6; 4], "no wheel of a differential drive tells these");
    assert_relative_eq!(read["pose_covariance_diagonal"][5].as_f64().expect("a number"), 1e-4, max_relative = 1e-5);

    let mecanum = checked(&of(geometries().swap_remove(4), Some(scatter())));
    assert_eq!(mecanum["twist_covariance_diagonal"][0], mecanum["twist_covariance_diagonal"][1]);
}

#[test]
fn comments_say_what_changed_and_what_is_not_held() {
    let text = of(differential(), None).yaml().expect("YAML");
    for part in [
        "# wheel_separation: re-tuned by lacuna from 0.3 to 0.309 m.",
        "# wheel_radius of the right side: re-tuned by lacuna from 0.05 to 0.0525 m.",
        "# Not held by diff_drive_controller:\n# - rate of the clocks is 0.00135",
        "# Covariances are left out",
    ] {
        assert!(text.contains(part), "no `{part}` in\n{text}");
    }
    assert!(!text.contains("left side: re-tuned"), "{text}");
}
