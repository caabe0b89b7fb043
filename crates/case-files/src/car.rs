//! Cases of cars: robot files of `kind = "car"`, tables of their drives.

use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use single_track::file::RobotFile;
use single_track::{Case, Drive, diagnosis, examine};
use verdict::Diagnosis;

use crate::bag_signals::{Found, Wanted};
use crate::case_folder::robot_of;
use crate::columns::{ColumnsEnvelope, Kind, robot_text};
use crate::envelope::SourceFile;
use crate::odometry::{Part, Recorded, drives};

/// A case with what was read for it.
#[derive(Debug)]
pub struct CarCase {
    /// The car and its drives.
    pub case: Case,
    /// Drives whose pose is to be predicted.
    pub held_out: Vec<Drive>,
    /// The robot file.
    pub robot: String,
    /// What it says.
    pub text: String,
    /// Files of the references, of the recordings, and of the drives to be predicted.
    pub files: [Vec<SourceFile>; 3],
    /// Other things in the folders, which were not read.
    pub ignored: Vec<String>,
}

/// The car of a robot file, and what the file says; `None` where it is of another kind.
///
/// # Errors
/// A file that cannot be read, or holds what no car can have.
pub fn robot(name: &str) -> Result<Option<(RobotFile, String)>> {
    let Some(text) = robot_text(name, Kind::Car)? else { return Ok(None) };
    let shown = if Path::new(name).is_file() { name.to_owned() } else { format!("{name}.toml") };
    Ok(Some((RobotFile::parse(&shown, &text)?, text)))
}

/// The case of a folder, or of a robot with files, if its robot is a car.
///
/// # Errors
/// A robot file or tables that cannot be read, or hold what no car can have.
pub fn read(folder: Option<&Path>, robot: Option<&str>, parts: [&[PathBuf]; 3]) -> Result<Option<CarCase>> {
    let name = match (robot, folder) {
        (Some(name), _) => name.to_owned(),
        // What is wrong with a folder without a robot is said where other kinds are read.
        (None, Some(folder)) => match robot_of(folder) {
            Ok(path) => path.display().to_string(),
            Err(_) => return Ok(None),
        },
        (None, None) => return Ok(None),
    };
    let Some((file, text)) = self::robot(&name)? else { return Ok(None) };
    let mut ignored = Vec::new();
    let columns = columns_of(&file);
    let wanted = Wanted { robot: &name, time: &file.columns.time, columns: &columns, yaw: file.columns.yaw.as_deref() };
    let (drives, files) = drives(folder, parts, &mut ignored, &wanted, |part, name, recorded| {
        let is_held_out = part == Part::HeldOut;
        Ok(match recorded {
            Recorded::Table(text) if is_held_out => file.held_out(name, text)?,
            Recorded::Table(text) => file.drive(name, text)?,
            Recorded::Bag(Found { signals, told, .. }) => {
                let mut drive = file.drive_of(name, signals, is_held_out)?;
                drive.told.extend(told.iter().cloned());
                drive
            }
        })
    })?;
    let [references, recordings, held_out] = drives;
    if recordings.is_empty() {
        bail!("robot '{name}' is of kind car, but there are no recordings; give CSV files or bags with --recordings");
    }
    let case = Case { car: file.car, references, recordings };
    Ok(Some(CarCase { case, held_out, robot: name, text, files, ignored }))
}

/// Columns that a drive of this car has beside its time.
pub(crate) fn columns_of(file: &RobotFile) -> Vec<&str> {
    let names = &file.columns;
    let optional = [&names.enabled, &names.gyro, &names.encoder, &names.x, &names.y, &names.yaw];
    [&names.throttle, &names.steering].into_iter().chain(optional.into_iter().flatten()).map(String::as_str).collect()
}

impl CarCase {
    /// Diagnoses the case, and forecasts what is left out of the fit in turn.
    ///
    /// # Errors
    /// Drives that do not determine an answer.
    pub fn diagnose(&self, progress: &dyn Fn(&str)) -> Result<Diagnosis> {
        let (findings, table) = examine(&self.case, progress)?;
        let mut out = diagnosis(&findings, &table, !self.case.references.is_empty());
        out.predicted_paths = self.held_out.iter().map(|d| findings.predict(d)).collect();
        Ok(out)
    }

    /// A diagnosis with what it was made from.
    pub fn envelope(&self, diagnosis: Diagnosis) -> ColumnsEnvelope {
        ColumnsEnvelope::new(Kind::Car, [&self.robot, &self.text], &self.files, &self.ignored, diagnosis)
    }
}
