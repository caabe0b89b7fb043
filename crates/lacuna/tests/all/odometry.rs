//! `lacuna diagnose` for robots of which wheel counts and a pose are recorded.

use std::fmt::Write as _;

use crate::common::{Bench, CART as ROBOT};
use serde_json::Value;

/// Levels of both wheels at 20 Hz; the right wheel is 5 % larger than the file says.
fn drive(phase: f64) -> String {
    let mut out = String::from("t,left,right,x,y,yaw\n");
    let (mut x, mut y, mut yaw) = (0.0_f64, 0.0_f64, 0.0_f64);
    for k in 0..1200_u32 {
        let level = f64::from(k / 60) + phase;
        let speeds = [4.0 + 2.0 * (1.7 * level).sin(), 4.0 + 2.0 * (2.9 * level).cos()];
        let counts = speeds.map(|s| (s * 0.05 / std::f64::consts::TAU * 4000.0).round());
        if k > 0 {
            let ways = [0.05, 0.0525].map(|r| r * std::f64::consts::TAU / 4000.0);
            let (l, r) = (ways[0] * counts[0], ways[1] * counts[1]);
            let turned = (r - l) / 0.3;
            x += 0.5 * (l + r) * (yaw + 0.5 * turned).cos();
            y += 0.5 * (l + r) * (yaw + 0.5 * turned).sin();
            yaw += turned;
        }
        let rough = |s: f64| 5e-4 * (f64::from(k) * 7.3 + s).sin();
        let t = f64::from(k) * 0.05;
        writeln!(
            out,
            "{t:.2},{},{},{:.5},{:.5},{:.5}",
            counts[0],
            counts[1],
            x + rough(0.0),
            y + rough(1.0),
            yaw + rough(2.0)
        )
        .unwrap();
    }
    out
}

/// The same drive with its pose in the first row only, or without any.
fn counts_of(phase: f64, begins: bool) -> String {
    let cells = |(k, line): (usize, &str)| {
        let mut cells: Vec<&str> = line.split(',').collect();
        if !begins {
            cells.truncate(3);
        } else if k > 1 {
            cells[3..].fill("");
        }
        cells.join(",") + "\n"
    };
    drive(phase).lines().enumerate().map(cells).collect()
}

/// Where a table of predicted poses ends.
fn end(table: &str) -> [f64; 3] {
    let last: Vec<f64> = table.lines().last().unwrap().split(',').skip(1).map(|c| c.parse().unwrap()).collect();
    last.try_into().unwrap()
}

fn bench() -> Bench {
    let bench = Bench::empty();
    bench.write("case/robot.toml", ROBOT);
    for (k, phase) in [0.0, 0.4, 0.8].into_iter().enumerate() {
        bench.write(&format!("case/recordings/run_{k}.csv"), &drive(phase));
    }
    bench
}

#[test]
fn a_wheel_that_is_too_large_is_named_with_its_radius() {
    let bench = bench();
    let run = bench.run(&["diagnose", "case", "--json", "out.json"]);
    assert_eq!(run.code(), Some(0), "{}", run.err());
    for part in ["radius of one wheel (right)", "scale of the pose", "from counts alone", "OptiOdom"] {
        assert!(run.out().contains(part), "no `{part}` in {}", run.out());
    }
    let json: Value = serde_json::from_str(&bench.read("out.json")).unwrap();
    assert_eq!((&json["kind"], &json["diagnosis"]["verdict"]), (&"odometry".into(), &"explained".into()));
    let radius = json["diagnosis"]["tuning"]["radius of right"].as_f64().unwrap();
    let other = json["diagnosis"]["tuning"]["radius of left"].as_f64().unwrap();
    assert!((radius / other - 1.05).abs() < 0.003, "{radius} over {other}");
    assert_eq!(bench.run(&["diagnose", "case", "--fail-on", "mismatch"]).code(), Some(4));
}

#[test]
fn a_table_with_semicolons_and_decimal_commas_is_the_same_drive_and_is_told() {
    let bench = Bench::empty();
    bench.write("robot.toml", ROBOT);
    bench.write("points/run.csv", &drive(0.4));
    bench.write("commas/run.tsv", &drive(0.4).replace(',', ";").replace('.', ","));
    let check = |file: &str| {
        let run = bench.run(&["check", file, "--robot", "robot.toml"]);
        assert_eq!(run.code(), Some(0), "{}", run.err());
        run.out()
    };
    let (points, commas) = (check("points/run.csv"), check("commas/run.tsv"));
    for said in [&points, &commas] {
        assert!(said.contains("1200 rows in 60.0 s, a pose in 1200 of them"), "{said}");
    }
    let written = "cells are taken to be separated by ';', and decimals behind commas";
    assert!(commas.contains(written) && !points.contains("cells are taken"), "{commas}");
}

#[test]
fn a_drive_that_lies_there_twice_under_one_name_is_refused_with_both_files() {
    let bench = bench();
    bench.write("case/recordings/run_1.tsv", &drive(0.4).replace(',', "\t"));
    bench.run(&["diagnose", "case"]).failed(&["run_1.csv' and '", "run_1.tsv' have one name", "leave one of them"]);
}

#[test]
fn the_next_drive_is_advised_by_itself_and_with_the_verdict() {
    let bench = bench();
    let run = bench.run(&["next", "case", "--profile", "p.csv", "--picture", "p.svg", "--json", "n.json"]);
    assert_eq!(run.code(), Some(0), "{}", run.err());
    assert!(
        run.out().contains("Drives, the best first") && run.out().contains("radius of one wheel (right)"),
        "{}",
        run.out()
    );
    let csv = bench.read("p.csv");
    assert!(csv.starts_with("t_s,v_ahead_m_s,v_left_m_s,omega_rad_s\n0.00,0.0000,0.0000,0.0000\n"), "{csv}");
    assert!(bench.read("p.svg").contains("<svg"));

    let json: Value = serde_json::from_str(&bench.read("n.json")).unwrap();
    let bits = |of: &Value| -> Vec<f64> {
        let drives = of["manoeuvres"].as_array().unwrap().iter();
        drives.map(|m| m["expected_bits"].as_f64().unwrap()).collect()
    };
    assert!(bits(&json["next"]).is_sorted_by(|a, b| a >= b));
    assert_eq!(bench.run(&["diagnose", "case", "--next", "--json", "out.json"]).code(), Some(0));
    let whole: Value = serde_json::from_str(&bench.read("out.json")).unwrap();
    assert_eq!(whole["diagnosis"]["next"]["rivals"], json["next"]["rivals"]);
    // Rows that are broken are refused whatever is asked.
    let tolerant = bench.run(&["diagnose", "case", "--reading", "tolerant"]);
    assert!(
        tolerant.err().contains("--reading tolerant says nothing to robots of kind odometry"),
        "{}",
        tolerant.err()
    );
}

#[test]
fn counts_that_are_lost_in_many_windows_are_named_with_their_times() {
    let bench = bench();
    // From 9 s on, in every 14 s, the left wheel loses most of its counts for 2 s.
    let lossy = |text: String| -> String {
        let line = |line: &str| {
            let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
            if let (Ok(t), Ok(count)) = (cells[0].parse::<f64>(), cells[1].parse::<f64>())
                && (t - 9.0).rem_euclid(14.0) < 2.0
            {
                cells[1] = (0.3 * count).round().to_string();
            }
            cells.join(",") + "\n"
        };
        text.lines().map(line).collect()
    };
    bench.write(
        "case/robot.toml",
        &ROBOT.replacen("radius = 0.05\n", "radius = 0.0525\n", 2).replacen("0.0525", "0.05", 1),
    );
    for (k, phase) in [0.0, 0.4, 0.8].into_iter().enumerate() {
        bench.write(&format!("case/recordings/run_{k}.csv"), &lossy(drive(phase)));
    }
    let run = bench.run(&["diagnose", "case", "--json", "out.json"]);
    assert_eq!(run.code(), Some(0), "{}", run.err());
    let json: Value = serde_json::from_str(&bench.read("out.json")).unwrap();
    let first = &json["diagnosis"]["ranked"][0];
    assert_eq!((&json["diagnosis"]["verdict"], &first["name"]), (&"explained".into(), &"lost_counts (left)".into()));
    let times = first["intervals"]["run_0"].as_array().unwrap();
    assert!(times.len() >= 3, "{times:?}");
    for span in times {
        let (from, until) = (span[0].as_f64().unwrap(), span[1].as_f64().unwrap());
        let begins = 9.0 + 14.0 * ((from - 8.0) / 14.0).floor();
        assert!((from - begins).abs() < 0.8 && (until - begins - 2.0).abs() < 0.8, "{from} to {until}");
    }
}

#[test]
fn what_cannot_be_is_one_clear_sentence() {
    let bench = bench();
    bench.run(&["diagnose", "case", "--mapping", "lacuna"]).failed(&["kind odometry", "leave out --mapping lacuna"]);
    bench.run(&["diagnose", "case", "--visit", "today=*"]).failed(&["kind odometry take no --visit", "leave it out"]);
    bench.write("case/robot.toml", &ROBOT.replace("[0.0, -0.15]", "[0.0, 0.15]"));
    bench.run(&["diagnose", "case"]).failed(&["cart", "do not determine its turning"]);
    bench.write("case/robot.toml", &ROBOT.replacen("counts_per_turn = 4000.0\n", "", 1));
    bench.run(&["diagnose", "case"]).failed(&["'left' has counts but no counts_per_turn"]);
    bench.write("case/robot.toml", &ROBOT.replace("\"left\"\n\n", "\"links\"\n\n"));
    bench.run(&["diagnose", "case"]).failed(&["run_0", "no column 'links'", "it has t, left, right"]);
}

#[test]
fn drives_are_rehearsed_by_the_equations_of_their_fit() {
    let bench = bench();
    let run = bench.run(&["rehearse", "case", "--json", "r.json", "--html", "r.html"]);
    assert_eq!(run.code(), Some(0), "{}", run.err());
    for told in ["of 200 replicas", "radius_of_one_wheel (left)", "run_0 (60.0 s)", "nothing is simulated"] {
        assert!(run.out().contains(told), "no `{told}` in {}", run.out());
    }
    let json: Value = serde_json::from_str(&bench.read("r.json")).unwrap();
    let effects = json["rehearsal"]["effects"].as_array().unwrap();
    let radius = effects.iter().find(|e| e["effect"] == "radius_of_one_wheel (left)").expect("the radius");
    let found = |k: usize| radius["sizes"][k]["answers"]["first"].as_u64();
    assert_eq!((found(3), &radius["unit"]), (Some(40), &"m".into()));
    assert!(bench.read("r.html").contains("radius of one wheel"));

    let of = ["rehearse", "case", "--effects", "radius_of_one_wheel", "--size", "1", "--replicas", "2"];
    let run = bench.run(&of);
    assert!(run.out().contains("(right)") && run.out().contains("(left)"), "{}", run.out());
    for (option, value, told) in
        [("--effects", "payload", "no effect is called `payload`"), ("--seconds", "5", "--seconds is of robots")]
    {
        let run = bench.run(&["rehearse", "case", option, value]);
        assert!(run.code() == Some(2) && run.err().contains(told), "{}", run.err());
    }
}

#[test]
fn what_needs_torques_or_speeds_says_which_kind_a_robot_is_and_every_robot_has_a_name() {
    let bench = bench();
    let is_refused = |args: &[&str], parts: &[&str]| {
        bench.run(args).failed(&[parts, &["`lacuna diagnose` takes it; this command needs"]].concat());
    };
    is_refused(&["screen", "case"], &["kind odometry, which compares wheel motion beside a pose"]);
    is_refused(&["screen", "--robot", "tricycle", "--recordings", "case/recordings"], &["'tricycle'", "kind odometry"]);
    is_refused(&["screen", "--robot", "dart", "--recordings", "case/recordings"], &["'dart'", "kind car"]);
    bench.run(&["diagnose", "--robot", "zebra", "--recordings", "case/recordings"]).failed(&[
        "husky-a200",
        "omni-3",
        "dart",
    ]);
    // A car by name is read as one: its columns are asked for.
    bench.run(&["diagnose", "--robot", "car", "--recordings", "case/recordings"]).failed(&["no column 'time_s'"]);
}

#[test]
fn a_drive_is_drawn_beside_its_simulations_at_once_or_from_the_verdict() {
    let bench = bench();
    let run = bench.run(&["diagnose", "case", "--report", "now.html", "--json", "out.json", "--mcap", "out.mcap"]);
    assert_eq!(run.code(), Some(0), "{}", run.err());
    assert!(!run.err().contains("does not write"), "{}", run.err());
    assert_eq!(bench.run(&["report", "out.json", "-o", "later.html"]).code(), Some(0));
    let page = bench.read("now.html");
    assert_eq!(page, bench.read("later.html"));
    assert!(!page.contains("Paths of the recordings") && !page.contains("than in fault-free drives"));
    for part in
        ["wheel motion beside a pose", "position x", "heading", "left out of the fit", "case/recordings/run_0.csv"]
    {
        assert!(page.contains(part), "no `{part}` in the page");
    }

    let json: Value = serde_json::from_str(&bench.read("out.json")).unwrap();
    let hash = json["sources"]["recordings"][0]["sha256"].as_str().unwrap();
    assert_eq!(hash.len(), 64);
    let traces = json["diagnosis"]["traces"].as_array().unwrap();
    assert_eq!(traces.len(), 3);
    let error = |trace: &Value, which: &str| -> f64 {
        let values = |name: &str| trace["channels"][2][name].as_array().unwrap().clone();
        let pairs = values("recorded").into_iter().zip(values(which));
        pairs.filter_map(|(a, b)| Some((a.as_f64()? - b.as_f64()?).powi(2))).sum::<f64>().sqrt()
    };
    for trace in traces {
        assert_eq!(trace["left_out"], true);
        assert!(error(trace, "corrected") < 0.2 * error(trace, "nominal"), "{}", trace["recording"]);
    }
    bench.run(&["law", "out.json"]).failed(&["verdict of kind odometry", "lacuna report"]);
}

#[test]
fn a_verdict_becomes_a_robot_file_and_parameters_of_a_controller() {
    let bench = bench();
    bench.write("case/robot.toml", &ROBOT.replace("radius = 0.05\n", "radius = 0.05   # m\n"));
    assert_eq!(bench.run(&["diagnose", "case", "--json", "out.json"]).code(), Some(0));
    let run = bench.run(&["export", "out.json", "--to", "toml", "-o", "corrected.toml"]);
    assert_eq!((run.code(), run.out(), run.err()), (Some(0), String::new(), String::new()));
    let corrected = bench.read("corrected.toml");
    let (wanted, found) = (&["radius = 0.0524", "   # m", "re-tuned by lacuna from 0.05 m"], &corrected);
    assert!(wanted.iter().all(|part| found.contains(part)), "{corrected}");
    let nominal = bench.run(&["export", "out.json", "--to", "toml", "--nominal"]).out();
    assert_eq!(nominal, bench.read("case/robot.toml"));

    // With the file corrected, nothing is missing any more.
    let run = bench.run(&["diagnose", "--robot", "corrected.toml", "--recordings", "case/recordings", "--json", "-"]);
    let json: Value = serde_json::from_str(&run.out()).unwrap();
    assert_eq!(json["diagnosis"]["verdict"], "no_mismatch");

    let run = bench.run(&["export", "out.json", "--to", "ros2", "-o", "controllers.yaml"]);
    assert_eq!((run.code(), run.err()), (Some(0), String::new()));
    let yaml: serde_yaml_ng::Value = serde_yaml_ng::from_str(&bench.read("controllers.yaml")).unwrap();
    let parameters = &yaml["diff_drive_controller"]["ros__parameters"];
    let number = |value: &serde_yaml_ng::Value| value.as_f64().unwrap();
    assert!((number(&parameters["right_wheel_radius_multiplier"]) - 1.05).abs() < 0.002);
    assert!((number(&parameters["left_wheel_radius_multiplier"]) - 1.0).abs() < 0.002);
    assert_eq!((number(&parameters["wheel_radius"]), number(&parameters["wheel_separation"])), (0.05, 0.3));
    let velocity = number(&parameters["twist_covariance_diagonal"][0]);
    assert!(velocity > 0.0 && velocity < 1e-3, "{velocity}");
    assert_eq!(yaml["ekf_filter_node"]["ros__parameters"]["odom0"], "/diff_drive_controller/odom");
    let stated = bench.run(&["export", "case/robot.toml", "--to", "ros2"]).out();
    assert!(stated.contains("left_wheel_radius_multiplier: 1.0\n") && stated.contains("# Covariances are left out"));
}

#[test]
fn a_corrected_robot_file_predicts_what_its_verdict_predicted() {
    let bench = bench();
    bench.write("case/heldout/new.csv", &counts_of(1.1, true));
    bench.write("new/new.csv", &drive(1.1));
    let run = bench.run(&["diagnose", "case", "--json", "out.json", "--predictions", "poses"]);
    assert_eq!(run.code(), Some(0), "{}", run.err());
    assert_eq!(bench.run(&["export", "out.json", "--to", "toml", "-o", "corrected.toml"]).code(), Some(0));

    // Numbers of a file have nine digits, and the verdict's frame of the pose is one of two.
    let run = bench.run(&["simulate", "corrected.toml", "case/heldout/new.csv", "-o", "simulated.csv"]);
    assert_eq!((run.code(), run.err()), (Some(0), String::new()));
    let (own, of_verdict) = (end(&bench.read("simulated.csv")), end(&bench.read("poses/new.csv")));
    assert!((own[2] - of_verdict[2]).abs() < 1e-3, "{own:?} beside {of_verdict:?}");
    assert!((own[0] - of_verdict[0]).hypot(own[1] - of_verdict[1]) < 0.02, "{own:?} beside {of_verdict:?}");

    let run = bench.run(&[
        "predict",
        "case/robot.toml",
        "corrected.toml",
        "--drives",
        "new",
        "--json",
        "errors.json",
        "--out",
        "paths",
    ]);
    assert_eq!((run.code(), run.err()), (Some(0), String::new()));
    assert!(run.out().contains("position after 30 s, m"), "{}", run.out());
    let json: Value = serde_json::from_str(&bench.read("errors.json")).unwrap();
    let error = |robot: usize| json["drives"][0]["of"][robot]["medians"][2]["heading_rad"].as_f64().unwrap();
    assert!(error(1) < 0.1 * error(0), "{} beside {}", error(1), error(0));
    assert_eq!(end(&bench.read("paths/corrected/new.csv")).map(f64::is_finite), [true; 3]);

    bench.run(&["predict", "corrected.toml", "husky-a200", "--drives", "new"]).failed(&["compare robots of one kind"]);
    bench.run(&["predict", "corrected.toml", "--drives", "new", "--restart", "3"]).failed(&["leave out --restart"]);
    bench.run(&["simulate", "corrected.toml", "case/recordings"]).failed(&["one recording at a time, not 3: run_0"]);
    bench.run(&["simulate", "corrected.toml", "new/new.csv", "--mapping", "lacuna"]).failed(&["leave out --mapping"]);
}

#[test]
fn what_cannot_be_exported_is_one_clear_sentence() {
    let bench = bench();
    bench.write("cart.toml", ROBOT);
    for format in ["mjcf", "urdf", "sdf"] {
        let run = bench.run(&["export", "cart.toml", "--to", format]);
        run.failed(&["kind odometry have no masses and forces", "--to ros2"]);
    }
    let run = bench.run(&["export", "torque-mecanum-4", "--to", "mjcf"]);
    run.failed(&["rollers that lie askew", "export the robot to SDF"]);
    let run = bench.run(&["export", "torque-car", "--to", "sdf", "-o", "car.sdf"]);
    assert!(run.code() == Some(0) && run.err().contains("SDF does not hold lags of motors"), "{}", run.err());
    bench.run(&["export", "cart.toml", "--to", "json"]).failed(&["kind odometry are TOML", "--to toml"]);
    let run = bench.run(&["export", "cart.toml", "--to", "toml", "--retuned"]);
    assert!(run.code() == Some(2) && run.err().contains("take --nominal"), "{}", run.err());
    bench.write("driven.toml", crate::common::ROBOT);
    let run = bench.run(&["export", "driven.toml", "--to", "ros2"]);
    run.failed(&["is torque-driven", "sides skid in turns", "--robot skid-steer-4"]);
}

#[test]
fn a_drive_of_counts_alone_is_predicted_from_where_it_was_seen_or_from_the_origin() {
    let bench = bench();
    bench.write("case/heldout/new.csv", &counts_of(1.2, true));
    bench.write("case/heldout/blind.csv", &counts_of(1.2, false));
    let run = bench.run(&["diagnose", "case", "--predictions", "poses", "--json", "verdict.json"]);
    assert_eq!(run.code(), Some(0), "{}", run.err());

    let truth = end(&drive(1.2)
        .lines()
        .map(|l| l.splitn(4, ',').map(str::to_owned).collect::<Vec<_>>())
        .fold(String::new(), |all, cells| all + "t," + &cells[3] + "\n"));
    let off = |table: &str| {
        let [x, y, _] = end(&bench.read(table));
        (x - truth[0]).hypot(y - truth[1])
    };
    assert!(off("poses/new.csv") < 0.03, "{}", off("poses/new.csv"));
    // Without a pose it begins at the origin, which this drive does but for its noise.
    assert!(off("poses/blind.csv") < 0.05, "{}", off("poses/blind.csv"));
    assert_ne!(bench.read("poses/new.nominal.csv"), bench.read("poses/new.csv"), "a cause was named");
    let verdict: Value = serde_json::from_str(&bench.read("verdict.json")).unwrap();
    assert_eq!(verdict["sources"]["heldout"].as_array().unwrap().len(), 2);

    let run =
        bench.run(&["diagnose", "--robot", "case/robot.toml", "--recordings", "case/recordings", "--predictions", "p"]);
    assert!(run.err().contains("there is no held-out drive"), "{}", run.err());
}

#[test]
fn drives_of_a_fleet_are_diagnosed_one_by_one() {
    let bench = bench();
    bench.write("case/recordings/broken.csv", "t,left\n0,1\n");
    let run = bench.run(&["batch", "case", "-o", "out", "--page", "fleet.html", "--json", "counts.json"]);
    assert_eq!(run.code(), Some(3), "{} {}", run.out(), run.err());
    let counts: Value = serde_json::from_str(&bench.read("counts.json")).unwrap();
    assert_eq!((counts["units"]["done"].as_u64(), counts["units"]["failed"].as_u64()), (Some(3), Some(1)), "{counts}");
    assert!(bench.read("fleet.html").contains("radius"), "the page names the wheel");
    // The whole answer goes on to a page and to an export.
    let answer = std::fs::read_dir(bench.path("out/json")).unwrap().next().unwrap().unwrap().path();
    let answer = answer.display().to_string();
    for args in [["report", &answer, "-o", "page.html"], ["export", &answer, "--to", "toml"]] {
        assert_eq!(bench.run(&args).code(), Some(0), "{args:?}");
    }
    // In a folder of recordings, too; such robots take no mapping.
    let folder = ["batch", "case/recordings", "--robot", "case/robot.toml", "--limit", "1"];
    let run = bench.run(&[&folder[..], &["-o", "two"]].concat());
    assert!(run.out().contains("4 recordings"), "{} {}", run.out(), run.err());
    let run = bench.run(&[&folder[..], &["-o", "none", "--mapping", "lacuna"]].concat());
    assert_eq!(run.code(), Some(3), "{} {}", run.out(), run.err());
    let rows = std::fs::read_dir(bench.path("none/done")).unwrap().next().unwrap().unwrap().path();
    assert!(std::fs::read_to_string(rows).unwrap().contains("names its columns itself"), "the row says why");
}
