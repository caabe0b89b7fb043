//! `lacuna diagnose` from files to a verdict, on a case of the blind examiner.

use std::path::Path;

use crate::common::Bench;
use examiner::{Case, Content, DrawnCase, EffectId, Setting, Settings, Severity, TyreLaw};
use serde_json::Value;

/// A short drive with a strong effect: what it is named is not the question here.
fn drawn() -> DrawnCase {
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
    Case::draw("x", 5, &settings).unwrap()
}

fn bench(drawn: &DrawnCase) -> Bench {
    let bench = Bench::empty();
    for (path, bytes) in &drawn.files {
        bench.write(&format!("blind/{}", path.display()), std::str::from_utf8(bytes).unwrap());
    }
    bench
}

#[test]
fn a_case_folder_becomes_a_verdict_json_and_predictions() {
    let drawn = drawn();
    let bench = bench(&drawn);
    let args = ["diagnose", "blind", "--json", "out.json", "--predictions", "predicted", "--mcap", "out.mcap", "-v"];
    let run = bench.run(&[&args[..], &["--fail-on", "mismatch"]].concat());
    // A payload that the simulation does not know.
    assert_eq!(run.code(), Some(4), "{}", run.err());
    // Every stage says how far the work is.
    assert!(run.err().lines().count() > 5 && run.err().lines().all(|line| line.starts_with('[')), "{}", run.err());
    assert!(run.out().contains("mass") || run.out().contains("payload"), "{}", run.out());

    let json: Value = serde_json::from_str(&bench.read("out.json")).unwrap();
    for key in ["format", "program", "robot", "mapping", "options", "sources", "lost", "losses", "diagnosis"] {
        assert!(json.get(key).is_some(), "no `{key}`");
    }
    assert_eq!(json["lost"].as_array().map(Vec::len), Some(0));
    assert_eq!(json["robot"]["causality"], "torque-driven");
    assert_eq!(json["sources"]["recordings"].as_array().map(Vec::len), Some(2));
    crate::common::reads_back(&bench.read("out.json"));
    let d = &json["diagnosis"];
    let trace = &d["traces"][0];
    assert_eq!((&trace["recording"], &trace["left_out"]), (&"run_1".into(), &true.into()));
    let signals: Vec<&str> =
        trace["channels"].as_array().unwrap().iter().map(|c| c["signal"].as_str().unwrap()).collect();
    assert_eq!(signals[..3], ["left wheel speed", "right wheel speed", "yaw rate"]);
    let windows = trace["time"].as_array().unwrap().len();
    for series in ["recorded", "nominal", "retuned", "corrected"] {
        assert_eq!(trace["channels"][0][series].as_array().unwrap().len(), windows, "{series}");
    }
    for key in [
        "format",
        "verdict",
        "sentences",
        "ranked",
        "indistinguishable",
        "findings",
        "cells",
        "free_runs",
        "limits",
        "trials",
        "costs",
        "tuning",
    ] {
        assert!(d.get(key).is_some(), "no `diagnosis.{key}`");
    }
    let ranked = d["ranked"].as_array().unwrap();
    let sum: f64 = ranked.iter().map(|c| c["probability"].as_f64().unwrap()).sum();
    assert!(sum > 0.99, "{ranked:?}");
    for id in ["none", "unknown"] {
        assert!(ranked.iter().any(|c| c["effect"] == id), "{ranked:?}");
    }

    let layout: Value = serde_json::from_str(&bench.read("out.layout.json")).unwrap();
    let tabs = layout["configById"]["Tab!recordings"]["tabs"].as_array();
    let traces = d["traces"].as_array().map(Vec::len);
    assert_eq!(tabs.map(Vec::len), traces);
    let check = bench.run(&["check", "out.mcap", "--json", "-"]);
    let inside: Value = serde_json::from_str(&check.out()).unwrap();
    let topics = inside["bags"][0]["topics"].as_array().unwrap();
    assert!(topics.iter().any(|t| t["name"] == "/verdict" && t["type"] == "foxglove.Log"), "{topics:?}");

    // A row of prediction for each row of input, with and without the effect.
    let inputs = bench.read("blind/heldout/held_1.csv").lines().count();
    for file in ["predicted/held_1.csv", "predicted/held_1.nominal.csv"] {
        let text = bench.read(file);
        assert_eq!(text.lines().next(), Some("time_s,wheel_speed_left_rad_s,wheel_speed_right_rad_s,yaw_rate_rad_s"));
        assert_eq!(text.lines().count(), inputs);
        assert!(text.lines().skip(1).all(|l| l.split(',').all(|c| c.parse::<f64>().is_ok_and(f64::is_finite))));
    }
    assert_ne!(bench.read("predicted/held_1.csv"), bench.read("predicted/held_1.nominal.csv"));
}

#[test]
fn flags_say_the_same_as_a_folder_and_lost_input_exits_with_3() {
    let bench = bench(&drawn());
    bench.remove("blind/heldout");
    let by_folder = bench.run(&["diagnose", "blind", "--json", "-"]);
    assert_eq!(by_folder.code(), Some(0), "{}", by_folder.err());
    let cut_short = bench.read("blind/recordings/run_1.csv").replace("\n1.00,", "\n1.00,1,");
    bench.write("blind/recordings/run_1.csv", &cut_short);
    let flags = [
        "diagnose",
        "--robot",
        "blind/robot.json",
        "--reference",
        "blind/reference",
        "--recordings",
        "blind/recordings",
        "--json",
        "-",
    ];
    let by_flags = bench.run(&flags);
    assert_eq!(by_flags.code(), Some(3), "{}", by_flags.err());
    let [a, b]: [Value; 2] = [&by_folder, &by_flags].map(|r| serde_json::from_str(&r.out()).unwrap());
    assert_eq!(a["lost"].as_array().map(Vec::len), Some(0));
    assert!(b["lost"][0].as_str().unwrap().contains("run_1.csv"), "{}", b["lost"]);
    // One row of nine hundred is missing: the answer is the same.
    assert_eq!(a["diagnosis"]["verdict"], b["diagnosis"]["verdict"]);
    assert_eq!(a["diagnosis"]["ranked"][0]["effect"], b["diagnosis"]["ranked"][0]["effect"]);
}

#[test]
fn recordings_in_another_format_give_the_same_verdict() {
    let (drawn, bench) = (drawn(), bench(&drawn()));
    bench.remove("blind/heldout");
    let by_folder = bench.run(&["diagnose", "blind", "--json", "-"]);
    bench.write("mcap/reference/notes.txt", "");
    bench.write("mcap/recordings/notes.txt", "");
    let is_run = |path: &Path| path.extension().is_some_and(|end| end == "csv") && !path.starts_with("heldout");
    for path in drawn.files.iter().map(|(path, _)| path.as_path()).filter(|path| is_run(path)) {
        let table = path.display().to_string();
        let mcap = format!("mcap/{}", table.replace(".csv", ".mcap"));
        let run = bench.run(&["convert", &format!("blind/{table}"), "--out", &mcap]);
        assert_eq!(run.code(), Some(0), "{}", run.err());
    }
    let [reference, recordings] = ["mcap/reference", "mcap/recordings"];
    let by_mcap = bench.run(&[
        "diagnose",
        "--mapping",
        "lacuna",
        "--robot",
        "blind/robot.json",
        "--reference",
        reference,
        "--recordings",
        recordings,
        "--json",
        "-",
    ]);
    assert_eq!(by_mcap.code(), Some(0), "{}", by_mcap.err());
    let [a, b]: [Value; 2] = [&by_folder, &by_mcap].map(|r| serde_json::from_str(&r.out()).unwrap());
    for key in ["verdict", "ranked", "sentences"] {
        assert_eq!(a["diagnosis"][key], b["diagnosis"][key]);
    }
}

#[test]
fn a_mapping_in_the_case_folder_is_used_unless_another_is_named() {
    let bench = Bench::new();
    let renamed = |text: &str| text.replace("wheel_speed_left_rad_s", "wl").replace("wheel_speed_right_rad_s", "wr");
    for file in ["case/reference/ref_1.csv", "case/recordings/run_1.csv"] {
        let text = bench.read(file);
        bench.write(file, &renamed(&text));
    }
    let signal =
        |name: &str, column: &str, unit: &str| format!("{name} = {{ column = \"{column}\", unit = \"{unit}\" }}\n");
    let mapping = [
        "name = \"mine\"\n\n[[files]]\npattern = \"*.csv\"\n".to_owned(),
        "time = { column = \"time_s\", unit = \"s\", rate_hz = 100.0 }\n\n[files.signals]\n".to_owned(),
        signal("wheel_speed_left", "wl", "rad/s"),
        signal("wheel_speed_right", "wr", "rad/s"),
        signal("torque_left", "torque_left_Nm", "N m"),
        signal("torque_right", "torque_right_Nm", "N m"),
    ];
    bench.write("case/mapping.toml", &mapping.concat());
    let run = bench.run(&["diagnose", "case", "--json", "out.json"]);
    let json: Value = serde_json::from_str(&bench.read("out.json")).unwrap_or_else(|_| panic!("{}", run.err()));
    assert_eq!(json["mapping"], "mine", "{}", run.err());
    let run = bench.run(&["diagnose", "case", "--mapping", "skid-steer-columns"]);
    assert!(run.err().contains("no signal wheel_angle_left or wheel_speed_left"), "{}", run.err());
}
