//! The real recordings that lie beside the workspace; skipped, and said so, where they do not.

mod common;

use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

fn data(folder: &str) -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data").join(folder);
    if folder.is_dir() {
        return Some(folder);
    }
    eprintln!("SKIPPED: {} is not there", folder.display());
    None
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

fn number(v: &Value) -> f64 {
    v.as_f64().expect("a number")
}

#[test]
fn a_ramp_inside_a_run_is_found_by_the_gyro_and_a_calm_run_has_none() {
    let Some(folder) = data("husky-open") else { return };
    let found = floor(&folder, "05")["steady"]["changes"]["found"].as_array().expect("a list").clone();
    // The accelerometer, which no diagnosis of this kind uses, tilts by 4.3 degrees from 226.0 s to 243.5 s.
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
}

#[test]
fn clocks_are_aligned_with_an_error_that_is_told() {
    let Some(folder) = data("husky-open") else { return };
    let d = floor(&folder, "05");
    let clocks = d["steady"]["clocks"].as_array().expect("a list");
    let own = clocks.iter().find(|c| c["recording"] == "05").expect("two clocks");
    assert!(number(&own["error"][0]) < 0.2 && number(&own["error"][1]) < 0.5, "{own}");
}

#[test]
fn a_kobuki_gives_its_track_from_the_bag_without_any_reference() {
    let Some(folder) = data("ros2-bags") else { return };
    let bag = folder.join("kobuki_run_a_sqlite3");
    let d = diagnosis(&["--robot", "kobuki"], &[("--recordings", vec![bag])]);
    let loads = d["steady"]["ratios"].as_array().expect("a list");
    let track = loads.iter().find(|l| l["quantity"] == "effective_track").expect("a track");
    // By the heading of the inertial unit's own filter, over the whole run: 0.235 m.
    assert!((number(&track["value"]) - 0.235).abs() < number(&track["half"]) + 0.002, "{track}");
}
