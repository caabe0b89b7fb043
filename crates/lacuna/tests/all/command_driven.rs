//! `lacuna diagnose` for robots of which command, wheel speed and heading are recorded, and nothing else.

use std::fmt::Write as _;

use crate::common::Bench;
use serde_json::Value;

/// Steps of the command at 20 Hz; wheels follow with a lag of 0.3 s and the body turns on twice the track.
fn steps(count: u32, phase: f64) -> String {
    let mut out = String::from(
        "time_s,command_speed_left_rad_s,command_speed_right_rad_s,wheel_speed_left_rad_s,wheel_speed_right_rad_s,\
         pose_yaw_rad\n",
    );
    let (mut wheel, mut yaw) = ([0.0_f64; 2], 0.0);
    for k in 0..count * 100 {
        let step = f64::from(k / 100) + phase;
        let command = [4.0 * (1.7 * step).sin(), 4.0 * (2.9 * step).cos()];
        // Roughness that repeats nowhere: an encoder's last digits.
        let rough = |s: f64| 0.05 * (f64::from(k) * 7.3 + s).sin();
        let t = f64::from(k) * 0.05;
        let shown = [wheel[0] + rough(0.0), wheel[1] + rough(1.0)];
        writeln!(out, "{t:.2},{:.4},{:.4},{:.4},{:.4},{yaw:.5}", command[0], command[1], shown[0], shown[1]).unwrap();
        for s in 0..2 {
            wheel[s] += (1.0 - (-0.05_f64 / 0.3).exp()) * (command[s] - wheel[s]);
        }
        yaw += 0.05 * 0.1 * (wheel[1] - wheel[0]) / 0.8;
    }
    out
}

fn bench() -> Bench {
    let bench = Bench::empty();
    bench.write("case/robot.toml", &crate::common::ROBOT.replace("torque-driven", "command-driven"));
    bench.write("case/recordings/run_1.csv", &steps(20, 0.0));
    bench.write("case/heldout/run_2.csv", &steps(6, 0.5));
    bench
}

#[test]
fn a_response_is_reported_without_any_reference() {
    let bench = bench();
    let run = bench.run(&["diagnose", "case", "--json", "out.json"]);
    assert_eq!(run.code(), Some(0), "{}", run.err());
    for part in ["do not do what is commanded", "effective track", "Response (", "held out"] {
        assert!(run.out().contains(part), "no `{part}` in {}", run.out());
    }
    let json: Value = serde_json::from_str(&bench.read("out.json")).unwrap();
    assert_eq!(json["robot"]["causality"], "command-driven");
    crate::common::reads_back(&bench.read("out.json"));
    let parameters = json["diagnosis"]["response"]["parameters"].as_array().unwrap();
    let value = |id: &str| parameters.iter().find(|p| p["id"] == id).and_then(|p| p["value"].as_f64());
    assert!(value("lag").is_some_and(|v| (v - 0.3).abs() < 0.03), "{parameters:?}");
    assert!(value("track_factor").is_some_and(|v| (v - 2.0).abs() < 0.1), "{parameters:?}");
    assert_eq!(json["diagnosis"]["response"]["held_out_windows"], 15);
    let trace = &json["diagnosis"]["traces"][0];
    let signals: Vec<&str> =
        trace["channels"].as_array().unwrap().iter().map(|c| c["signal"].as_str().unwrap()).collect();
    assert_eq!(signals, ["left wheel speed", "right wheel speed", "heading"]);

    // The corrected robot file forecasts what the diagnosis says that it forecasts.
    let envelope = case_files::envelope::Envelope::open(&bench.path("out.json")).unwrap();
    let corrected = envelope.robot().unwrap().corrected(&envelope.diagnosis.correction).unwrap();
    bench.write("corrected.toml", &corrected.to_toml().unwrap());
    let args = ["predict", "case/robot.toml", "corrected.toml", "--drives", "case/heldout", "--json", "-"];
    let told: Value = serde_json::from_str(&bench.run(&args).out()).unwrap();
    let free_runs = json["diagnosis"]["free_runs"].as_array().unwrap();
    for (quantity, rms) in [("wheel speed, rad/s", "wheel speed (rms), rad/s"), ("yaw, rad", "yaw (rms), rad")] {
        let found = free_runs.iter().find(|f| f["recording"] == "held out" && f["quantity"] == rms).unwrap();
        for (robot, column) in ["nominal", "corrected"].into_iter().enumerate() {
            assert_eq!(told["drives"][0]["of"][robot]["rms"][quantity], found[column], "{quantity} {column}");
        }
    }
    let run = bench.run(&["simulate", "corrected.toml", "case/heldout/run_2.csv"]);
    assert_eq!((run.code(), run.out().lines().count()), (Some(0), 601), "{}", run.err());
}

#[test]
fn a_rehearsal_drives_the_commands_again_and_counts_whole_diagnoses() {
    let bench = bench();
    let asked = ["--effects", "transport_delay,rolling_radius", "--size", "2", "--replicas", "1", "--fault-free", "1"];
    let run = bench.run(&[&["rehearse", "case", "--json", "r.json", "--html", "r.html"], &asked[..]].concat());
    assert_eq!(run.code(), Some(0), "{}", run.err());
    for told in ["of 1 replicas", "transport_delay", "rolling_radius: it changes nothing", "there is no reference"] {
        assert!(run.out().contains(told), "no `{told}` in {}", run.out());
    }
    let json: Value = serde_json::from_str(&bench.read("r.json")).unwrap();
    let size = &json["rehearsal"]["effects"][0]["sizes"][0];
    assert_eq!((&size["size"], &size["answers"]["first"]), (&0.2.into(), &1.into()), "{}", run.out());
    assert!(bench.read("r.html").contains("Rehearsal"));
    let refused = bench.run(&["rehearse", "case", "--seconds", "5"]);
    assert!(refused.code() == Some(2) && refused.err().contains("whole drives are taken"), "{}", refused.err());
}

#[test]
fn the_page_is_the_same_at_once_and_from_the_json() {
    let bench = bench();
    let run = bench.run(&["diagnose", "case", "--json", "out.json", "--report", "page.html"]);
    assert_eq!(run.code(), Some(0), "{}", run.err());
    let page = bench.read("page.html");
    assert!(page.starts_with("<!doctype html>") && page.contains("effective track") && page.contains("SHA-256"));
    let run = bench.run(&["report", "out.json", "-o", "again.html"]);
    assert_eq!((run.code(), run.out()), (Some(0), String::new()), "{}", run.err());
    assert!(bench.read("again.html") == page, "another page");
    assert!(bench.run(&["report", "out.json", "-o", "-"]).out() == page, "another page");
    bench.write("cut.json", &bench.read("out.json")[..2000]);
    bench.run(&["report", "cut.json", "-o", "-"]).failed(&["cut.json", "line", "lacuna diagnose --json"]);
    bench.run(&["report", "absent.json", "-o", "-"]).failed(&["absent.json"]);
}

#[test]
fn what_another_kind_of_robot_needs_is_named() {
    let bench = bench();
    bench.write("torque.toml", crate::common::ROBOT);
    let run = bench.run(&["diagnose", "--robot", "torque.toml", "--recordings", "case/recordings"]);
    run.failed(&["run_1.csv", "no signal torque_left", "map a column to it"]);
}

#[test]
fn what_a_recording_lacks_is_named() {
    let bench = bench();
    let text = steps(20, 0.0).replace("command_speed_left_rad_s", "asked");
    bench.write("case/recordings/run_1.csv", &text);
    bench.refuses(&["run_1.csv", "command_speed"]);
    bench.write("case/recordings/run_1.csv", &steps(3, 0.0));
    bench.refuses(&["recordings hold 3 command steps", "10 are needed"]);
}
