//! Recordings that are longer than what a diagnosis rests on.

use crate::common::Bench;
use examiner::{Case, Content, EffectId, Setting, Settings, Severity, TyreLaw};
use serde_json::Value;

/// A bench with a case whose only recording is five minutes long.
fn bench() -> Bench {
    let settings = |duration_s| Settings {
        content: Content::Effects(vec![EffectId::Payload]),
        severity: Some(Severity::Strong),
        setting: Some(Setting::Normal),
        law: Some(TyreLaw::Brush),
        duration_s,
        references: 3,
        recordings: Some(1),
        heldout: 0,
        ..Settings::default()
    };
    let bench = Bench::empty();
    let write = |path: &str, bytes: &[u8]| bench.write(&format!("case/{path}"), std::str::from_utf8(bytes).unwrap());
    // The same seed gives the same robot, so that short references go with a long recording.
    for (path, bytes) in &Case::draw("x", 5, &settings(24.0)).unwrap().files {
        if !path.starts_with("recordings") {
            write(&path.display().to_string(), bytes);
        }
    }
    for (path, bytes) in &Case::draw("x", 5, &settings(300.0)).unwrap().files {
        if path.starts_with("recordings") {
            write(&path.display().to_string(), bytes);
        }
    }
    bench
}

#[test]
fn a_long_recording_is_screened_whole_and_diagnosed_on_its_budget() {
    let bench = bench();
    let run = bench.run(&["diagnose", "case", "--budget", "3", "--json", "out.json"]);
    assert_eq!(run.code(), Some(0), "{}", run.err());
    assert!(
        run.out().contains("Of 5.0 min of recordings, all screened, 3.0 min were diagnosed in full"),
        "{}",
        run.out()
    );
    assert!(run.out().contains("were screened but not diagnosed"), "{}", run.out());
    let json: Value = serde_json::from_str(&bench.read("out.json")).unwrap();
    crate::common::reads_back(&bench.read("out.json"));
    let diagnosis = &json["diagnosis"];
    assert_eq!(diagnosis["ranked"][0]["effect"], "payload", "{}", run.out());
    let coverage = &diagnosis["coverage"]["recordings"];
    assert_eq!((coverage["chosen"].as_array().unwrap().len(), &coverage["left_out"]), (3, &2.into()));
    // What is said of a stretch is given in the time of its recording.
    let last = &diagnosis["traces"].as_array().unwrap().last().unwrap();
    let [from, until] = [0, 1].map(|i| coverage["chosen"][2]["interval"][i].as_f64().unwrap());
    for time in last["time"].as_array().unwrap() {
        assert!((from..until).contains(&time.as_f64().unwrap()), "{time} of {from} to {until}");
    }
    // Nothing is lost of the sources.
    assert_eq!(json["sources"]["recordings"].as_array().unwrap().len(), 1);
}

#[test]
fn a_budget_is_three_minutes_or_more_or_everything() {
    let bench = bench();
    let all = bench.run(&["screen", "case", "--budget", "0"]);
    assert_eq!(all.code(), Some(0), "{}", all.err());
    let refused = bench.run(&["diagnose", "case", "--budget", "1"]);
    assert_eq!(refused.code(), Some(2));
    assert!(refused.err().contains("give 3 minutes or more, or 0 for everything"), "{}", refused.err());
}
