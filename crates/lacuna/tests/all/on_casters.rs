//! Robots on two driven wheels and casters, from files to a verdict and on to a simulator.

use examiner::{Case, Content, EffectId, Setting, Settings, Severity, TyreLaw};
use serde_json::Value;

use crate::common::Bench;

const ROBOT: &str = r#"name = "on-casters"
causality = "torque-driven"
chassis = "differential"

[parameters]
mass = { value = 12.0, unit = "kg", source = "scale" }
yaw_inertia = { value = 0.3, unit = "kg m2", source = "CAD" }
com_x = { value = -0.03, unit = "m", source = "scales" }
com_height = { value = 0.1, unit = "m", source = "CAD" }
track = { value = 0.32, unit = "m", source = "tape" }
caster_x = { value = -0.18, unit = "m", source = "tape" }
wheel_radius = { value = 0.07, unit = "m", source = "tape" }
wheel_inertia = { value = 0.002, unit = "kg m2", source = "CAD" }
motor_inertia = { value = 0.01, unit = "kg m2", source = "data sheet" }
adhesion = { value = 0.7, unit = "-", source = "text book" }
rolling_resistance = { value = 0.02, unit = "-", source = "text book" }
coulomb = { value = 0.2, unit = "N m", source = "coasting down" }
"#;

/// Diagnoses with another robot file, which must be refused.
fn refused(robot: &str, parts: &[&str]) {
    let bench = Bench::new();
    bench.write("case/robot.toml", robot);
    bench.refuses(parts);
}

#[test]
fn a_file_that_no_such_robot_can_be_is_told_with_its_line_and_the_remedy() {
    let with = |from: &str, to: &str, parts: &[&str]| {
        assert!(ROBOT.contains(from));
        refused(&ROBOT.replacen(from, to, 1), parts);
    };
    with("\"differential\"", "\"tank\"", &["line 3", "known are: skid-steer, four-motors, differential"]);
    let wheelbase = "wheelbase = { value = 0.3, unit = \"m\", source = \"tape\" }\ncaster_x = {";
    with("caster_x = {", wheelbase, &["line 11", "a differential robot has no `wheelbase`"]);
    with("caster_x = { value = -0.18, unit = \"m\", source = \"tape\" }\n", "", &["`caster_x` is missing"]);
    with("-0.18", "-0.01", &["line 11", "does not hold the robot up"]);
    with("-0.03", "0.05", &["line 8", "between -0.18 and 0"]);
    with("chassis = \"differential\"\n", "", &["line 10", "write chassis = \"differential\""]);

    let belt = "\n[[effects]]\neffect = \"belt_loss\"\nside = \"left\"\nvalues = { T_b = 1.0 }\n";
    refused(
        &format!("{ROBOT}{belt}"),
        &[
            "effect `belt_loss` is of robots on four wheels only, those of a side coupled by a belt, and this one has chassis = \"differential\"",
        ],
    );
}

#[test]
fn casters_that_roll_hard_are_named_and_exported() {
    let settings = Settings {
        content: Content::Effects(vec![EffectId::CasterDrag]),
        severity: Some(Severity::Strong),
        setting: Some(Setting::Normal),
        law: Some(TyreLaw::Brush),
        casters: true,
        duration_s: 16.0,
        references: 2,
        recordings: Some(2),
        heldout: 0,
        ..Settings::default()
    };
    let drawn = Case::draw("x", 4, &settings).expect("a case");
    let bench = Bench::empty();
    for (path, bytes) in &drawn.files {
        bench.write(&format!("blind/{}", path.display()), std::str::from_utf8(bytes).expect("text"));
    }
    let run = bench.run(&["diagnose", "blind", "--json", "verdict.json"]);
    assert!(run.out().contains("casters that roll hard"), "{}{}", run.out(), run.err());
    let verdict: Value = serde_json::from_str(&bench.read("verdict.json")).expect("JSON");
    let leads = &verdict["diagnosis"]["ranked"][0];
    assert_eq!(leads["effect"], "caster_drag", "{verdict}");
    let true_size = drawn.truth.effects[0].magnitude;
    let size = leads["magnitude"].as_f64().expect("a size");
    assert!((size / true_size - 1.0).abs() < 0.3, "{size} for {true_size}");

    // The casters' spheres slide harder than before.
    for format in ["mjcf", "urdf", "sdf"] {
        let out = format!("robot.{format}");
        let run = bench.run(&["export", "verdict.json", "--to", format, "-o", &out]);
        assert_eq!(run.code(), Some(0), "{}", run.err());
        assert!(bench.read(&out).contains("caster_1"), "{format}");
    }
    let again = bench.run(&["robot", "robot.urdf", "--kind", "torque-driven", "-o", "again.toml"]);
    assert_eq!(again.code(), Some(0), "{}", again.err());
    assert!(bench.read("again.toml").contains("chassis = \"differential\""));
}
