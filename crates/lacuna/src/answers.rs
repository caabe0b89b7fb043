//! Answers in the form that the blind examiner's scorer reads.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};
use diagnosis::{Diagnosis, Prediction, Verdict};
use serde_json::{Value, json};

/// Writes `OUT/<case>.json` and the predicted responses `OUT/<case>/<drive>.csv` and `<drive>.nominal.csv`.
///
/// # Errors
/// When a file cannot be written.
pub fn write(out: &Path, case: &str, diagnosis: &Diagnosis, seconds: f64) -> Result<()> {
    let verdict = match diagnosis.verdict {
        Verdict::Explained => "explained",
        Verdict::Unknown => "unknown",
        Verdict::NoMismatch | Verdict::Withheld => "no mismatch",
    };
    let ranked: Vec<Value> = diagnosis
        .ranked
        .iter()
        .map(|c| {
            json!({
                "effect": c.effect, "probability": c.probability, "magnitude": c.magnitude,
                "side": c.side, "interval_s": c.intervals,
            })
        })
        .collect();
    let answer = json!({ "case": case, "verdict": verdict, "seconds": seconds, "ranked": ranked });
    fs::create_dir_all(out.join(case)).with_context(|| format!("cannot create '{}'", out.join(case).display()))?;
    save(&out.join(format!("{case}.json")), &serde_json::to_string_pretty(&answer)?)?;
    for (corrected, plain) in &diagnosis.predictions {
        save(&out.join(case).join(format!("{}.csv", corrected.name)), &csv(corrected))?;
        save(&out.join(case).join(format!("{}.nominal.csv", plain.name)), &csv(plain))?;
    }
    Ok(())
}

fn csv(p: &Prediction) -> String {
    use std::fmt::Write as _;
    let mut out = String::from("time_s,wheel_speed_left_rad_s,wheel_speed_right_rad_s,yaw_rate_rad_s\n");
    for ((t, w), y) in p.time.iter().zip(&p.wheel_speed).zip(&p.yaw_rate) {
        // Writing to a string cannot fail.
        let _ = writeln!(out, "{t:.4},{:.5},{:.5},{y:.6}", w[0], w[1]);
    }
    out
}

fn save(path: &Path, text: &str) -> Result<()> {
    fs::write(path, text).with_context(|| format!("cannot write '{}'", path.display()))
}
