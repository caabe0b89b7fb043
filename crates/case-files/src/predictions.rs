//! Predicted responses of held-out drives as CSV.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};
use verdict::{Diagnosis, Prediction, SimulatedPath};

/// Writes `DIR/<drive>.csv` (corrected) and `DIR/<drive>.nominal.csv` (calibrated, without the effect).
///
/// # Errors
/// When the folder or a file cannot be written.
pub fn write(dir: &Path, diagnosis: &Diagnosis) -> Result<()> {
    fs::create_dir_all(dir).with_context(|| format!("cannot create '{}'", dir.display()))?;
    for (corrected, plain) in &diagnosis.predictions {
        let stem = file_stem(&corrected.name);
        save(&dir.join(format!("{stem}.csv")), &csv(corrected))?;
        save(&dir.join(format!("{stem}.nominal.csv")), &csv(plain))?;
    }
    Ok(())
}

/// Writes `DIR/<drive>.csv` (corrected) and `DIR/<drive>.nominal.csv` (re-tuned) of robots that are compared by their pose;
/// cells of rows in which no pose is predicted are empty.
///
/// # Errors
/// When the folder or a file cannot be written.
pub fn write_paths(dir: &Path, diagnosis: &Diagnosis) -> Result<()> {
    fs::create_dir_all(dir).with_context(|| format!("cannot create '{}'", dir.display()))?;
    for path in &diagnosis.predicted_paths {
        let stem = file_stem(&path.name);
        save(&dir.join(format!("{stem}.csv")), &csv_of_path(&path.time, &path.corrected))?;
        save(&dir.join(format!("{stem}.nominal.csv")), &csv_of_path(&path.time, &path.retuned))?;
    }
    Ok(())
}

/// Writes `DIR/<drive>.csv` of a robot that is compared by its pose.
///
/// # Errors
/// When the folder or the file cannot be written.
pub fn write_path(dir: &Path, path: &SimulatedPath) -> Result<()> {
    fs::create_dir_all(dir).with_context(|| format!("cannot create '{}'", dir.display()))?;
    save(&dir.join(format!("{}.csv", file_stem(&path.name))), &csv_of_path(&path.time, &path.pose))
}

/// `time_s,x_m,y_m,yaw_rad`; cells of rows without a pose are empty.
pub fn csv_of_path(time: &[f64], poses: &[[f64; 3]]) -> String {
    use std::fmt::Write as _;
    let mut out = String::from("time_s,x_m,y_m,yaw_rad\n");
    for (t, [x, y, yaw]) in time.iter().zip(poses) {
        // Writing to a string cannot fail.
        let _ = if x.is_finite() { writeln!(out, "{t:.4},{x:.5},{y:.5},{yaw:.6}") } else { writeln!(out, "{t:.4},,,") };
    }
    out
}

/// Writes `DIR/<drive>.csv`.
///
/// # Errors
/// When the folder or the file cannot be written.
pub fn write_one(dir: &Path, prediction: &Prediction) -> Result<()> {
    fs::create_dir_all(dir).with_context(|| format!("cannot create '{}'", dir.display()))?;
    save(&dir.join(format!("{}.csv", file_stem(&prediction.name))), &csv(prediction))
}

/// A drive's name without what would lead into another folder.
fn file_stem(name: &str) -> String {
    name.replace(['/', '\\'], "_")
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

/// Writes a text file.
pub(crate) fn save(path: &Path, text: &str) -> Result<()> {
    fs::write(path, text).with_context(|| format!("cannot write '{}'", path.display()))
}
