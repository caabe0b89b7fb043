//! `lacuna check` and `lacuna convert`.

use crate::common::{Bench, drive};
use serde_json::Value;

const RUN: &str = "case/recordings/run_1.csv";

fn check(bench: &Bench, args: &[&str]) -> (Option<i32>, Value) {
    let run = bench.run(&[&["check"], args, &["--json", "-"]].concat());
    (run.code(), serde_json::from_str(&run.out()).unwrap_or_else(|_| panic!("{}", run.err())))
}

#[test]
fn a_table_is_mapped_by_itself_and_its_channels_are_measured() {
    let bench = Bench::new();
    let run = bench.run(&["check", RUN]);
    assert_eq!((run.code(), run.err().as_str()), (Some(0), ""));
    assert!(run.out().contains("The built-in mapping skid-steer-columns fits these recordings."), "{}", run.out());
    let (code, json) = check(&bench, &[RUN]);
    assert_eq!(code, Some(0));
    let channel = &json["recordings"][0]["channels"][0];
    assert_eq!((channel["samples"].as_u64(), channel["unit"].as_str()), (Some(300), Some("rad/s")));
    assert!((channel["rate_hz"].as_f64().unwrap() - 100.0).abs() < 1e-6, "{channel}");
}

#[test]
fn what_the_signals_permit_is_said() {
    let bench = Bench::new();
    let (_, json) = check(&bench, &[RUN]);
    let sharper = "sharper with gyro_z, accel_x, accel_y, pose_x, pose_y, pose_yaw";
    assert_eq!(json["recordings"][0]["diagnoses"][0], format!("torque-driven robot: permitted; {sharper}"));
    bench.write("x.csv", "time_s,gyro_z_rad_s,torque_left_Nm\n0.00,0.1,1\n0.01,0.2,2\n0.02,0.1,3\n");
    let (_, json) = check(&bench, &["x.csv"]);
    let missing =
        "there is no torque_right, no wheel_angle_left or wheel_speed_left, no wheel_angle_right or wheel_speed_right";
    assert_eq!(json["recordings"][0]["diagnoses"][0], format!("torque-driven robot: not permitted, {missing}"));
}

#[test]
fn gaps_and_lost_rows_are_reported_and_end_with_3() {
    let bench = Bench::new();
    let mut rows: Vec<String> = drive(300, 0.5).lines().map(str::to_owned).collect();
    rows.drain(101..151);
    rows[200].push_str(",1");
    bench.write(RUN, &(rows.join("\n") + "\n"));
    let run = bench.run(&["check", RUN]);
    assert_eq!(run.code(), Some(3));
    assert!(run.out().contains("1 gap, the longest 0.51 s"), "{}", run.out());
    assert!(run.out().contains("Lost"), "{}", run.out());
}

#[test]
fn the_same_data_under_another_name_is_found() {
    let bench = Bench::new();
    bench.write("two/a.csv", &drive(300, 0.5));
    bench.write("two/b.csv", &(drive(300, 0.5) + "\n"));
    bench.write("two/c.csv", &drive(300, 0.9));
    let (_, json) = check(&bench, &["two"]);
    let same = json["same_content"].as_array().unwrap();
    assert_eq!(same.len(), 1, "{same:?}");
    assert_eq!(same[0].as_array().unwrap().len(), 2);
}

#[test]
fn a_table_that_no_mapping_fits_shows_its_columns_and_gets_a_skeleton() {
    let bench = Bench::empty();
    bench.write("x.csv", "zeit;links;notiz\n0,00;1,5;an\n0,01;;an\n0,02;-2,5;aus\n0,03;0,5\n");
    let run = bench.run(&["check", "x.csv", "--write-mapping", "map.toml"]);
    assert_eq!(run.code(), Some(3), "{}", run.err());
    for part in [
        "zeit          3      0      0       0  0.02000  a time: 0.02000 s at 100.0 Hz, in s\n",
        "links         2      1      0  -2.500    1.500\n",
        "notiz         0      0      3       -        -  text: an\n",
        "fields stand between semicolons, numbers have a decimal comma",
        "zeit is the time: it rises; in s, as most are; nothing says so",
        "Skeleton of a mapping: map.toml",
        "x.csv: 1 row has not as many fields as the header",
    ] {
        assert!(run.out().contains(part), "{part}: {}", run.out());
    }
    let empty = bench.run(&["check", "x.csv", "--mapping", "map.toml"]);
    assert!(empty.code() == Some(1) && empty.err().contains("has no signal"), "{}", empty.err());
    let skeleton = bench.read("map.toml");
    let line = "# SIGNAL = { column = \"links\", unit = \"UNIT\" }";
    bench.write("done.toml", &skeleton.replace(line, "gyro_z = { column = \"links\", unit = \"deg/s\" }"));
    let (code, json) = check(&bench, &["x.csv", "--mapping", "done.toml"]);
    assert_eq!(code, Some(3), "{json}");
    assert_eq!(json["recordings"][0]["channels"][0]["samples"], 2, "{json}");
    let (_, json) = check(&bench, &["x.csv"]);
    let table = &json["tables"][0];
    assert_eq!((table["delimiter"].as_str(), table["decimal"].as_str()), (Some(";"), Some(",")));
    assert_eq!((table["columns"][0]["time"]["unit"].as_str(), table["misfits"].as_u64()), (Some("s"), Some(1)));
}

#[test]
fn a_table_that_a_mapping_fits_and_that_is_broken_is_refused() {
    let bench = Bench::empty();
    bench.write("x.csv", &drive(300, 0.5).replace("\n0.02,", "\n0.02,fast"));
    let run = bench.run(&["check", "x.csv"]);
    assert_eq!(run.code(), Some(1));
    for part in ["no built-in mapping fits", "--mapping", "skid-steer-columns: x.csv: line 4", "fast"] {
        assert!(run.err().contains(part), "{part}: {}", run.err());
    }
    assert!(bench.run(&["check", "nowhere"]).err().contains("no file or folder 'nowhere'"));
}

#[test]
fn a_recording_goes_to_mcap_and_its_bag_is_checked() {
    let bench = Bench::new();
    let run = bench.run(&["convert", RUN, "--out", "run.mcap"]);
    assert_eq!((run.code(), run.err().as_str()), (Some(0), ""));
    assert_eq!(run.out(), "4 channels with 1200 samples written to run.mcap\n");
    let run = bench.run(&["check", "run.mcap", "--fields"]);
    assert_eq!(run.code(), Some(0), "{}", run.err());
    let fits = "The built-in mapping lacuna fits these recordings.";
    for part in ["wheel_speed_left", "torque_right", "300", "SHA-256", "value", fits] {
        assert!(run.out().contains(part), "{part}: {}", run.out());
    }
}

#[test]
fn what_convert_writes_needs_no_mapping_of_ones_own() {
    let bench = Bench::new();
    let (_, original) = check(&bench, &[RUN]);
    for name in ["run.mcap", "run.parquet"] {
        assert_eq!(bench.run(&["convert", RUN, "--out", name]).code(), Some(0));
        let (code, json) = check(&bench, &[name]);
        assert_eq!((code, &json["mapping"]["name"]), (Some(0), &Value::from("lacuna")));
        assert_eq!(json["recordings"][0]["channels"], original["recordings"][0]["channels"], "{name}");
    }
    let (_, json) = check(&bench, &["run.mcap", "run.parquet", "--mapping", "lacuna"]);
    assert_eq!(json["same_content"][0].as_array().map(Vec::len), Some(2), "{json}");
}

#[test]
fn what_csv_cannot_keep_is_reported() {
    let bench = Bench::empty();
    bench.write("pro_1.csv", "t,curL\n0.00,1\n0.01,2\n");
    let signal = "current_left = { column = \"curL\", unit = \"A\", magnitude_only = true, dead_band = 0.59 }";
    bench.write(
        "m.toml",
        &format!("[[files]]\npattern = \"*.csv\"\ntime = {{ column = \"t\", unit = \"s\" }}\nsignals.{signal}\n"),
    );
    let told = "current_left: magnitude_only, dead_band = 0.59 A";
    for (name, is_told) in [("a.csv", true), ("a.mcap", false)] {
        let run = bench.run(&["convert", "pro_1.csv", "--mapping", "m.toml", "--out", name]);
        assert_eq!((run.code(), run.out().contains(told)), (Some(0), is_told), "{}{}", run.out(), run.err());
    }
}

#[test]
fn csv_to_csv_changes_no_value() {
    let bench = Bench::new();
    assert_eq!(bench.run(&["convert", RUN, "--out", "a.csv"]).code(), Some(0));
    assert_eq!(bench.run(&["convert", "a.csv", "--out", "b.csv"]).code(), Some(0));
    assert_eq!(bench.read("a.csv"), bench.read("b.csv"));
    let (_, json) = check(&bench, &[RUN, "a.csv"]);
    assert_eq!(json["same_content"][0].as_array().map(Vec::len), Some(2), "{json}");
}

#[test]
fn a_file_that_is_there_is_kept_and_an_ending_must_say_the_format() {
    let bench = Bench::new();
    bench.write("out.parquet", "mine");
    let run = bench.run(&["convert", RUN, "--out", "out.parquet"]);
    assert_eq!(run.code(), Some(1));
    assert!(run.err().contains("--force"), "{}", run.err());
    assert_eq!(bench.read("out.parquet"), "mine");
    assert_eq!(bench.run(&["convert", RUN, "--out", "out.parquet", "--force"]).code(), Some(0));
    let run = bench.run(&["convert", RUN, "--out", "out.xlsx"]);
    assert_eq!(run.code(), Some(2));
    assert!(run.err().contains(".mcap, .parquet or .csv"), "{}", run.err());
}
