//! `lacuna next` from files to advice, a profile and a picture.

use crate::common::Bench;
use serde_json::Value;

/// Wheel radius and half track of the bench's robot, m.
const RADIUS: f64 = 0.1;
const HALF_TRACK: f64 = 0.2;

fn rows(csv: &str) -> Vec<Vec<f64>> {
    csv.lines().skip(1).map(|l| l.split(',').map(|c| c.parse().expect("a number")).collect()).collect()
}

#[test]
fn advice_comes_with_a_profile_that_reads_back_and_a_picture() {
    let bench = Bench::new();
    let args = ["next", "case", "--seconds", "6", "--profile", "p.csv", "--picture", "p.svg", "--json", "n.json"];
    let run = bench.run(&args);
    assert_eq!(run.code(), Some(0), "{}", run.err());
    assert!(run.out().contains("Drives, the best first"), "{}", run.out());
    let json: Value = serde_json::from_str(&bench.read("n.json")).unwrap();
    let drives = json["next"]["manoeuvres"].as_array().unwrap();
    let best = drives.iter().find(|m| m["joins"] == true).unwrap();
    let bits: Vec<f64> = drives.iter().map(|m| m["expected_bits"].as_f64().unwrap()).collect();
    assert!(bits.is_sorted_by(|a, b| a >= b), "{bits:?}");

    let csv = bench.read("p.csv");
    assert!(csv.starts_with("t_s,v_m_s,omega_rad_s,wheel_speed_left_rad_s,wheel_speed_right_rad_s,torque_free\n"));
    let rows = rows(&csv);
    assert_eq!((rows.len(), rows[0][0], rows[300][0]), (301, 0.0, 6.0));
    for r in &rows {
        let [v, w] = [0.5 * RADIUS * (r[3] + r[4]), 0.5 * RADIUS * (r[4] - r[3]) / (1.5 * HALF_TRACK)];
        assert!((v - r[1]).abs() < 1e-4 && (w - r[2]).abs() < 1e-3, "{r:?}");
    }
    // Points of the advice lie on the written curve, up to its rows.
    let number = |v: &Value| v.as_f64().unwrap();
    for p in best["profile"].as_array().unwrap() {
        let row = &rows[(50.0 * number(&p[0])).round() as usize];
        assert!((row[1] - number(&p[1])).abs() < 0.04 && (row[2] - number(&p[2])).abs() < 0.08, "{row:?} {p}");
    }
    assert!(bench.read("p.svg").starts_with("<svg"));

    let twice = bench.run(&["next", "case", "--seconds", "6", "--json", "-"]);
    let again: Value = serde_json::from_str(&twice.out()).unwrap();
    assert!(again == json, "another answer to the same question");
}

#[test]
fn a_drive_is_chosen_by_name_and_a_wrong_name_suggests_the_nearest() {
    let bench = Bench::new();
    let of = |name: &str| bench.run(&["next", "case", "--seconds", "6", "--manoeuvre", name, "--profile", "p.csv"]);
    let run = of("fast spins, both ways");
    assert_eq!(run.code(), Some(0), "{}", run.err());
    let rows = rows(&bench.read("p.csv"));
    assert!(rows.iter().all(|r| r[1] == 0.0) && rows.iter().any(|r| r[2].abs() > 0.1));
    let run = of("fast spin, both ways");
    assert_eq!(run.code(), Some(2));
    assert!(run.err().contains("did you mean 'fast spins, both ways'?"), "{}", run.err());
    let run = bench.run(&["next", "case", "--seconds", "1"]);
    assert_eq!(run.code(), Some(2));
    assert!(run.err().contains("between 4 and 120"), "{}", run.err());
}

#[test]
fn a_diagnosis_tells_the_next_drive_when_it_is_asked() {
    let bench = Bench::new();
    let run = bench.run(&["diagnose", "case", "--next", "--json", "d.json"]);
    assert_eq!(run.code(), Some(0), "{}", run.err());
    assert!(run.out().contains("The next drive"), "{}", run.out());
    crate::common::reads_back(&bench.read("d.json"));
    let run = bench.run(&["diagnose", "case", "--json", "-"]);
    let plain: Value = serde_json::from_str(&run.out()).unwrap();
    assert!(plain["diagnosis"]["next"].is_null());
}
