//! Recordings and mappings that cannot be used: one message with file, place and what to do; exit code 1.

use std::fmt::Write as _;

use crate::common::{Bench, HEADER, drive};

const RUN: &str = "case/recordings/run_1.csv";

fn bench(recording: &str) -> Bench {
    let bench = Bench::new();
    bench.write(RUN, recording);
    bench
}

#[test]
fn an_empty_file() {
    bench("").refuses(&[RUN, "the file is empty", "give a CSV file"]);
}

#[test]
fn a_header_without_rows() {
    bench(HEADER).refuses(&[RUN, "line 1", "no row follows"]);
}

#[test]
fn text_in_a_number() {
    let text = drive(300, 0.5).replace("\n0.02,", "\n0.02,fast");
    bench(&text).refuses(&[RUN, "line 4", "column wheel_speed_left_rad_s", "fast", "not a number", "correct it"]);
}

#[test]
fn time_running_backwards() {
    let text = drive(300, 0.5).replace("\n2.05,", "\n0.01,");
    bench(&text).refuses(&[RUN, "line 207", "column time_s", "time runs backwards", "sort the rows"]);
}

#[test]
fn a_missing_column() {
    let text = drive(300, 0.5).replace("torque_left_Nm", "torque_lft_Nm");
    bench(&text).refuses(&[RUN, "run_1", "torque_left", "map a column"]);
}

#[test]
fn a_missing_column_that_the_mapping_asks_for() {
    let bench = Bench::new();
    bench.write("map.toml", &mapping("rad/s").replace("\"time_s\"", "\"stamp\""));
    let run = bench.run(&["diagnose", "case", "--mapping", "map.toml"]);
    run.failed(&["case/reference/ref_1.csv", "line 1", "no column `stamp`"]);
}

#[test]
fn a_recording_without_motion() {
    let mut text = HEADER.to_owned();
    for k in 0..300 {
        writeln!(text, "{:.2},0,0,0,0", f64::from(k) * 0.01).unwrap();
    }
    let bench = bench(&text);
    bench.refuses(&[RUN, "never turn", "record a drive"]);
    bench.run(&["identify", "case/robot.toml", RUN]).failed(&[RUN, "never turn", "record a drive"]);
}

#[test]
fn a_recording_that_is_too_short() {
    let bench = bench(&drive(12, 0.5));
    bench.refuses(&[RUN, "12 rows", "at least 201", "record longer"]);
    bench.run(&["identify", "case/robot.toml", RUN]).failed(&[RUN, "only 12 samples", "record longer"]);
}

#[test]
fn the_same_recording_as_reference_and_as_recording() {
    let bench = Bench::new();
    bench.write(RUN, &drive(300, 0.0));
    bench.refuses(&["case/reference/ref_1.csv", RUN, "same recording", "give it once"]);
}

#[test]
fn the_same_drive_with_other_ends_of_lines_or_without_its_first_rows() {
    let bench = Bench::new();
    let reference = drive(300, 0.0);
    bench.write(RUN, &reference.replace('\n', "\r\n"));
    bench.refuses(&["ref_1", "run_1", "their samples are the same", "give it once"]);
    let rows: Vec<&str> = reference.lines().collect();
    bench.write(RUN, &([&rows[..1], &rows[31..]].concat().join("\n") + "\n"));
    bench.refuses(&["their samples are the same"]);
}

fn mapping(unit: &str) -> String {
    let signal =
        |name: &str, unit: &str, column: &str| format!("{name} = {{ column = \"{column}\", unit = \"{unit}\" }}\n");
    "[[files]]\npattern = \"*.csv\"\ntime = { column = \"time_s\", unit = \"s\" }\n\n[files.signals]\n".to_owned()
        + &signal("wheel_speed_left", unit, "wheel_speed_left_rad_s")
        + &signal("torque_left", "N m", "torque_left_Nm")
}

#[test]
fn a_wrong_unit_in_a_mapping() {
    let bench = Bench::new();
    bench.write("map.toml", &mapping("kg"));
    bench.run(&["diagnose", "case", "--mapping", "map.toml"]).failed(&[
        "map.toml",
        "line 6",
        "wheel_speed_left",
        "`kg`",
    ]);
    bench.write("map.toml", &mapping("N m"));
    let run = bench.run(&["diagnose", "case", "--mapping", "map.toml"]);
    run.failed(&["map.toml", "line 6", "wheel_speed_left", "wrong unit `N m`", "rad/s"]);
}

#[test]
fn an_unknown_key_in_a_mapping() {
    let bench = Bench::new();
    bench.write("map.toml", &mapping("rad/s").replace("pattern", "patern"));
    bench.run(&["diagnose", "case", "--mapping", "map.toml"]).failed(&["map.toml", "line 2", "patern"]);
}

#[test]
fn a_mapping_that_is_not_there() {
    let bench = Bench::new();
    bench.run(&["diagnose", "case", "--mapping", "husky-opn"]).failed(&["husky-opn", "did you mean `husky-open`?"]);
    bench.run(&["diagnose", "case", "--mapping", "my/map.toml"]).failed(&["no mapping file 'my/map.toml'"]);
}
