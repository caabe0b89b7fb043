//! Cases that are not complete, and command lines that make no sense.

use crate::common::{Bench, drive};

#[test]
fn no_such_folder() {
    let bench = Bench::new();
    bench.run(&["diagnose", "nowhere"]).failed(&["no case folder 'nowhere'", "make one"]);
    let flags = ["diagnose", "--robot", "case/robot.toml", "--reference", "ref", "--recordings", "case/recordings"];
    bench.run(&flags).failed(&["no file or folder 'ref'"]);
}

#[test]
fn a_case_without_references_is_answered_and_says_what_that_costs() {
    let bench = Bench::new();
    bench.remove("case/reference");
    let done = bench.run(&["diagnose", "case"]);
    let out = done.out();
    assert!(
        out.contains("no real drive in which the simulation was right was given as reference"),
        "{out}{}",
        done.err()
    );
}

#[test]
fn a_folder_without_a_robot_or_with_two() {
    let bench = Bench::new();
    bench.write("case/robot.json", "{}");
    bench.refuses(&["both robot.json and robot.toml"]);
    bench.write("bare/reference/r.csv", "");
    bench.run(&["diagnose", "bare"]).failed(&["no robot.json or robot.toml", "--robot"]);
}

#[test]
fn a_folder_without_recordings() {
    let bench = Bench::new();
    bench.remove("case/recordings");
    bench.write("case/recordings/notes.txt", "windy");
    bench.refuses(&["no file in 'case/recordings'", "*.csv", "--mapping"]);
}

#[test]
fn two_recordings_for_identify() {
    let bench = Bench::new();
    let run = bench.run(&["identify", "case/robot.toml", "case/reference/ref_1.csv", "case/recordings/run_1.csv"]);
    run.failed(&["one recording at a time", "ref_1.csv", "run_1.csv"]);
}

#[test]
fn wrong_usage_exits_with_2() {
    let bench = Bench::new();
    for args in [
        &["diagnose"][..],
        &["diagnose", "case", "--reference", "x"],
        &["diagnose", "--robot", "x"],
        &["diagnos"],
        &["identify", "x"],
        &["identify", "x", "y", "--step", "0"],
        &["explain"],
        &[],
    ] {
        let run = bench.run(args);
        assert_eq!(run.code(), Some(2), "{args:?}: {}", run.err());
        assert_eq!(run.out(), "");
        assert!(!run.err().is_empty());
    }
}

#[test]
fn currents_without_their_constant() {
    let bench = Bench::new();
    bench.write("r.toml", &crate::common::ROBOT.replace("torque-driven", "speed-driven"));
    let text =
        drive(300, 0.0).replace("torque_left_Nm", "current_left_A").replace("torque_right_Nm", "current_right_A");
    bench.write("run.csv", &text);
    bench.run(&["identify", "r.toml", "run.csv"]).failed(&["run.csv", "`torque_per_current`", "add"]);
}
