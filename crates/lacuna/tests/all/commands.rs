//! Commands that succeed: help, catalogue, identifier.

use std::fmt::Write as _;

use crate::common::{Bench, drive};
use serde_json::Value;

#[test]
fn help_has_examples_for_every_command() {
    let bench = Bench::new();
    for args in [
        &["--help"][..],
        &["check", "--help"],
        &["convert", "--help"],
        &["diagnose", "--help"],
        &["identify", "--help"],
        &["effects", "--help"],
        &["explain", "--help"],
    ] {
        let run = bench.run(args);
        assert_eq!(run.code(), Some(0));
        assert!(run.out().contains("Examples:\n  lacuna "), "{}", run.out());
    }
    assert!(bench.run(&["--version"]).out().starts_with("lacuna "));
}

#[test]
fn effects_lists_what_explain_explains() {
    let bench = Bench::new();
    let run = bench.run(&["effects"]);
    assert_eq!((run.code(), run.err().as_str()), (Some(0), ""));
    assert!(run.out().contains("mass (kg)"));
    let json: Value = serde_json::from_str(&bench.run(&["effects", "--json", "-"]).out()).unwrap();
    let ids: Vec<&str> = json["effects"].as_array().unwrap().iter().map(|c| c["id"].as_str().unwrap()).collect();
    assert!(ids.len() >= 10);
    for id in ids {
        assert!(run.out().contains(id));
        let explanation = bench.run(&["explain", id]);
        assert_eq!(explanation.code(), Some(0));
        for part in [id, "law", "revealed by", "source", "parameter", "neutral"] {
            assert!(explanation.out().contains(part), "{}", explanation.out());
        }
    }
}

#[test]
fn every_name_that_a_verdict_can_contain_is_listed_and_explained() {
    let bench = Bench::new();
    let list = bench.run(&["effects"]).out();
    let json: Value = serde_json::from_str(&bench.run(&["effects", "--json", "-"]).out()).unwrap();
    let known = |key: &str| json[key].as_array().unwrap().iter().map(|c| c["id"].as_str().unwrap()).collect::<Vec<_>>();
    let ids = [known("effects"), known("causes")].concat();
    for name in catalogue::names() {
        assert!(list.lines().any(|line| line.split_whitespace().next() == Some(name)), "{name} is not listed");
        assert!(ids.contains(&name), "{name} is not in the JSON");
        let told = bench.run(&["explain", name]);
        assert_eq!((told.code(), told.err().as_str()), (Some(0), ""), "{name}");
        assert!(told.out().contains(&format!("({name})")), "{}", told.out());
    }
    let both = bench.run(&["explain", "motor_lag"]).out();
    assert!(both.contains("lag of the wheels' speed control") && both.contains("current loop"), "{both}");
}

#[test]
fn an_unknown_effect_suggests_the_nearest() {
    let run = Bench::new().run(&["explain", "paylod"]);
    assert_eq!(run.code(), Some(2));
    assert_eq!(run.err(), "error: no effect is called `paylod`; did you mean `payload`?\n");
    assert_eq!(run.out(), "");
}

const RUN: &str = "case/recordings/run_1.csv";

fn identify(bench: &Bench, more: &[&str]) -> (Option<i32>, Value) {
    let run = bench.run(&[&["identify", "case/robot.toml", RUN, "--json", "-"], more].concat());
    (run.code(), serde_json::from_str(&run.out()).unwrap_or_else(|_| panic!("{}", run.err())))
}

#[test]
fn identify_certifies_every_step() {
    let bench = Bench::new();
    let (code, json) = identify(&bench, &[]);
    assert_eq!(code, Some(0));
    assert!(json["worst_residual"].as_f64().unwrap() < 1e-10);
    assert_eq!(json["bound_holds"], true);
    assert_eq!(json["samples"]["count"], 300);
    assert_eq!(json["samples"]["gaps"], 0);
    let settled = &json["left"]["wheel_speed_error_rad_s"]["after_first_second"];
    assert!(settled["rmse"].as_f64().unwrap() < 0.5, "{settled}");
    let text = bench.run(&["identify", "case/robot.toml", RUN]).out();
    assert!(text.contains("mean-square bound held") && text.contains("the recording's own"), "{text}");
}

#[test]
fn identify_resamples_on_request() {
    let (_, json) = identify(&Bench::new(), &["--step", "0.001"]);
    assert_eq!(json["samples"]["count"], 2991);
    assert_eq!(json["samples"]["resampled"], true);
    assert_eq!(json["bound_holds"], true);
}

#[test]
fn identify_starts_anew_after_a_gap() {
    let bench = Bench::new();
    let text: Vec<String> =
        drive(300, 0.5).lines().enumerate().filter(|(k, _)| !(100..150).contains(k)).map(|l| l.1.to_owned()).collect();
    bench.write(RUN, &(text.join("\n") + "\n"));
    let (code, json) = identify(&bench, &[]);
    assert_eq!(code, Some(0));
    assert_eq!(json["samples"]["gaps"], 1);
    assert_eq!(json["samples"]["count"], 250);
    assert_eq!(json["bound_holds"], true);
}

#[test]
fn identify_depends_on_the_seed_only() {
    let bench = Bench::new();
    let [a, b, c] = ["1", "1", "2"].map(|seed| identify(&bench, &["--seed", seed]).1["left"].clone());
    assert_eq!(a, b);
    assert_ne!(a, c);
}

#[test]
fn lost_rows_exit_with_3_and_are_named() {
    let bench = Bench::new();
    bench.write(RUN, &drive(300, 0.5).replace("\n0.50,", "\n0.50,1,"));
    let (code, json) = identify(&bench, &[]);
    assert_eq!(code, Some(3));
    assert_eq!(json["lost"][0], "case/recordings/run_1.csv: 1 row skipped: wrong number of fields, line 52");
    let (code, _) = identify(&bench, &["--reading", "tolerant"]);
    assert_eq!(code, Some(3));
    let run = bench.run(&["identify", "case/robot.toml", RUN, "--reading", "strict"]);
    run.failed(&[RUN, "line 52"]);
}

#[test]
fn one_file_of_a_pair_is_enough_and_a_missing_one_is_reported() {
    let bench = Bench::new();
    let mut pro = "time,curL,curR,velL,velR\n".to_owned();
    let mut imu = "time,wx,wy,wz,ax,ay,az\n".to_owned();
    for k in 0..100 {
        let t = f64::from(k) / 6.5;
        writeln!(pro, "{t},5.0,5.0,{0},{0}", 0.5 + 0.1 * t.sin()).unwrap();
        writeln!(imu, "{t},0,0,0,0,0,9.81").unwrap();
    }
    bench.write("husky/pro_01.csv", &pro);
    bench.write("husky/imu_01.csv", &imu);
    bench.write("alone/pro_01.csv", &pro);
    let args = |file: &'static str| ["identify", "husky-a200", file, "--mapping", "husky-open"];
    let run = bench.run(&args("husky/pro_01.csv"));
    assert_eq!(run.code(), Some(0), "{}", run.err());
    assert!(run.out().contains("set-points") && run.out().contains("2.8 N m/A"), "{}", run.out());
    let run = bench.run(&args("alone/pro_01.csv"));
    assert_eq!(run.code(), Some(3));
    assert!(run.out().contains("alone/imu_01.csv: 1 file is missing"), "{}", run.out());
}

#[test]
fn completions_know_every_command_in_every_shell() {
    let bench = Bench::empty();
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let run = bench.run(&["completions", shell]);
        assert_eq!(run.code(), Some(0), "{}", run.err());
        for word in ["diagnose", "fail-on", "explain"] {
            assert!(run.out().contains(word), "{shell}: no {word}");
        }
    }
    let unknown = bench.run(&["completions", "zhs"]);
    assert_eq!(unknown.code(), Some(2));
    assert!(unknown.err().contains("zsh"), "{}", unknown.err());
}

#[test]
fn there_is_a_manual_page_for_every_command() {
    let bench = Bench::empty();
    let first = bench.run(&["man"]);
    assert!(first.out().contains(".TH lacuna 1"), "{}", first.out());
    assert_eq!(bench.run(&["man", "--out", "pages"]).code(), Some(0));
    assert_eq!(bench.read("pages/lacuna.1"), first.out());
    let page = bench.read("pages/lacuna-diagnose.1");
    for word in ["lacuna\\-diagnose", "fail", "Exit codes"] {
        assert!(page.contains(word), "no {word} in {page}");
    }
}

#[test]
fn a_wrong_command_suggests_the_nearest() {
    let run = Bench::empty().run(&["diagnos", "case"]);
    assert_eq!((run.code(), run.out()), (Some(2), String::new()));
    assert!(run.err().contains("a similar subcommand exists: 'diagnose'"), "{}", run.err());
}

#[test]
fn pipes_get_no_colour_and_no_progress() {
    let bench = Bench::new();
    let runs = [
        bench.run(&["check", "case/recordings"]),
        bench.run(&["explain", "payload"]),
        bench.run(&["effects"]),
        bench.run(&["diagnose", "nowhere"]),
        bench.run(&["diagnose", "--help"]),
        bench.run(&["diagnose", "case", "--robot", "husky"]),
    ];
    for run in runs {
        assert!(!run.out().contains('\u{1b}') && !run.err().contains('\u{1b}'), "{}{}", run.out(), run.err());
        assert!(run.code() != Some(0) || run.err().is_empty(), "{}", run.err());
    }
}

#[test]
fn a_conversion_is_reported_as_json() {
    let bench = Bench::new();
    let run = bench.run(&["convert", RUN, "--out", "run.csv", "--json", "-"]);
    assert_eq!(run.code(), Some(0), "{}", run.err());
    let json: Value = serde_json::from_str(&run.out()).unwrap();
    assert_eq!((&json["format"], &json["program"]["name"]), (&1.into(), &"lacuna".into()));
    assert_eq!(
        (&json["written"][0], &json["channels"], &json["samples"]),
        (&"run.csv".into(), &4.into(), &1200.into())
    );
    assert!(json["not_kept"].is_array());
    assert_eq!(json["sources"][0]["sha256"].as_str().map(str::len), Some(64));
}

#[test]
fn colours_can_be_asked_for_and_no_color_goes_before() {
    let out = |variables: &[(&str, &str)]| {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_lacuna"));
        command.args(["explain", "payload"]).env_remove("NO_COLOR").env_remove("CLICOLOR_FORCE");
        let output = command.envs(variables.iter().copied()).output().unwrap();
        String::from_utf8(output.stdout).unwrap()
    };
    assert!(out(&[("CLICOLOR_FORCE", "1")]).contains('\u{1b}'));
    assert!(!out(&[("CLICOLOR_FORCE", "1"), ("NO_COLOR", "1")]).contains('\u{1b}'));
}

#[test]
fn every_built_in_robot_is_written_as_a_file_that_reads_back() {
    let bench = Bench::empty();
    for name in ["husky-a200", "hendzel-trojnacki-2014", "differential", "dart"] {
        let run = bench.run(&["export", name, "--to", "toml", "-o", "robot.toml", "--force"]);
        assert_eq!(run.code(), Some(0), "{name}: {}", run.err());
        let again = bench.run(&["export", "robot.toml", "--to", "toml"]);
        assert_eq!(again.code(), Some(0), "{name}: {}", again.err());
    }
    bench
        .run(&["export", "husky", "--to", "toml"])
        .failed(&["neither a robot file nor a built-in robot", "did you mean `husky-a200`"]);
}
