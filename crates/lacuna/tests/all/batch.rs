//! `lacuna batch` and `lacuna merge`: whatever the way to the table, its bytes are the same.

use std::collections::HashMap;
use std::fs::{self, File};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use crate::common::Bench;
use examiner::{Case, Content, EffectId, Setting, Settings, Severity, TyreLaw};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use serde_json::Value;

/// Recordings of the drawn robot.
const DRAWN: usize = 4;

/// Two case folders, one deeper than the other, of one drawn robot; in the first also a file that is no recording.
fn fleet() -> Bench {
    let settings = Settings {
        content: Content::Effects(vec![EffectId::Payload]),
        severity: Some(Severity::Strong),
        setting: Some(Setting::Normal),
        law: Some(TyreLaw::Brush),
        duration_s: 6.0,
        references: 1,
        recordings: Some(DRAWN),
        heldout: 0,
        least_excess: 0.0,
        ..Settings::default()
    };
    let drawn = Case::draw("x", 5, &settings).unwrap();
    let bench = Bench::empty();
    for (path, bytes) in &drawn.files {
        let path = path.display().to_string();
        let is_last = ["run_3", "run_4"].iter().any(|run| path.contains(run));
        if !is_last {
            bench.write_bytes(&format!("fleet/a/{path}"), bytes);
        }
        if is_last || !path.starts_with("recordings") {
            bench.write_bytes(&format!("fleet/north/b/{path}"), bytes);
        }
    }
    bench.write("fleet/a/recordings/run_9.csv", "time_s,wheel\n0,x\n");
    bench
}

fn bytes(bench: &Bench, name: &str) -> Vec<u8> {
    fs::read(bench.path(name)).unwrap()
}

/// The rows of a table, by column.
fn rows(file: &Path) -> Vec<HashMap<String, Field>> {
    let reader = SerializedFileReader::new(File::open(file).unwrap()).unwrap();
    let rows = reader.get_row_iter(None).unwrap();
    rows.map(|row| row.unwrap().into_columns().into_iter().collect()).collect()
}

fn text(field: &Field) -> &str {
    let Field::Str(text) = field else { panic!("{field} is no text") };
    text
}

fn list(field: &Field) -> Vec<String> {
    let Field::ListInternal(list) = field else { panic!("{field} is no list") };
    list.elements().iter().map(ToString::to_string).collect()
}

/// Names in a folder.
fn names(bench: &Bench, folder: &str) -> Vec<String> {
    let Ok(entries) = fs::read_dir(bench.path(folder)) else { return Vec::new() };
    let mut out: Vec<String> = entries.map(|e| e.unwrap().file_name().to_string_lossy().into_owned()).collect();
    out.retain(|name| !name.starts_with('.'));
    out.sort();
    out
}

#[test]
fn shards_threads_and_a_kill_give_the_same_bytes_and_one_bad_file_is_a_row() {
    let bench = fleet();
    let whole = bench.run(&["batch", "fleet", "-o", "whole", "--threads", "1", "--json", "counts.json", "-v"]);
    assert_eq!(whole.code(), Some(3), "{}", whole.err());
    assert!(whole.out().starts_with("5 recordings: 0 done before, 5 to do\n"), "{}", whole.out());
    // A line for each recording, and one for each robot that is prepared.
    assert_eq!(whole.err().lines().filter(|l| l.contains("s] done ") || l.contains("s] failed ")).count(), 5);
    assert_eq!(whole.err().lines().filter(|l| l.contains("s] prepared ")).count(), 2, "{}", whole.err());
    let counts: Value = serde_json::from_str(&bench.read("counts.json")).unwrap();
    assert_eq!(counts["units"]["done"], DRAWN);
    assert_eq!((&counts["failed"], &counts["robots"]["north/b"]["rows"]), (&1.into(), &2.into()));

    the_table(&bench);
    let answers = names(&bench, "whole/json");
    assert_eq!(answers.len(), DRAWN);
    alone(&bench, &answers[0]);

    // Shards on two threads, in folders of their own.
    for shard in 1..=3 {
        let run = bench.run(&["batch", "fleet", "--shard", &format!("{shard}/3"), "-o", &format!("part-{shard}")]);
        assert!([Some(0), Some(3)].contains(&run.code()), "{}", run.err());
        assert!(run.out().contains(&format!("of this shard ({shard}/3 of 5)")), "{}", run.out());
    }
    let merge = ["merge", "part-3", "part-1", "part-2", "-o", "all", "--page", "fleet.html"];
    let merged = bench.run(&merge);
    assert_eq!(merged.code(), Some(3), "{}", merged.err());
    assert_eq!(bytes(&bench, "all/rows.parquet"), bytes(&bench, "whole/rows.parquet"));
    assert_eq!(names(&bench, "all/json"), answers);
    for name in &answers {
        assert_eq!(bytes(&bench, &format!("all/json/{name}")), bytes(&bench, &format!("whole/json/{name}")));
    }
    let page = bench.read("fleet.html");
    assert!(page.contains("north/b") && page.contains("a/run_9") && page.contains("Content-Security-Policy"));
    // A shard that was run twice counts once.
    let again = bench.run(&["merge", "all", "part-2", "-o", "more"]);
    assert_eq!(again.code(), Some(3), "{}", again.err());
    assert_eq!(bytes(&bench, "more/rows.parquet"), bytes(&bench, "whole/rows.parquet"));

    killed(&bench);
    two_answers(&bench);
}

/// What stands in the table.
fn the_table(bench: &Bench) {
    let rows = rows(&bench.path("whole/rows.parquet"));
    let ids: Vec<&str> = rows.iter().map(|r| text(&r["id"])).collect();
    assert_eq!(ids, ["a/run_1", "a/run_2", "a/run_9", "north/b/run_3", "north/b/run_4"]);
    let failed = &rows[2];
    assert_eq!((text(&failed["outcome"]), &failed["verdict"]), ("failed", &Field::Null));
    assert!(text(&failed["error"]).contains("run_9.csv"), "{}", failed["error"]);
    for row in rows.iter().filter(|row| text(&row["id"]) != "a/run_9") {
        assert_eq!((text(&row["outcome"]), &row["error"]), ("done", &Field::Null));
        assert_eq!(text(&row["causality"]), "torque-driven");
        let Field::Double(duration) = row["duration_s"] else { panic!("no duration") };
        assert!((duration - 6.0).abs() < 0.2, "{duration}");
        assert_eq!(row["date"], Field::Null, "its stamps count from its start");
        // Named effects and their probabilities belong together.
        let (effects, probabilities) = (list(&row["effects"]), list(&row["probabilities"]));
        assert_eq!(effects.len(), probabilities.len());
        assert!(effects.iter().any(|e| e.contains("none")), "{effects:?}");
        assert_eq!(list(&row["source"]).len(), 2, "a recording and a reference");
        // What the row says is what the answer says.
        let answer: Value = serde_json::from_str(&bench.read(&format!("whole/{}", text(&row["json"])))).unwrap();
        assert_eq!(answer["diagnosis"]["verdict"], text(&row["verdict"]));
        let cause = answer["diagnosis"]["ranked"].as_array().unwrap().iter();
        let cause = cause.clone().find(|c| c["effect"] != "none" && c["effect"] != "unknown").unwrap();
        assert_eq!(cause["effect"], text(&row["cause_1_effect"]));
        assert_eq!(Field::Double(cause["probability"].as_f64().unwrap()), row["cause_1_probability"]);
        if let (Some(m), Some(s)) = (cause["magnitude"].as_f64(), cause["sigma"].as_f64()) {
            let Field::Double(low) = row["cause_1_low"] else { panic!("no lower end") };
            assert!((low - (m - 1.645 * s)).abs() < 1e-12);
        }
        let sha: Vec<&str> =
            answer["sources"]["recordings"].as_array().unwrap().iter().map(|s| s["sha256"].as_str().unwrap()).collect();
        assert!(list(&row["source_sha256"]).iter().any(|s| s.contains(sha[0])));
    }
}

/// The answer of a batch is that of `lacuna diagnose`, byte for byte, although references are calibrated once.
fn alone(bench: &Bench, name: &str) {
    assert!(name.starts_with("a_run_1."), "{name}");
    let run = bench.run(&[
        "diagnose",
        "--robot",
        "fleet/a/robot.json",
        "--reference",
        "fleet/a/reference",
        "--recordings",
        "fleet/a/recordings/run_1.csv",
        "--json",
        "-",
    ]);
    assert_eq!(run.out(), bench.read(&format!("whole/json/{name}")));
    crate::common::reads_back(&run.out());
}

/// A run that is killed after its first answers goes on where it was.
fn killed(bench: &Bench) {
    let mut child = Command::new(env!("CARGO_BIN_EXE_lacuna"))
        .args(["batch", "fleet", "-o", "killed", "--threads", "2"])
        .current_dir(bench.path(""))
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    while names(bench, "killed/json").is_empty() && child.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(2));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(!bench.path("killed/rows.parquet").exists(), "it was killed too late to test anything");
    let before = names(bench, "killed/done").len();
    let run = bench.run(&["batch", "fleet", "-o", "killed", "--threads", "2"]);
    assert_eq!(run.code(), Some(3), "{}", run.err());
    // What failed is tried again.
    let failed = names(bench, "killed/done").iter().filter(|name| name.starts_with("a_run_9")).count();
    assert!(before <= DRAWN + failed, "{before}");
    assert_eq!(bytes(bench, "killed/rows.parquet"), bytes(bench, "whole/rows.parquet"));
    let again = bench.run(&["batch", "fleet", "-o", "killed"]);
    assert!(again.out().starts_with("5 recordings: 4 done before, 1 to do\n"), "{}", again.out());
    assert_eq!(bytes(bench, "killed/rows.parquet"), bytes(bench, "whole/rows.parquet"));
}

/// A unit with two answers is refused, with both places.
fn two_answers(bench: &Bench) {
    let row = names(bench, "whole/done").into_iter().find(|name| name.starts_with("a_run_1.")).unwrap();
    let other = bench.read(&format!("whole/done/{row}")).replace("\"probability\": ", "\"probability\": 1");
    bench.write(&format!("other/done/{row}"), &other);
    let run = bench.run(&["merge", "whole", "other", "-o", "both"]);
    run.failed(&["'a/run_1' has two answers", &format!("whole/done/{row}"), &format!("other/done/{row}")]);
}

#[test]
fn what_changed_is_done_again_and_a_new_label_is_only_written() {
    let bench = fleet();
    let list = |robot: &str, date: &str| {
        format!(
            "recording,id,robot,reference,robot_id,date\n\
             fleet/a/recordings/run_1.csv,one,fleet/a/robot.json,fleet/a/reference,{robot},{date}\n\
             fleet/a/recordings/run_2.csv,two,fleet/a/robot.json,fleet/a/reference,{robot},\n"
        )
    };
    bench.write("list.csv", &list("unit-17", "2026-03-01"));
    let first = bench.run(&["batch", "list.csv", "-o", "out", "--limit", "1"]);
    assert_eq!(first.code(), Some(0), "{}", first.err());
    assert!(
        first.out().starts_with("2 recordings: 0 done before, 1 to do, 1 left for another run\n"),
        "{}",
        first.out()
    );
    let second = bench.run(&["batch", "list.csv", "-o", "out"]);
    assert!(second.out().starts_with("2 recordings: 1 done before, 1 to do\n"), "{}", second.out());

    bench.write("list.csv", &list("unit-18", "2026-03-02T01:00:00+01:00"));
    let third = bench.run(&["batch", "list.csv", "-o", "out", "--page", "fleet.html"]);
    assert!(third.out().starts_with("2 recordings: 2 done before, 0 to do\n"), "{}", third.out());
    let table = rows(&bench.path("out/rows.parquet"));
    assert_eq!(table.iter().map(|r| text(&r["robot_id"])).collect::<Vec<_>>(), ["unit-18", "unit-18"]);
    assert_eq!(table[0]["date"], Field::TimestampMillis(1_772_409_600_000));
    assert_eq!(table[1]["date"], Field::Null);
    assert!(bench.read("fleet.html").contains("unit-18"));

    let shorter = bench.read("fleet/a/recordings/run_2.csv");
    let cut = shorter.trim_end().rfind('\n').unwrap();
    bench.write("fleet/a/recordings/run_2.csv", &shorter[..=cut]);
    let fourth = bench.run(&["batch", "list.csv", "-o", "out"]);
    assert!(fourth.out().starts_with("2 recordings: 1 done before, 1 to do\n"), "{}", fourth.out());
    assert_eq!(names(&bench, "out/json").len(), 2, "the answer of the old bytes is gone");

    // An answer for a robot that nobody changed is another one: no mass, motor or wheel is weighed.
    let fifth = bench.run(&["batch", "list.csv", "-o", "out", "--same-robot"]);
    assert!(fifth.out().starts_with("2 recordings: 0 done before, 2 to do\n"), "{}", fifth.out());
    for name in names(&bench, "out/json") {
        let answer = bench.read(&format!("out/json/{name}"));
        assert!(!answer.contains("\"payload\"") && answer.contains("viscous_friction"), "{name}");
    }
}

#[test]
fn mistakes_are_refused_before_any_work() {
    let bench = Bench::new();
    bench.write("list.csv", "recording,robot,robot_if\ncase/recordings/run_1.csv,case/robot.toml,x\n");
    let run = bench.run(&["batch", "list.csv", "-o", "out"]);
    run.failed(&["list.csv: line 1, column 17: unknown column `robot_if`; did you mean `robot_id`?"]);
    bench.run(&["batch", "nowhere", "-o", "out"]).failed(&["there is no folder or list 'nowhere'", "--robot"]);
    bench.run(&["batch", "case/reference", "-o", "out"]).failed(&["no case folder", "--robot"]);
    bench.run(&["batch", "case", "--mapping", "none", "-o", "out"]).failed(&["none"]);
    bench.run(&["merge", "case", "-o", "all"]).failed(&["'case' has no folder 'done/'", "lacuna batch"]);
    for args in [&["--threads", "0"][..], &["--shard", "0/3"], &["--reference", "case/reference"]] {
        let run = bench.run(&[&["batch", "case", "-o", "out"], args].concat());
        assert_eq!(run.code(), Some(2), "{args:?}: {}", run.err());
    }
    assert!(!bench.path("out/rows.parquet").exists());
}

#[test]
fn a_robot_without_references_is_compared_with_its_file() {
    let bench = Bench::new();
    bench.remove("case/reference");
    let run = bench.run(&["batch", "case", "-o", "out", "--json", "-"]);
    assert_eq!(run.code(), Some(0), "{}", run.err());
    let counts: Value = serde_json::from_str(&run.out()).unwrap();
    assert_eq!(counts["failures"].as_array().map(Vec::len), Some(0), "{counts}");
    assert_ne!(text(&rows(&bench.path("out/rows.parquet"))[0]["outcome"]), "failed");
}
