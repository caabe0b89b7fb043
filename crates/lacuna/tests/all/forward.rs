//! `lacuna simulate` and `lacuna predict`: robot files forward.

use crate::common::{Bench, ROBOT, drive};
use examiner::{Case, Content, EffectId, Setting, Settings, Severity, TyreLaw};
use serde_json::Value;

#[test]
fn a_corrected_robot_file_predicts_what_the_diagnosis_predicted() {
    let settings = Settings {
        content: Content::Effects(vec![EffectId::Payload]),
        severity: Some(Severity::Strong),
        setting: Some(Setting::Normal),
        law: Some(TyreLaw::Brush),
        duration_s: 9.0,
        references: 2,
        recordings: Some(2),
        heldout: 1,
        ..Settings::default()
    };
    let drawn = Case::draw("x", 5, &settings).unwrap();
    let bench = Bench::empty();
    for (path, bytes) in &drawn.files {
        bench.write(&format!("case/{}", path.display()), std::str::from_utf8(bytes).unwrap());
    }
    let run = bench.run(&["diagnose", "case", "--json", "verdict.json", "--predictions", "by_diagnose"]);
    assert_eq!(run.code(), Some(0), "{}", run.err());
    let run = bench.run(&["export", "verdict.json", "--to", "toml", "-o", "corrected.toml"]);
    assert_eq!((run.code(), run.out()), (Some(0), String::new()), "{}", run.err());

    let run = bench.run(&["predict", "corrected.toml", "--drives", "case/heldout", "--out", "by_predict"]);
    assert_eq!(run.code(), Some(0), "{}", run.err());
    assert_eq!(bench.read("by_predict/held_1.csv"), bench.read("by_diagnose/held_1.csv"));

    // Its recordings never hold the whole state of the robot.
    bench.run(&["predict", "case/robot.json", "--drives", "case/recordings"]).failed(&["run_1", "state"]);
}

#[test]
fn simulate_shows_the_faults_of_sensors_that_a_robot_file_holds() {
    let bench = Bench::new();
    let simulated = |effects: &str| {
        bench.write("robot.toml", &format!("{ROBOT}\n{effects}"));
        let run = bench.run(&["simulate", "robot.toml", "case/recordings/run_1.csv"]);
        assert_eq!((run.code(), run.err().as_str()), (Some(0), ""));
        run.out()
    };
    let effect = |id: &str, value: &str| format!("[[effects]]\neffect = \"{id}\"\nvalues = {{ {value} }}\n");
    let ideal = simulated("");
    for (id, value) in [("gyro_bias", "b = 0.05"), ("clock_offset", "IMU = 0.1"), ("clock_drift", "IMU = 0.01")] {
        assert_ne!(simulated(&effect(id, value)), ideal, "{id} is not in the simulated drive");
    }
}

#[test]
fn exports_hold_the_effect_and_nothing_is_written_over() {
    let bench = Bench::new();
    let loaded = format!("{ROBOT}\n[[effects]]\neffect = \"payload\"\nvalues = {{ mass = 10.0 }}\n");
    bench.write("loaded.toml", &loaded);
    for (format, root) in [("mjcf", "<mujoco"), ("urdf", "<robot"), ("sdf", "<sdf")] {
        let run = bench.run(&["export", "loaded.toml", "--to", format]);
        assert_eq!(run.code(), Some(0), "{}", run.err());
        assert!(run.out().contains(root) && run.out().contains("payload"), "{}", run.out());
        let nominal = bench.run(&["export", "loaded.toml", "--to", format, "--nominal"]).out();
        assert!(!nominal.contains("payload"), "{nominal}");
    }
    let sticky = format!("{ROBOT}\n[[effects]]\neffect = \"stiction\"\nvalues = {{ Ts = 1.5 }}\n");
    bench.write("sticky.toml", &sticky);
    let run = bench.run(&["export", "sticky.toml", "--to", "mjcf", "-o", "robot.xml"]);
    assert!(run.code() == Some(0) && run.err().starts_with("warning: "), "{}", run.err());
    assert!(bench.read("robot_residual.py").contains("class Residual"));
    let run = bench.run(&["export", "sticky.toml", "--to", "mjcf", "-o", "robot.xml"]);
    assert!(run.code() == Some(2) && run.err().contains("--force"), "{}", run.err());
    bench.write("command.toml", &ROBOT.replace("torque-driven", "command-driven"));
    bench.run(&["export", "command.toml", "--to", "sdf"]).failed(&["command-driven", "--to toml or json"]);
}

#[test]
fn faults_of_encoders_and_clocks_show_in_a_simulated_drive() {
    let bench = Bench::new();
    let faults = "\n[[effects]]\neffect = \"encoder_slipped_index\"\nvalues = { jump = 0.5 }\nside = \"left\"\n\
        [[effects]]\neffect = \"clock_offset\"\nvalues = { IMU = 0.05 }\n";
    bench.write("faulty.toml", &format!("{ROBOT}{faults}"));
    let columns = |robot: &str| -> Value {
        let run = bench.run(&["simulate", robot, "case/recordings/run_1.csv", "--json", "-"]);
        assert_eq!(run.code(), Some(0), "{}", run.err());
        serde_json::from_str::<Value>(&run.out()).unwrap()["columns"].take()
    };
    let (plain, faulty) = (columns("case/robot.toml"), columns("faulty.toml"));
    let changed: Vec<&String> = plain
        .as_object()
        .unwrap()
        .iter()
        .filter(|(name, values)| faulty[*name] != **values)
        .map(|(name, _)| name)
        .collect();
    assert_eq!(changed, ["wheel_angle_left_rad", "gyro_z_rad_s", "accel_x_m_s2", "accel_y_m_s2"]);

    let command_driven = format!("{ROBOT}\n[[effects]]\neffect = \"payload\"\nvalues = {{ mass = 10.0 }}\n");
    bench.write("command.toml", &command_driven.replace("torque-driven", "command-driven"));
    bench.run(&["simulate", "command.toml", "case/recordings/run_1.csv"]).failed(&["`payload` cannot be applied"]);
}

#[test]
fn a_simulated_drive_is_a_recording_like_any_other() {
    let bench = Bench::new();
    let run = bench.run(&["simulate", "case/robot.toml", "case/recordings/run_1.csv", "-o", "sim/plain.csv"]);
    run.failed(&["cannot write 'sim/plain.csv'"]);
    let run = bench.run(&["simulate", "case/robot.toml", "case/recordings/run_1.csv", "-o", "plain.csv"]);
    assert_eq!((run.code(), run.out()), (Some(0), String::new()), "{}", run.err());
    assert_eq!(bench.read("plain.csv").lines().count(), 301);

    // What it shows is predicted exactly: every row holds the whole state, and nothing is missing.
    let run = bench.run(&["predict", "case/robot.toml", "--drives", "plain.csv", "--restart", "1", "--json", "-"]);
    let told: Value = serde_json::from_str(&run.out()).unwrap();
    let rms = &told["drives"][0]["of"][0]["rms"];
    assert!(rms["wheel speed, rad/s"].as_f64().unwrap() < 0.01, "{rms}");

    // With an effect in the robot file it is another drive.
    let with = format!("{ROBOT}\n[[effects]]\neffect = \"payload\"\nvalues = {{ mass = 10.0 }}\n");
    bench.write("loaded.toml", &with);
    let run = bench.run(&["predict", "case/robot.toml", "loaded.toml", "--drives", "plain.csv", "--restart", "1"]);
    assert_eq!(run.code(), Some(0), "{}", run.err());
    assert!(run.out().contains("loaded.toml"), "{}", run.out());
    let loaded = bench.run(&["simulate", "loaded.toml", "case/recordings/run_1.csv"]);
    assert!(loaded.out() != bench.read("plain.csv") && loaded.out().lines().count() == 301);
}

#[test]
fn a_speed_driven_robot_shows_the_torque_that_its_speeds_take() {
    let bench = Bench::new();
    bench.write("speed.toml", &ROBOT.replace("torque-driven", "speed-driven"));
    bench.write("run.csv", &drive(100, 0.2));
    let run = bench.run(&["simulate", "speed.toml", "run.csv", "--json", "-"]);
    let told: Value = serde_json::from_str(&run.out()).unwrap_or_else(|_| panic!("{}", run.err()));
    let torque = told["columns"]["torque_left_Nm"].as_array().unwrap();
    assert!(torque.len() == 100 && torque.iter().any(|t| t.as_f64().unwrap().abs() > 0.1));
}

#[test]
fn what_cannot_be_simulated_is_said() {
    let bench = Bench::new();
    let command_driven = ROBOT.replace("torque-driven", "command-driven");
    bench.write("command.toml", &command_driven);
    bench.run(&["simulate", "command.toml", "case/recordings/run_1.csv"]).failed(&["command_speed of both sides"]);
    bench.write("speed.toml", &ROBOT.replace("torque-driven", "speed-driven"));
    bench.run(&["predict", "speed.toml", "--drives", "case/recordings"]).failed(&["lacuna simulate"]);
    let two = ["predict", "speed.toml", "command.toml", "--drives", "case/recordings"];
    bench.run(&two).failed(&["compare robots of one kind"]);
    bench.write("response.toml", &format!("{command_driven}\n[response.constants]\ndead_tme = 0.1\n"));
    bench.run(&["simulate", "response.toml", "case/recordings/run_1.csv"]).failed(&["`dead_time`"]);
    bench
        .run(&["simulate", "case/robot.toml", "case/recordings/run_1.csv", "case/reference/ref_1.csv"])
        .failed(&["one recording at a time"]);
    bench.write("wrong.toml", &format!("{ROBOT}\n[[effects]]\neffect = \"paylod\"\nvalues = {{}}\n"));
    bench.run(&["simulate", "wrong.toml", "case/recordings/run_1.csv"]).failed(&["wrong.toml: line", "`payload`"]);
}

#[test]
fn a_robot_file_is_fitted_to_the_logs_of_a_simulator() {
    let settings = Settings {
        content: Content::Effects(vec![]),
        setting: Some(Setting::Normal),
        duration_s: 16.0,
        references: 2,
        recordings: Some(2),
        heldout: 1,
        ..Settings::default()
    };
    let drawn = Case::draw("x", 5, &settings).unwrap();
    let bench = Bench::empty();
    for (path, bytes) in &drawn.files {
        bench.write(&format!("case/{}", path.display()), std::str::from_utf8(bytes).unwrap());
    }
    // The simulator is the robot file of the case, which the command does not see.
    for run in ["run_1", "run_2"] {
        let inputs = format!("case/recordings/{run}.csv");
        let out = bench.run(&["simulate", "case/robot.json", &inputs, "-o", &format!("logs_{run}.csv")]);
        assert_eq!(out.code(), Some(0), "{}", out.err());
    }
    let robot: Value = serde_json::from_str(&bench.read("case/robot.json")).unwrap();
    let given = |flag: &str, pointer: &str, factor: f64| {
        let value = robot.pointer(pointer).and_then(Value::as_f64).unwrap_or_else(|| panic!("{pointer} in {robot}"));
        [flag.to_owned(), format!("{}", factor * value)]
    };
    let size = [
        given("--mass", "/mass_kg", 1.0),
        given("--wheel-radius", "/wheel_radius_m", 1.0),
        given("--track", "/half_track_m", 2.0),
        given("--wheelbase", "/half_wheelbase_m", 2.0),
    ]
    .concat();
    let mut args = vec!["robot", "--from-logs", "logs_run_1.csv", "logs_run_2.csv", "-o", "fitted.toml"];
    args.extend(size.iter().map(String::as_str));
    let run = bench.run(&args);
    assert_eq!(run.code(), Some(0), "{}", run.err());
    assert!(run.out().contains("rolling_resistance") && bench.read("fitted.toml").contains("fitted to the logs"));

    // What it forecasts of a drive that no fit saw is what the simulator does.
    let held_out = ["simulate", "fitted.toml", "case/heldout/held_1.csv"];
    assert_eq!(bench.run(&held_out).code(), Some(0));

    let run = bench.run(&["robot", "--from-logs", "logs_run_1.csv", "--mass", "20"]);
    assert_eq!(run.code(), Some(2));
    assert!(run.err().contains("--wheel-radius") && run.err().contains("--like"), "{}", run.err());
    bench.run(&["robot", "--from-logs", "logs_run_1.csv", "--like", "husky-a200"]).failed(&["speed-driven"]);
    let mut wrong = args.clone();
    let radius = args.iter().position(|a| *a == "--wheel-radius").unwrap();
    wrong[radius + 1] = "0.4";
    bench.run(&wrong).failed(&["does not behave like the logs", "check wheel radius"]);
}
