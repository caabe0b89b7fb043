//! Cases of robots whose wheel motion is compared with a pose: robot files of `kind = "odometry"`, tables of their drives.

use std::path::{Path, PathBuf};

use anyhow::Result;
use hierarchical_fit::Table;
use odometry::file::{RobotFile, Signals};
use odometry::{Case, Drive, diagnosis, left_out};
use verdict::{Diagnosis, SimulatedPath};

use crate::columns::Kind;
use crate::drive_files::{self, NamesColumns, Origin};

/// A case with what was read for it.
#[derive(Debug)]
pub struct OdometryCase {
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
pub fn read(folder: Option<&Path>, robot: Option<&str>, parts: [&[PathBuf]; 3]) -> Result<Option<OdometryCase>> {
    let Some((file, [references, recordings, held_out], origin)) =
        drive_files::read::<RobotFile>(folder, robot, parts)?
    else {
        return Ok(None);
    };
    Ok(Some(OdometryCase { case: Case { robot: file.robot, references, recordings }, held_out, origin }))
}

impl NamesColumns for RobotFile {
    type Drive = Drive;
    const KIND: Kind = Kind::Odometry;

    fn read(shown: &str, text: &str) -> Result<Self> {
        Ok(Self::parse(shown, text)?)
    }

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

    fn of_table(&self, table: &Table, is_held_out: bool) -> Result<Drive> {
        Ok(if is_held_out { self.held_out(table)? } else { self.drive(table)? })
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

    fn simulated(&self, drive: &Drive) -> SimulatedPath {
        odometry::simulate(&self.robot, drive)
    }
}

impl OdometryCase {
    /// Diagnoses the case, and forecasts what is left out of the fit in turn.
    ///
    /// # Errors
    /// Drives that do not determine an answer.
    pub fn diagnose(&self, next: Option<f64>, progress: &dyn Fn(&str)) -> Result<Diagnosis> {
        let findings = odometry::examine(&self.case, next, progress)?;
        let table = left_out(&self.case, &findings, progress)?;
        let findings = findings.after(&table);
        let mut out = diagnosis(&findings, &table, !self.case.references.is_empty());
        out.predicted_paths = self.held_out.iter().map(|d| findings.predict(&self.case.robot, d)).collect();
        Ok(out)
    }
}
