//! The real recordings that lie beside the workspace; ignored where they do not.

mod common;

use std::path::{Path, PathBuf};
use std::process::Command;

use common::Bench;
use serde_json::Value;
use skipping::{Outcome, Skipped, beside};

fn data(folder: &str) -> Result<PathBuf, Skipped> {
    beside(&format!("data/{folder}"))
}

/// The diagnosis of one call.
fn diagnosis(args: &[&str], paths: &[(&str, Vec<PathBuf>)]) -> Value {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lacuna"));
    command.arg("diagnose").args(args).args(["--json", "-"]);
    for (flag, files) in paths {
        command.arg(flag).args(files);
    }
    let out = command.output().expect("lacuna runs");
    assert!(matches!(out.status.code(), Some(0 | 3)), "{}", String::from_utf8_lossy(&out.stderr));
    common::reads_back(std::str::from_utf8(&out.stdout).expect("UTF-8"));
    let whole: Value = serde_json::from_slice(&out.stdout).expect("JSON");
    whole["diagnosis"].clone()
}

/// A run on the floor against the other runs on the floor.
fn floor(folder: &Path, run: &str) -> Value {
    let file = |n: &str| folder.join(format!("FLOORING/pro_{n}.csv"));
    let others = ["01", "02", "04", "05", "09"].into_iter().filter(|n| *n != run).map(file).collect();
    let args = ["--robot", "husky-a200", "--mapping", "husky-open"];
    diagnosis(&args, &[("--reference", others), ("--recordings", vec![file(run)])])
}

/// What `lacuna check` says of these arguments.
fn check(bench: &Bench, args: &[&str]) -> (Option<i32>, Value) {
    let run = bench.run(&[&["check"], args, &["--json", "-"]].concat());
    (run.code(), serde_json::from_str(&run.out()).unwrap_or_else(|_| panic!("{}", run.err())))
}

fn number(v: &Value) -> f64 {
    v.as_f64().expect("a number")
}

fn a_ramp_inside_a_run_is_found_by_the_gyro_and_a_calm_run_has_none() -> Outcome {
    let folder = data("husky-open")?;
    let found = floor(&folder, "05")["steady"]["changes"]["found"].as_array().expect("a list").clone();
    // The accelerometer, alone and as a mean over 2 s, tilts by 4.3 degrees from 226.0 s to 243.5 s.
    let ramp = found.last().expect("a ramp");
    assert!(
        (number(&ramp["interval"][0]) - 226.0).abs() < 2.0 && (number(&ramp["interval"][1]) - 243.5).abs() < 2.0,
        "{ramp}"
    );
    assert!((number(&ramp["slope"]) + 4.3).abs() < 1.0, "{ramp}");
    assert_eq!(ramp["causes"], serde_json::json!(["grade"]));
    let calm = floor(&folder, "09");
    assert_eq!(calm["steady"]["changes"]["found"], serde_json::json!([]));
    assert_eq!(calm["verdict"], "no_mismatch");
    Ok(())
}

fn clocks_are_aligned_with_an_error_that_is_reported() -> Outcome {
    let folder = data("husky-open")?;
    let d = floor(&folder, "05");
    let clocks = d["steady"]["clocks"].as_array().expect("a list");
    let own = clocks.iter().find(|c| c["recording"] == "05").expect("two clocks");
    assert!(number(&own["error"][0]) < 0.2 && number(&own["error"][1]) < 0.5, "{own}");
    Ok(())
}

fn a_kobuki_gives_its_track_from_the_bag_without_any_reference() -> Outcome {
    let folder = data("ros2-bags")?;
    let bag = folder.join("kobuki_run_a_sqlite3");
    let d = diagnosis(&["--robot", "kobuki"], &[("--recordings", vec![bag])]);
    let loads = d["steady"]["ratios"].as_array().expect("a list");
    let track = loads.iter().find(|l| l["quantity"] == "effective_track").expect("a track");
    // By the heading of the inertial unit's own filter, over the whole run: 0.235 m.
    assert!((number(&track["value"]) - 0.235).abs() < number(&track["half"]) + 0.002, "{track}");
    Ok(())
}

fn bags_of_known_robots_are_mapped_by_themselves() -> Outcome {
    let data = data("ros2-bags")?;
    let bench = Bench::empty();
    for (folder, mapping, signals) in [
        ("kobuki_run_a_mcap", "kobuki-bag", 7),
        ("kobuki_run_a_sqlite3", "kobuki-bag", 7),
        ("husky_asphalt_00_mcap", "husky-bag", 10),
    ] {
        let (code, json) = check(&bench, &[&data.join(folder).display().to_string()]);
        assert_eq!(code, Some(0));
        assert_eq!(json["mapping"]["name"], mapping);
        assert_eq!(json["recordings"][0]["channels"].as_array().map(Vec::len), Some(signals), "{json}");
    }
    Ok(())
}

fn a_proposed_mapping_reads_the_bag_it_was_proposed_for() -> Outcome {
    let data = data("ros2-bags/kobuki_run_a_mcap")?;
    let (bench, data) = (Bench::empty(), data.display().to_string());
    let run = bench.run(&["check", &data, "--write-mapping", "map.toml"]);
    assert_eq!(run.code(), Some(0), "{}", run.err());
    assert!(run.out().contains("effort taken for torques"), "{}", run.out());
    let (code, json) = check(&bench, &[&data, "--mapping", "map.toml"]);
    assert_eq!(code, Some(0), "{json}");
    let signals: Vec<&str> =
        json["recordings"][0]["channels"].as_array().unwrap().iter().map(|c| c["signal"].as_str().unwrap()).collect();
    for signal in ["wheel_angle_left", "wheel_speed_right", "torque_left", "gyro_z"] {
        assert!(signals.contains(&signal), "{signal}: {signals:?}");
    }
    let again = bench.run(&["check", &data, "--write-mapping", "map.toml"]);
    assert!(again.code() == Some(1) && again.err().contains("there already"), "{}", again.err());
    Ok(())
}

skipping::tests![
    a_ramp_inside_a_run_is_found_by_the_gyro_and_a_calm_run_has_none,
    clocks_are_aligned_with_an_error_that_is_reported,
    a_kobuki_gives_its_track_from_the_bag_without_any_reference,
    bags_of_known_robots_are_mapped_by_themselves,
    a_proposed_mapping_reads_the_bag_it_was_proposed_for,
];
