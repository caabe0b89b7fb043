//! Cases of robots of any wheels under torque: robot files of `kind = "wheeled"`, tables and bags of their drives.

use std::path::{Path, PathBuf};

use ::odometry::file::Signals;
use ::wheeled::file::RobotFile;
use ::wheeled::{Case, Drive, diagnosis, examine};
use anyhow::{Result, bail};
use verdict::Diagnosis;

use crate::case_folder::robot_of;
use crate::columns::{ColumnsEnvelope, Kind, robot_text};
use crate::drive_files::{NamesColumns, drives};
use crate::envelope::SourceFile;

/// A case with what was read for it.
#[derive(Debug)]
pub struct WheeledCase {
    /// The robot and its drives.
    pub case: Case,
    /// Drives whose pose is to be predicted.
    pub held_out: Vec<Drive>,
    /// The robot file, or the built-in robot's name.
    pub robot: String,
    /// What it says.
    pub text: String,
    /// Files of the references, of the recordings, and of the drives to be predicted.
    pub files: [Vec<SourceFile>; 3],
    /// Other things in the folders, which were not read.
    pub ignored: Vec<String>,
}

/// The robot of a robot file, and what the file says; `None` where it is of another kind.
///
/// # Errors
/// A file that cannot be read, or holds what no such robot can have.
pub fn robot(name: &str) -> Result<Option<(RobotFile, String)>> {
    let Some(text) = robot_text(name, Kind::Wheeled)? else { return Ok(None) };
    let shown = if Path::new(name).is_file() { name.to_owned() } else { format!("{name}.toml") };
    Ok(Some((RobotFile::parse(&shown, &text)?, text)))
}

/// The case of a folder, or of a robot with files, if its robot is of this kind.
///
/// # Errors
/// A robot file or tables that cannot be read, or hold what no such robot can have.
pub fn read(folder: Option<&Path>, robot: Option<&str>, parts: [&[PathBuf]; 3]) -> Result<Option<WheeledCase>> {
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
    let (drives, files) = drives((&name, &file), folder, parts, &mut ignored)?;
    let [references, recordings, held_out] = drives;
    if recordings.is_empty() {
        bail!(
            "robot '{name}' is of kind wheeled, but there are no recordings; give CSV files or bags with --recordings"
        );
    }
    let case = Case { robot: file.robot, references, recordings };
    Ok(Some(WheeledCase { case, held_out, robot: name, text, files, ignored }))
}

impl NamesColumns for RobotFile {
    type Drive = Drive;

    fn time(&self) -> &str {
        &self.columns.time
    }

    fn columns(&self) -> Vec<&str> {
        self.names().collect()
    }

    fn yaw(&self) -> Option<&str> {
        self.columns.pose.as_ref().map(|[_, _, yaw]| yaw.as_str())
    }

    fn of_table(&self, name: &str, text: &str, is_held_out: bool) -> Result<Drive> {
        Ok(self.drive(name, text, is_held_out)?)
    }

    fn of_signals(&self, name: &str, signals: &Signals, is_held_out: bool) -> Result<Drive> {
        Ok(self.drive_of(name, signals, is_held_out)?)
    }

    fn told(drive: &mut Drive) -> &mut Vec<String> {
        &mut drive.told
    }

    fn described(drive: &Drive) -> String {
        let pose = if drive.has_pose() { "with a pose" } else { "without a pose" };
        format!("{:.1} s, {pose}", drive.duration())
    }
}

impl WheeledCase {
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
        ColumnsEnvelope::new(Kind::Wheeled, [&self.robot, &self.text], &self.files, &self.ignored, diagnosis)
    }
}
