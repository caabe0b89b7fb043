//! Drives of one day, place and load: named, found, and refused where they contradict each other.

use crate::common::{Bench, ROBOT, drive};

/// References of two days in a folder each, and a recording.
fn of_two_days() -> Bench {
    let bench = Bench::new();
    bench.remove("case/reference");
    for (name, phase) in [("mon/a", 0.0), ("mon/b", 0.2), ("tue/c", 2.5)] {
        bench.write(&format!("case/reference/{name}.csv"), &drive(300, phase));
    }
    bench
}

#[test]
fn folders_are_visits_and_the_answer_says_so() {
    let bench = of_two_days();
    let found = bench.run(&["diagnose", "case"]);
    let out = found.out().split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(out.contains("2 visits ('reference: mon': 2 drives, 'reference: tue': 1 drive)"), "{out}{}", found.err());
    assert!(out.contains("by the folders in which the files lie"), "{out}");

    let said = bench.run(&["diagnose", "case", "--visit", "today=*"]);
    let out = said.out().split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(out.contains("the references are of one visit ('today'), the recordings of one visit ('today')"), "{out}");
    assert!(out.contains("as --visit says"), "{out}");
}

#[test]
fn without_names_nothing_is_said_of_visits() {
    let out = Bench::new().run(&["diagnose", "case"]).out();
    assert!(!out.contains("visit"), "{out}");
}

#[test]
fn visits_that_contradict_each_other_are_refused() {
    let bench = of_two_days();
    let refused = |visits: &[&str], parts: &[&str]| {
        let options = visits.iter().flat_map(|visit| ["--visit", visit]);
        let args: Vec<&str> = ["diagnose", "case"].into_iter().chain(options).collect();
        bench.run(&args).failed(parts);
    };
    refused(&["x=mon", "x=tue"], &["names 'x' twice", "--visit 'x=mon,tue'"]);
    refused(&["x=wed"], &["no reference and no recording is 'wed'", "reference/mon/a.csv"]);
    refused(&["x=mon", "y=reference/*"], &["mon/a.csv' is of two visits, 'x' (mon) and 'y' (reference/*)"]);
}

#[test]
fn what_is_no_visit_is_wrong_usage() {
    for text in ["monday", "=a.csv", "monday="] {
        let run = Bench::new().run(&["diagnose", "case", "--visit", text]);
        assert_eq!(run.code(), Some(2), "{}", run.err());
        assert!(run.err().contains("monday=reference/mon_*"), "{}", run.err());
    }
}

#[test]
fn where_visits_are_not_used_they_are_refused_with_the_reason() {
    let bench = Bench::new();
    for kind in ["speed-driven", "command-driven"] {
        bench.write("robot.toml", &ROBOT.replace("torque-driven", kind));
        let run = bench.run(&["diagnose", "case", "--robot", "robot.toml", "--visit", "today=*"]);
        run.failed(&[kind, "which of its constants move", "leave out --visit"]);
    }
    bench.run(&["screen", "case", "--visit", "today=*"]).failed(&["of whatever visit", "leave out --visit"]);
}
