//! `lacuna rehearse` from files to shares of replicas, a page and JSON, and what it refuses.

use std::fmt::Write as _;

use crate::common::{Bench, ROBOT};
use serde_json::Value;

/// Torques of 6 s, and nothing else.
fn planned() -> String {
    let mut out = "time_s,torque_left_Nm,torque_right_Nm\n".to_owned();
    for k in 0..600 {
        let t = f64::from(k) * 0.01;
        let (both, turn) = (3.0 + 2.0 * (1.1 * t).sin(), 3.5 * (0.8 * t).sin());
        writeln!(out, "{t:.2},{:.3},{:.3}", both - turn, both + turn).unwrap();
    }
    out
}

/// A case of nothing but planned torques, driven by the robot file.
fn bench() -> Bench {
    let bench = Bench::empty();
    bench.write("case/robot.toml", ROBOT);
    bench.write("plan.csv", &planned());
    bench.write("case/recordings/keep.txt", "");
    let simulated = bench.run(&["simulate", "case/robot.toml", "plan.csv", "-o", "case/recordings/plan.csv"]);
    assert_eq!(simulated.code(), Some(0), "{}", simulated.err());
    bench
}

const SHORT: [&str; 8] = ["rehearse", "case", "--replicas", "1", "--fault-free", "1", "--references", "1"];

#[test]
fn torques_that_are_only_planned_are_rehearsed_into_text_json_and_a_page() {
    let bench = bench();
    let of = ["--effects", "Payload,clock-drift", "--size", "8"];
    let run = bench.run(&[&SHORT[..], &of, &["--json", "r.json", "--html", "r.html"]].concat());
    assert_eq!(run.code(), Some(0), "{}", run.err());
    for told in
        ["False alarms: ", "of 1 replicas", "payload", "clock_drift: it acts on the samples", "What limits this"]
    {
        assert!(run.out().contains(told), "no `{told}` in {}", run.out());
    }
    let json: Value = serde_json::from_str(&bench.read("r.json")).unwrap();
    let rehearsal = &json["rehearsal"];
    assert_eq!((&json["format"], &rehearsal["drives"]["references"]), (&1.into(), &1.into()));
    let size = &rehearsal["effects"][0]["sizes"][0];
    assert_eq!((&size["multiple"], &size["answers"]["replicas"]), (&8.0.into(), &1.into()));
    let noise = rehearsal["drives"]["noise"].as_array().unwrap();
    assert!(noise.iter().all(|n| n["sigma"].as_f64() > Some(0.0)), "a simulator's log gets the usual noise: {noise:?}");
    let page = bench.read("r.html");
    assert!(page.contains("Rehearsal") && page.contains("data-chart") && page.contains("8 x"));

    let again = bench.run(&[&SHORT[..], &of, &["--json", "-"]].concat());
    let again: Value = serde_json::from_str(&again.out()).unwrap();
    assert!(again == json, "another answer to the same question");
}

/// Straight driving at two speeds and turns both ways, with the torques that they take.
fn steady(scale: f64) -> String {
    let mut out = "time_s,wheel_speed_left_rad_s,wheel_speed_right_rad_s,current_left_A,current_right_A\n".to_owned();
    let legs =
        [([4.0, 4.0], [1.0, 1.0]), ([2.0, 5.0], [-1.5, 3.5]), ([6.0, 6.0], [1.1, 1.1]), ([5.0, 2.0], [3.5, -1.5])];
    for k in 0..1200 {
        let ([l, r], torque) = legs[(k / 100) % 4];
        let scatter = 0.02 * [0.8, -1.1, 0.4, -0.1, 0.9, -0.9][k % 6];
        let [left, right] = torque.map(|torque| scale * torque + scatter);
        writeln!(out, "{:.2},{l},{r},{left:.4},{right:.4}", 0.1 * k as f64).unwrap();
    }
    out
}

#[test]
fn set_speeds_are_rehearsed_by_their_steady_loads() {
    let bench = Bench::empty();
    let constant =
        "[parameters]\ntorque_per_current = { value = 1.0, unit = \"N m/A\", sigma = 0.05, source = \"guess\" }";
    let robot = ROBOT.replace("torque-driven", "speed-driven").replace("[parameters]", constant);
    bench.write("case/robot.toml", &robot);
    for (name, scale) in [("reference/a", 1.0), ("reference/b", 1.01), ("recordings/c", 0.99)] {
        bench.write(&format!("case/{name}.csv"), &steady(scale));
    }
    let of = ["--effects", "rolling-resistance,gyro-bias", "--size", "1,30", "--replicas", "1", "--fault-free", "2"];
    let run = bench.run(&[&["rehearse", "case"][..], &of, &["--html", "r.html"]].concat());
    assert_eq!(run.code(), Some(0), "{}", run.err());
    for told in
        ["of 2 replicas", "rolling_resistance", "gyro_bias: it changes no load", "2 fault-free references", "not rows"]
    {
        assert!(run.out().contains(told), "no `{told}` in {}", run.out());
    }
    assert!(!run.out().contains("noise (one sigma)") && bench.read("r.html").contains("data-chart"));
    let refused = bench.run(&["rehearse", "case", "--seconds", "3"]);
    assert_eq!(refused.code(), Some(2), "{}", refused.err());
}

#[test]
fn plans_that_make_no_sense_are_wrong_usage() {
    let bench = bench();
    let refused = |more: &[&str], part: &str| {
        let run = bench.run(&[&["rehearse", "case"], more].concat());
        assert_eq!((run.code(), run.out().as_str()), (Some(2), ""), "{}", run.err());
        assert!(run.err().contains(part), "no `{part}` in {}", run.err());
    };
    refused(&["--effects", "paylod"], "no effect is called `paylod`; did you mean `payload`?");
    refused(&["--size", "1,0"], "0 is no size to rehearse; give multiples of the size of interest");
    refused(&["--size=-1"], "-1 is no size to rehearse");
    refused(&["--size", "large"], "'large'");
    refused(&["--replicas", "0"], "no replica was asked for; give 1 or more");
    refused(&["--drives", "0"], "give a whole number from 1 on");
    refused(&["--references=-1"], "give a whole number from 0 to");
    refused(&["--seconds", "0"], "is no length to rehearse");
}

#[test]
fn cases_that_cannot_be_rehearsed_are_refused_in_a_sentence() {
    let bench = bench();
    for target in ["--html", "--json"] {
        let run = bench.run(&["rehearse", "case", target, "nowhere/out"]);
        run.failed(&["cannot write 'nowhere/out'", "no folder 'nowhere'", "make it"]);
    }
    bench.run(&["rehearse", "case", "--html", "case"]).failed(&["'case'", "it is a folder", "name a file in it"]);
    bench.run(&["rehearse", "case", "--seconds", "1"]).failed(&["'plan' has 100 rows", "record longer"]);
    bench.write("case/recordings/plan.csv", &planned());
    bench.run(&["rehearse", "case"]).failed(&["wheel_angle_left or wheel_speed_left"]);
    bench.remove("case/recordings");
    bench.run(&["rehearse", "case"]).failed(&["recordings"]);
}
