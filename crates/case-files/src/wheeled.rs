//! Cases of robots of any wheels under torque: robot files of `kind = "wheeled"`, tables and bags of their drives.

use std::path::{Path, PathBuf};

use ::odometry::file::Signals;
use ::wheeled::file::RobotFile;
use ::wheeled::{Case, Drive, diagnosis, examine};
use anyhow::Result;
use hierarchical_fit::Table;
use verdict::{Diagnosis, SimulatedPath};

use crate::columns::Kind;
use crate::drive_files::{self, NamesColumns, Origin};

/// A case with what was read for it.
#[derive(Debug)]
pub struct WheeledCase {
    /// The robot and its drives.
    pub case: Case,
    /// Drives whose pose is to be predicted.
    pub held_out: Vec<Drive>,
    /// What was read for it.
    pub origin: Origin,
}

/// The case of a folder, or of a robot with files, if its robot is of this kind.
///
/// # Errors
/// A robot file or recordings that cannot be read, or hold what no such robot can have.
pub fn read(folder: Option<&Path>, robot: Option<&str>, parts: [&[PathBuf]; 3]) -> Result<Option<WheeledCase>> {
    let Some((file, [references, recordings, held_out], origin)) =
        drive_files::read::<RobotFile>(folder, robot, parts)?
    else {
        return Ok(None);
    };
    Ok(Some(WheeledCase { case: Case { robot: file.robot, references, recordings }, held_out, origin }))
}

impl NamesColumns for RobotFile {
    type Drive = Drive;
    const KIND: Kind = Kind::Wheeled;

    fn read(shown: &str, text: &str) -> Result<Self> {
        Ok(Self::parse(shown, text)?)
    }

    fn time(&self) -> &str {
        &self.columns.time
    }

    fn columns(&self) -> Vec<&str> {
        self.names().collect()
    }

    fn yaw(&self) -> Option<&str> {
        self.columns.pose.as_ref().map(|[_, _, yaw]| yaw.as_str())
    }

    fn of_table(&self, table: &Table, is_held_out: bool) -> Result<Drive> {
        Ok(self.drive(table, is_held_out)?)
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

    fn simulated(&self, drive: &Drive) -> SimulatedPath {
        ::wheeled::simulate(&self.robot, drive)
    }
}

impl WheeledCase {
    /// Diagnoses the case, and forecasts what is left out of the fit in turn.
    ///
    /// # Errors
    /// Drives that do not determine an answer.
    pub fn diagnose(&self, next: Option<f64>, progress: &dyn Fn(&str)) -> Result<Diagnosis> {
        let (findings, table) = examine(&self.case, next, progress)?;
        let mut out = diagnosis(&findings, &table, !self.case.references.is_empty());
        out.predicted_paths = self.held_out.iter().map(|d| findings.predict(d)).collect();
        Ok(out)
    }
}
