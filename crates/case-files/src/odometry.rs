//! Cases of robots whose wheel motion is compared with a pose: robot files of `kind = "odometry"`, tables of their drives.

use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use odometry::file::{RobotFile, Signals};
use odometry::{Case, Drive, diagnosis, left_out};
use verdict::Diagnosis;

use crate::case_folder::robot_of;
use crate::columns::{ColumnsEnvelope, Kind, robot_text};
use crate::drive_files::{NamesColumns, drives};
use crate::envelope::SourceFile;

/// A case with what was read for it.
#[derive(Debug)]
pub struct OdometryCase {
    /// The robot and its drives.
    pub case: Case,
    /// Drives whose pose is to be predicted.
    pub held_out: Vec<Drive>,
    /// The robot file, or the built-in robot's name.
    pub robot: String,
    /// What the robot file says.
    pub text: String,
    /// Files of the references, of the recordings, and of the drives to be predicted.
    pub files: [Vec<SourceFile>; 3],
    /// Other things in the folders, which were not read.
    pub ignored: Vec<String>,
}

/// The robot that is named, a file or built in; `None` where it is of another kind.
///
/// # Errors
/// A file that cannot be read, or holds what no such robot can have.
pub fn robot(name: &str) -> Result<Option<RobotFile>> {
    let Some(text) = text(name)? else { return Ok(None) };
    let shown = if Path::new(name).is_file() { name.to_owned() } else { format!("{name}.toml") };
    Ok(Some(RobotFile::parse(&shown, &text)?))
}

fn text(name: &str) -> Result<Option<String>> {
    robot_text(name, Kind::Odometry)
}

/// The case of a folder, or of a robot with files, if its robot is of this kind.
///
/// # Errors
/// As [`robot`]; tables that cannot be read.
pub fn read(folder: Option<&Path>, robot_name: Option<&str>, parts: [&[PathBuf]; 3]) -> Result<Option<OdometryCase>> {
    let name = match (robot_name, folder) {
        (Some(name), _) => name.to_owned(),
        // What is wrong with a folder without a robot is said where other kinds are read.
        (None, Some(folder)) => match robot_of(folder) {
            Ok(path) => path.display().to_string(),
            Err(_) => return Ok(None),
        },
        (None, None) => return Ok(None),
    };
    let Some((file, text)) = robot(&name)?.zip(text(&name)?) else { return Ok(None) };

    let mut ignored = Vec::new();
    let (drives, files) = drives((&name, &file), folder, parts, &mut ignored)?;
    let [references, recordings, held_out] = drives;
    if recordings.is_empty() {
        bail!(
            "robot '{name}' is of kind odometry, but there are no recordings; give CSV files or bags with --recordings"
        );
    }
    let case = Case { robot: file.robot, references, recordings };
    Ok(Some(OdometryCase { case, held_out, robot: name, text, files, ignored }))
}

impl NamesColumns for RobotFile {
    type Drive = Drive;

    fn time(&self) -> &str {
        &self.columns.time
    }

    fn columns(&self) -> Vec<&str> {
        let names = &self.columns;
        let body = names.pose.iter().flatten().chain(&names.gyro);
        names.wheels.iter().chain(&names.steering).chain(body).map(String::as_str).collect()
    }

    fn yaw(&self) -> Option<&str> {
        self.columns.pose.as_ref().map(|[_, _, yaw]| yaw.as_str())
    }

    fn of_table(&self, name: &str, text: &str, is_held_out: bool) -> Result<Drive> {
        Ok(if is_held_out { self.held_out(name, text)? } else { self.drive(name, text)? })
    }

    fn of_signals(&self, name: &str, signals: &Signals, is_held_out: bool) -> Result<Drive> {
        Ok(self.drive_of(name, signals, is_held_out)?)
    }

    fn told(drive: &mut Drive) -> &mut Vec<String> {
        &mut drive.told
    }

    fn described(drive: &Drive) -> String {
        let measured = if drive.heading_only { "the heading by a gyro" } else { "a pose" };
        let seen = drive.pose.iter().filter(|pose| pose[2].is_finite()).count();
        let seconds = drive.time.last().zip(drive.time.first()).map_or(0.0, |(last, first)| last - first);
        format!("{} rows in {seconds:.1} s, {measured} in {seen} of them", drive.time.len())
    }
}

impl OdometryCase {
    /// Diagnoses the case, and forecasts what is left out of the fit in turn.
    ///
    /// # Errors
    /// Drives that do not determine an answer.
    pub fn diagnose(&self, progress: &dyn Fn(&str)) -> Result<Diagnosis> {
        let findings = odometry::diagnose(&self.case, progress)?;
        let table = left_out(&self.case, progress)?;
        let mut out = diagnosis(&findings, &table, !self.case.references.is_empty());
        out.predicted_paths = self.held_out.iter().map(|d| findings.predict(&self.case.robot, d)).collect();
        Ok(out)
    }

    /// A diagnosis with what it was made from.
    pub fn envelope(&self, diagnosis: Diagnosis) -> ColumnsEnvelope {
        ColumnsEnvelope::new(Kind::Odometry, [&self.robot, &self.text], &self.files, &self.ignored, diagnosis)
    }
}
