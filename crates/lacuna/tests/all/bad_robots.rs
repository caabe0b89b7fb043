//! Robot files that cannot be used: one message with file, line and key; exit code 1.

use crate::common::{Bench, ROBOT};

const FILE: &str = "case/robot.toml";

/// A case with another robot file.
fn bench(robot: &str) -> Bench {
    let bench = Bench::new();
    bench.write(FILE, robot);
    bench
}

/// A robot in the flat JSON form.
const FLAT: &str = r#"{
 "mass_kg": 22.0, "yaw_inertia_kg_m2": 1.0, "com_height_m": 0.12,
 "half_wheelbase_m": 0.18,
 "half_track_m": 0.22,
 "wheel_radius_m": 0.1,
 "wheel_inertia_kg_m2": 0.006,
 "motor_inertia_at_wheel_kg_m2_per_side": 0.024,
 "adhesion_coefficient": 0.6,
 "slip_ratio_at_peak_guess": 0.12,
 "rolling_resistance_coefficient": 0.02,
 "drivetrain_coulomb_Nm_per_side": 0.29,
 "drivetrain_viscous_Nms_per_rad_per_side": 0.11,
 "motor": {
  "current_loop_time_constant_s": 0.008,
  "torque_limit_Nm_per_side": 14.0
 },
 "relative_uncertainty_1sigma": {
  "mass_kg": 0.01
 },
 "sensors": {
  "pose_xy_std_m": 0.004
 }
}"#;

/// Identifies with the flat robot, changed.
fn flat(from: &str, to: &str) -> crate::common::Run {
    assert!(FLAT.contains(from));
    let bench = Bench::new();
    bench.write("flat.json", &FLAT.replacen(from, to, 1));
    bench.run(&["identify", "flat.json", "case/recordings/run_1.csv"])
}

#[test]
fn an_empty_file() {
    bench("\n").refuses(&[FILE, "the file is empty"]);
}

#[test]
fn no_toml() {
    bench(&ROBOT.replace("= 40.0, unit", "= 40.0 unit")).refuses(&[FILE, "line 5, column"]);
}

#[test]
fn an_unknown_key() {
    bench(&ROBOT.replace("adhesion =", "adhesoin =")).refuses(&[
        FILE,
        "line 12",
        "unknown key `adhesoin`",
        "`adhesion`?",
    ]);
    let inner = ROBOT.replace("track = { value", "track = { valu");
    bench(&inner).refuses(&[FILE, "line 9", "unknown key `valu`", "`value`?"]);
    bench(&format!("colour = \"red\"\n{ROBOT}")).refuses(&[FILE, "line 1", "unknown key `colour`"]);
}

#[test]
fn the_place_is_shown_with_a_mark_below_it() {
    let run = bench(&ROBOT.replace("adhesion =", "adhesoin =")).run(&["diagnose", "case"]);
    let expected = "\
error: case/robot.toml: line 12, column 1: unknown key `adhesoin`; did you mean `adhesion`?
  --> case/robot.toml:12:1
   |
12 | adhesoin = { value = 0.8, unit = \"-\", source = \"test\" }
   | ^^^^^^^^
";
    assert_eq!(run.err(), expected);
    let text = flat("0.22,", "\"wide\",").err();
    assert!(text.contains("\"half_track_m\": \"wide\"") && text.contains('^'), "{text}");
}

#[test]
fn an_unknown_causality() {
    bench(&ROBOT.replace("torque-driven", "torque")).refuses(&[FILE, "line 2", "`torque`", "torque-driven"]);
}

#[test]
fn a_wrong_unit() {
    bench(&ROBOT.replace("unit = \"mm\"", "unit = \"kg\"")).refuses(&[FILE, "line 7", "`com_height`", "`kg`", "`m`"]);
    bench(&ROBOT.replace("\"kg\"", "\"g\"")).refuses(&[FILE, "line 5", "`mass`", "unit `g`", "`kg`"]);
}

#[test]
fn a_missing_parameter() {
    let robot: Vec<&str> = ROBOT.lines().filter(|l| !l.starts_with("track")).collect();
    bench(&robot.join("\n")).refuses(&[FILE, "`track` is missing", "add `track ="]);
}

#[test]
fn a_negative_mass() {
    bench(&ROBOT.replace("40.0", "-40.0")).refuses(&[FILE, "line 5", "`mass`", "-40", "larger than zero"]);
    bench(&ROBOT.replace("0.35", "-0.35")).refuses(&[FILE, "line 8", "`wheelbase`", "larger than zero"]);
}

#[test]
fn what_is_wrong_is_said_once() {
    let run = bench(&ROBOT.replace("40.0", "-40.0")).run(&["diagnose", "case"]);
    let text = run.err();
    let said = "error: case/robot.toml: line 5, column 1: parameter `mass` is -40, but it must be larger than zero; correct it";
    assert_eq!(text.lines().next(), Some(said), "{text}");
    let text = flat("0.18", "-0.18").err();
    assert!(
        text.contains("parameter `half_wheelbase_m` is -0.18, but it must be larger than zero; correct it\n"),
        "{text}"
    );
}

#[test]
fn numbers_that_are_none() {
    bench(&ROBOT.replace("40.0", "nan")).refuses(&[FILE, "line 5", "`mass`", "finite"]);
    bench(&ROBOT.replace("40.0", "\"heavy\"")).refuses(&[FILE, "line 5", "heavy", "expected a number"]);
    bench(&ROBOT.replace("40.0,", "40.0, sigma = -1.0,")).refuses(&[FILE, "line 5", "sigma of `mass`", "-1"]);
}

#[test]
fn a_robot_that_is_not_there() {
    let bench = Bench::new();
    bench.run(&["diagnose", "case", "--robot", "husky"]).failed(&["'husky'", "did you mean `husky-a200`?"]);
    bench.run(&["diagnose", "case", "--robot", "my.toml"]).failed(&["no robot file 'my.toml'"]);
}

#[test]
fn the_flat_form_is_read() {
    let run = flat("22.0", "23.0");
    assert_eq!(run.code(), Some(0), "{}", run.err());
}

#[test]
fn an_unknown_key_in_the_flat_form() {
    let known = |key: &str| format!("did you mean `{key}`?");
    flat("half_track_m", "half_trak_m").failed(&["flat.json: line 4", "`half_trak_m`", &known("half_track_m")]);
    flat("mass_kg", "mas_kg").failed(&["flat.json: line 2", "`mas_kg`", &known("mass_kg")]);
    flat("torque_limit_Nm_per_side", "torque_limit_Nm").failed(&["flat.json: line 15", "`torque_limit_Nm`"]);
    flat("pose_xy_std_m", "pose_std_m").failed(&["flat.json: line 21", "`pose_std_m`"]);
    flat("\"mass_kg\": 0.01", "\"mas\": 0.01").failed(&["flat.json: line 18", "`mas`"]);
}

#[test]
fn bad_values_in_the_flat_form() {
    flat("22.0", "-22.0").failed(&["flat.json: line 2", "`mass_kg`", "-22", "larger than zero"]);
    flat("0.22,", "\"wide\",").failed(&["flat.json: line 4", "wide", "expected a number"]);
    flat(" \"wheel_radius_m\": 0.1,\n", "").failed(&["flat.json", "`wheel_radius_m` is missing"]);
    flat("0.22,", "0.22").failed(&["flat.json: line 5, column"]);
    flat("0.004", "-0.004").failed(&["flat.json: line", "sensors.pose_xy_std_m", "larger than zero"]);
}

#[test]
fn the_full_form_in_json_names_the_line_too() {
    let bench = Bench::new();
    let robot = "{ \"name\": \"x\",\n \"causality\": \"torque-driven\",\n \"parameters\": {\n  \"mas\": 3\n } }";
    bench.write("full.json", robot);
    let run = bench.run(&["identify", "full.json", "case/recordings/run_1.csv"]);
    run.failed(&["full.json: line 4", "unknown key `mas`", "did you mean `mass`?"]);
}
