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

    // Recordings never hold the velocity of the body: states are those that a diagnosis starts from.
    let run =
        bench.run(&["predict", "case/robot.json", "corrected.toml", "--drives", "case/recordings", "--json", "-"]);
    let json: Value = serde_json::from_str(&run.out()).unwrap();
    assert_eq!(run.code(), Some(0), "{}", run.err());
    let [stated, corrected] =
        [0, 1].map(|k| json["drives"][0]["of"][k]["rms"]["wheel speed, rad/s"].as_f64().expect("an error"));
    assert!(corrected < 0.5 * stated && corrected > 0.0, "{corrected} after {stated}");
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

/// Two wheels on one axle, and a ball that slides along.
const CART: &str = r#"<robot name="cart">
  <link name="base_link"/>
  <link name="ball"><collision><origin xyz="-0.1 0 0.02"/><geometry><sphere radius="0.02"/></geometry></collision></link>
  <joint name="ball" type="fixed"><parent link="base_link"/><child link="ball"/></joint>
  <link name="left"><collision><origin rpy="1.5707963 0 0"/><geometry><cylinder radius="0.04" length="0.02"/></geometry></collision></link>
  <link name="right"><collision><origin rpy="1.5707963 0 0"/><geometry><cylinder radius="0.04" length="0.02"/></geometry></collision></link>
  <joint name="left_wheel" type="continuous"><parent link="base_link"/><child link="left"/><origin xyz="0 0.1 0.04"/><axis xyz="0 1 0"/></joint>
  <joint name="right_wheel" type="continuous"><parent link="base_link"/><child link="right"/><origin xyz="0 -0.1 0.04"/><axis xyz="0 1 0"/></joint>
</robot>
"#;

#[test]
fn from_a_model_to_the_first_verdict_in_three_commands() {
    let bench = Bench::empty();
    bench.write("cart.urdf", CART);
    let run = bench.run(&["robot", "cart.urdf", "-o", "cart.toml"]);
    assert_eq!(run.code(), Some(0), "{}", run.err());
    let told = run.out();
    assert!(told.contains("a differential drive") && told.contains("URDF: joint left_wheel"), "{told}");
    assert!(told.contains("spheres that slide along the ground were left out: ball"), "{told}");

    // Drives whose right wheel is 5 % larger than the model says: angles of the wheels beside the pose that follows.
    let drive = |turn: f64| {
        use std::fmt::Write as _;
        let mut text = String::from("time_s,left_wheel,right_wheel,x_m,y_m,yaw_rad\n");
        let ([mut x, mut y, mut yaw], mut angle) = ([0.0; 3], [0.0; 2]);
        for k in 0..1200 {
            let t = 0.05 * f64::from(k);
            writeln!(text, "{t:.2},{:.6},{:.6},{x:.6},{y:.6},{yaw:.6}", angle[0], angle[1]).unwrap();
            let speed = [6.0 + turn * (0.4 * t).sin(), 6.0 - turn * (0.4 * t).sin() + 0.3 * (0.15 * t).cos()];
            let [left, right] = [0.04 * speed[0] * 0.05, 0.042 * speed[1] * 0.05];
            let (length, change) = (0.5 * (left + right), (right - left) / 0.2);
            x += length * (yaw + 0.5 * change).cos();
            y += length * (yaw + 0.5 * change).sin();
            yaw += change;
            angle = [angle[0] + 0.05 * speed[0], angle[1] + 0.05 * speed[1]];
        }
        text
    };
    bench.write("drives/one.csv", &drive(1.5));
    bench.write("drives/two.csv", &drive(-2.0));
    let run = bench.run(&["diagnose", "--robot", "cart.toml", "--recordings", "drives", "--json", "verdict.json"]);
    assert_eq!(run.code(), Some(0), "{}", run.err());
    let verdict: Value = serde_json::from_str(&bench.read("verdict.json")).unwrap();
    let said = verdict["diagnosis"].to_string();
    assert!(said.contains("radius of right") && said.contains("radius_of_one_wheel"), "{said}");
    let run = bench.run(&["report", "verdict.json", "-o", "page.html"]);
    assert_eq!(run.code(), Some(0), "{}", run.err());
}

#[test]
fn a_model_that_no_robot_file_can_be_made_of_is_refused_with_the_remedy() {
    let bench = Bench::empty();
    bench.write("cart.urdf", CART);
    bench.run(&["robot", "cart.urdf", "--kind", "torque-driven"]).failed(&["--kind odometry", "no link states a mass"]);
    bench.write("alone.urdf", &CART.lines().filter(|line| !line.contains("ball")).collect::<Vec<_>>().join("\n"));
    let alone = bench.run(&["robot", "alone.urdf", "--kind", "torque-driven"]);
    alone.failed(&["2 wheels and 0 casters", "four fixed wheels, two on each side, or two and one or two casters"]);
    bench.run(&["robot", "cart.urdf", "--kind", "car"]).failed(&["one steered and one fixed axle"]);
    bench.run(&["robot", "cart.urdf", "--from-logs", "none.csv"]).failed(&["leave out --from-logs"]);
    bench.run(&["robot", "none.urdf"]).failed(&["cannot read 'none.urdf'", "URDF, SDF or MJCF"]);
    bench.write("broken.urdf", &CART.replace("xyz=\"0 1 0\"", "xyz=\"0 1\""));
    bench.run(&["robot", "broken.urdf"]).failed(&["broken.urdf: line 7", "xyz holds 2 numbers, but 3 belong there"]);
    assert_eq!(bench.run(&["robot"]).code(), Some(2));
}
