//! Effects of one's own: law files given with `--effects`.

use std::fmt::Write as _;

use serde_json::Value;

use crate::common::{Bench, ROBOT, reads_back};

const LAW: &str =
    "name = \"right-drag\"\nformula = \"T_right = -1.5 [N m] * bump(omega, 5)\"\n[seen]\nomega = [-9, 9]\n";

/// `[[effects]]` of a robot file that hold the law.
const HELD: &str = "\n[[effects]]\neffect = \"right-drag\"\nvalues = { constant = -2.0, \"a of bump(omega)\" = 4.0 }\n";

/// Torques of a drive in curves.
fn torques(seed: u32) -> String {
    let phase = f64::from(seed);
    let mut out = "time_s,torque_left_Nm,torque_right_Nm\n".to_owned();
    for k in 0..1200 {
        let t = f64::from(k) * 0.01;
        let (forward, turning) = (2.2 + 1.2 * (0.9 * t + phase).sin(), 5.0 * (0.7 * t + 2.0 * phase).sin());
        writeln!(out, "{t:.2},{:.4},{:.4}", forward - turning, forward + turning).unwrap();
    }
    out
}

/// The same table with noise of sensors on what they show: equal digits in every run.
fn noisy(csv: &str, seed: u64) -> String {
    let mut state = seed;
    let mut uniform = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    let mut lines = csv.lines();
    let header = lines.next().unwrap();
    let sizes: Vec<f64> = header
        .split(',')
        .map(|name| match name {
            _ if name.starts_with("wheel_speed") => 0.05,
            _ if name.starts_with("gyro") => 0.01,
            _ if name.starts_with("wheel_angle") || name.starts_with("pose") => 0.005,
            _ if name.starts_with("accel") => 0.2,
            _ => 0.0,
        })
        .collect();
    let mut out = format!("{header}\n");
    for line in lines {
        let cells = line.split(',').zip(&sizes).map(|(cell, size)| match cell.parse::<f64>() {
            Ok(x) if *size > 0.0 => format!("{:.6}", x + size * (uniform() + uniform() + uniform())),
            _ => cell.to_owned(),
        });
        out += &(cells.collect::<Vec<_>>().join(",") + "\n");
    }
    out
}

/// Law file, robot file with the law in it, and a case of drives of that robot.
fn bench() -> Bench {
    let bench = Bench::empty();
    bench.write("my-law.toml", LAW);
    bench.write("case/robot.toml", ROBOT);
    bench.write("dragging.toml", &format!("{ROBOT}{HELD}"));
    for (part, robot, seeds) in [("reference", "case/robot.toml", [1, 2]), ("recordings", "dragging.toml", [3, 4])] {
        for seed in seeds {
            bench.write("plan.csv", &torques(seed));
            let run = bench.run(&["simulate", robot, "plan.csv", "--effects", "my-law.toml"]);
            assert_eq!(run.code(), Some(0), "{}", run.err());
            bench.write(&format!("case/{part}/run_{seed}.csv"), &noisy(&run.out(), u64::from(seed)));
        }
    }
    bench
}

#[test]
fn a_law_of_ones_own_is_named_exported_and_simulated_by_its_name() {
    let bench = bench();
    let run = bench.run(&["diagnose", "case", "--effects", "my-law.toml", "--json", "verdict.json"]);
    assert_eq!(run.code(), Some(0), "{}", run.err());
    assert!(run.out().contains("Missing: right-drag, -"), "{}", run.out());
    assert!(run.out().contains("right-drag is the law of a file"), "{}", run.out());
    reads_back(&bench.read("verdict.json"));
    let verdict: Value = serde_json::from_str(&bench.read("verdict.json")).unwrap();
    let diagnosis = &verdict["diagnosis"];
    assert_eq!(diagnosis["ranked"][0]["effect"], "right-drag");
    let parameters = &diagnosis["ranked"][0]["parameters"];
    let constant = parameters["constant"]["value"].as_f64().unwrap();
    assert!((constant + 2.0).abs() < 0.3 && parameters["constant"]["sigma"].is_number(), "{parameters}");
    assert!((parameters["a of bump(omega)"]["value"].as_f64().unwrap() - 4.0).abs() < 1.0, "{parameters}");
    let carried = &diagnosis["own_effects"][0];
    assert_eq!((&carried["name"], &carried["seen"]["omega"][1]), (&"right-drag".into(), &9.0.into()));
    assert!(carried["formula"].as_str().unwrap().contains("bump(omega, 5)"));

    // Other commands need the file.
    let without = bench.run(&["export", "verdict.json", "--to", "toml"]);
    without.failed(&["this verdict names 'right-drag', an effect of a file", "add --effects right-drag.toml"]);
    let with = ["--effects", "my-law.toml"];
    let run = bench.run(&[&["export", "verdict.json", "--to", "toml", "-o", "corrected.toml"][..], &with].concat());
    assert_eq!((run.code(), run.err().as_str()), (Some(0), ""));
    bench
        .run(&["simulate", "corrected.toml", "plan.csv"])
        .failed(&["no effect `right-drag`", "--effects or --adopt right-drag.toml"]);
    let run = bench.run(&[&["predict", "corrected.toml", "--drives", "case/reference"][..], &with].concat());
    assert_eq!(run.code(), Some(0), "{}", run.err());
    let run = bench.run(&[&["export", "verdict.json", "--to", "mjcf", "-o", "robot.xml"][..], &with].concat());
    assert_eq!(run.code(), Some(0), "{}", run.err());
    let residual = bench.read("robot_residual.py");
    assert!(residual.contains("torque[1] += (-") && residual.contains("min(max(w[1], -9.0), 9.0)"), "{residual}");
    for format in ["urdf", "sdf"] {
        let run = bench.run(&[&["export", "verdict.json", "--to", format][..], &with].concat());
        assert!(run.code() == Some(0) && run.out().contains("torque[1] += (-"), "{}", run.err());
    }
    // A page of the verdict alone needs nothing else.
    let run = bench.run(&["report", "verdict.json", "-o", "page.html"]);
    assert!(run.code() == Some(0) && bench.read("page.html").contains("right-drag"), "{}", run.err());
}

#[test]
fn a_robot_file_without_the_law_and_drives_beyond_its_range_are_told() {
    let bench = Bench::empty();
    bench.write("my-law.toml", &LAW.replace("[-9, 9]", "[-1, 1]"));
    bench.write("robot.toml", ROBOT);
    bench.write("dragging.toml", &format!("{ROBOT}{HELD}"));
    bench.write("plan.csv", &torques(1));
    let simulated = |robot: &str| bench.run(&["simulate", robot, "plan.csv", "--effects", "my-law.toml"]);
    let run = simulated("robot.toml");
    assert!(run.code() == Some(0) && run.err().contains("does not name 'right-drag'"), "{}", run.err());
    let run = simulated("dragging.toml");
    assert!(run.code() == Some(0) && run.err().contains("beyond the range seen the law is held"), "{}", run.err());
}

#[test]
fn law_files_that_cannot_be_used_are_refused_in_one_sentence() {
    let bench = Bench::new();
    let diagnosed = |law: &str| {
        bench.write("my-law.toml", law);
        bench.run(&["diagnose", "case", "--effects", "my-law.toml"])
    };
    diagnosed("formula = \"T_left = 1 [N] * sgn(omega, 1)\"\n").failed(&["line 1, column 11", "closes with N m only"]);
    diagnosed("formula = \"T_left = 1 [N m] * sgn(speed, 1)\"\n").failed(&["line 1, column 11", "'speed'"]);
    diagnosed("formula = \"T_rear = 1 [N m]\"\n").failed(&["line 1, column 11", "no place is called 'T_rear'"]);
    diagnosed("formula = \"T_left = 1 [N m] * bump(v, 0)\"\n").failed(&["'bump(v, 0)' has 0", "0.000001 to 1000000"]);
    diagnosed("formula = T_left\n").failed(&["line 1"]);
    bench.write("other.toml", "name = \"my-law\"\nformula = \"T_left = 1 [N m]\"\n");
    bench.write("my-law.toml", "formula = \"T_left = 1 [N m]\"\n");
    bench
        .run(&["diagnose", "case", "--effects", "my-law.toml,other.toml"])
        .failed(&["both hold an effect called 'my-law'"]);
    bench.run(&["diagnose", "case", "--effects", "none.toml"]).failed(&["cannot read the law file 'none.toml'"]);

    for kind in ["speed-driven", "command-driven"] {
        bench.write("case/robot.toml", &ROBOT.replace("torque-driven", kind));
        let refused = ["effects of one's own (my-law)", kind, "leave out --effects"];
        bench.run(&["diagnose", "case", "--effects", "my-law.toml"]).failed(&refused);
        bench
            .run(&["simulate", "case/robot.toml", "case/recordings/run_1.csv", "--effects", "my-law.toml"])
            .failed(&refused);
        let export = ["export", "case/robot.toml", "--to", "toml", "--effects", "my-law.toml"];
        bench.run(&export).failed(&refused);
        bench.run(&["rehearse", "case", "--effects", "my-law.toml"]).failed(&refused);
        let batch = ["batch", "case/recordings", "--robot", "case/robot.toml", "-o", "out", "--effects", "my-law.toml"];
        bench.run(&batch).failed(&refused);
    }
}

#[test]
fn a_rehearsal_hides_a_law_of_ones_own() {
    let bench = Bench::empty();
    bench.write("my-law.toml", LAW);
    bench.write("case/robot.toml", ROBOT);
    bench.write("plan.csv", &torques(1));
    let run = bench.run(&["simulate", "case/robot.toml", "plan.csv"]);
    bench.write("case/recordings/run_1.csv", &noisy(&run.out(), 5));
    let few = ["--size", "4", "--replicas", "1", "--fault-free", "1", "--seconds", "8"];
    let run = bench.run(&[&["rehearse", "case", "--effects", "my-law.toml"][..], &few].concat());
    assert!(run.code() == Some(0) && run.out().contains("right-drag"), "{}{}", run.out(), run.err());
}

#[test]
fn what_a_robot_file_or_an_adopted_law_gives_the_simulation_is_no_longer_missing() {
    let bench = bench();
    let as_driven = LAW.replace("-1.5", "-2.0").replace("bump(omega, 5)", "bump(omega, 4)");
    bench.write("flaw.toml", &as_driven);
    let error = |name: &str, extra: &[&str]| {
        let files = ["--robot", name, "--recordings", "case/recordings", "--json", "verdict.json"];
        let run = bench.run(&[&["diagnose"][..], &files, extra].concat());
        assert_eq!(run.code(), Some(0), "{}", run.err());
        let verdict: Value = serde_json::from_str(&bench.read("verdict.json")).unwrap();
        let runs = verdict["diagnosis"]["free_runs"].as_array().unwrap().clone();
        let nominal = runs.iter().find(|run| run["quantity"].as_str().unwrap().starts_with("wheel speed")).unwrap();
        let alike = nominal["nominal"].as_f64().unwrap();
        (verdict["diagnosis"]["verdict"].as_str().unwrap().to_owned(), alike)
    };
    let (_, without) = error("case/robot.toml", &[]);
    let (verdict, adopted) = error("case/robot.toml", &["--adopt", "flaw.toml"]);
    assert_eq!(verdict, "no_mismatch");
    assert!(adopted < 0.5 * without, "{adopted} with the law, {without} without");

    // The verdict carries the robot with it, and what exports it asks for the file.
    bench.run(&["export", "verdict.json", "--to", "toml"]).failed(&["no effect `right-drag`"]);
    let run = bench.run(&["export", "verdict.json", "--to", "toml", "-o", "whole.toml", "--adopt", "flaw.toml"]);
    assert_eq!(run.code(), Some(0), "{}", run.err());
    assert_eq!(bench.read("whole.toml").matches("effect = \"right-drag\"").count(), 1);

    // With another sign the simulation runs away, and nothing is answered.
    bench.write("wrong.toml", "name = \"wrong\"\nformula = \"T_right = 60 [N m s/rad] * pow(omega, 1)\"\n");
    let wrong = ["diagnose", "--robot", "case/robot.toml", "--recordings", "case/recordings", "--adopt", "wrong.toml"];
    bench.run(&wrong).failed(&["the simulation runs away", "that it is given (wrong)", "check their signs"]);

    // The robot file that holds it is the same simulation, once.
    let (verdict, of_file) = error("dragging.toml", &["--adopt", "flaw.toml"]);
    assert_eq!((verdict.as_str(), of_file), ("no_mismatch", adopted));
}

#[test]
fn effects_of_a_robot_file_that_recordings_are_not_compared_with_are_told() {
    let bench = Bench::new();
    let gyro = "\n[[effects]]\neffect = \"gyro_bias\"\nvalues = { b = 0.02 }\n";
    bench.write("case/robot.toml", &format!("{ROBOT}{gyro}"));
    let run = bench.run(&["diagnose", "case"]);
    assert_eq!(run.code(), Some(0), "{}", run.err());
    assert!(
        run.out().contains("that recordings are not compared with, and that may be found again: gyro_bias"),
        "{}",
        run.out()
    );
}
