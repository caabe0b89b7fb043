//! Cases of robots whose files name their columns themselves: wheel motion beside a pose, cars, and
//! robots of any wheels under torque.

use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use hierarchical_fit::Rehearsable;
use verdict::Diagnosis;

use crate::car::{self, CarCase};
use crate::columns::{ColumnsEnvelope, Kind};
use crate::drive_files;
pub use crate::drive_files::SimulatedDrives;
use crate::inputs;
use crate::odometry::{self, OdometryCase};
use crate::wheeled::{self, WheeledCase};

/// A case of one of these kinds.
#[derive(Debug)]
pub enum ColumnsCase {
    /// Of kind odometry.
    Odometry(Box<OdometryCase>),
    /// Of kind car.
    Car(Box<CarCase>),
    /// Of kind wheeled.
    Wheeled(Box<WheeledCase>),
}

impl ColumnsCase {
    /// The case of a folder, or of a robot with files (references, recordings, held-out drives), if its robot is of one of these
    /// kinds.
    ///
    /// # Errors
    /// A robot file or tables that cannot be read, or hold what no such robot can have.
    pub fn read(folder: Option<&Path>, robot: Option<&str>, parts: [&[PathBuf]; 3]) -> Result<Option<Self>> {
        if let Some(case) = car::read(folder, robot, parts)? {
            return Ok(Some(Self::Car(Box::new(case))));
        }
        if let Some(case) = wheeled::read(folder, robot, parts)? {
            return Ok(Some(Self::Wheeled(Box::new(case))));
        }
        Ok(odometry::read(folder, robot, parts)?.map(|case| Self::Odometry(Box::new(case))))
    }

    /// Its kind.
    pub fn kind(&self) -> Kind {
        match self {
            Self::Odometry(_) => Kind::Odometry,
            Self::Car(_) => Kind::Car,
            Self::Wheeled(_) => Kind::Wheeled,
        }
    }

    /// The robot file, or the built-in robot's name.
    pub fn robot(&self) -> &str {
        match self {
            Self::Odometry(case) => &case.origin.robot,
            Self::Car(case) => &case.origin.robot,
            Self::Wheeled(case) => &case.origin.robot,
        }
    }

    /// Name of the robot in its file.
    pub fn robot_name(&self) -> &str {
        match self {
            Self::Odometry(case) => &case.case.robot.name,
            Self::Car(case) => &case.case.car.name,
            Self::Wheeled(case) => &case.case.robot.name,
        }
    }

    /// Names of its recordings.
    pub fn recordings(&self) -> Vec<&str> {
        match self {
            Self::Odometry(case) => case.case.recordings.iter().map(|d| d.name.as_str()).collect(),
            Self::Car(case) => case.case.recordings.iter().map(|d| d.name.as_str()).collect(),
            Self::Wheeled(case) => case.case.recordings.iter().map(|d| d.name.as_str()).collect(),
        }
    }

    /// Length of its first recording, s; `None` without any.
    pub fn duration(&self) -> Option<f64> {
        match self {
            Self::Odometry(case) => case.case.recordings.first().map(::odometry::Drive::duration),
            Self::Car(case) => case.case.recordings.first().map(single_track::Drive::duration),
            Self::Wheeled(case) => case.case.recordings.first().map(::wheeled::Drive::duration),
        }
    }

    /// Other things in the folders, which were not read.
    pub fn ignored(&self) -> &[String] {
        match self {
            Self::Odometry(case) => &case.origin.ignored,
            Self::Car(case) => &case.origin.ignored,
            Self::Wheeled(case) => &case.origin.ignored,
        }
    }

    /// Diagnoses the case, with advice on a next drive of so many seconds.
    ///
    /// # Errors
    /// Drives that do not determine an answer.
    pub fn diagnose(&self, next: Option<f64>, progress: &dyn Fn(&str)) -> Result<Diagnosis> {
        match self {
            Self::Odometry(case) => case.diagnose(next, progress),
            Self::Car(case) => case.diagnose(next, progress),
            Self::Wheeled(case) => case.diagnose(next, progress),
        }
    }

    /// What its drives could say, whatever they say.
    ///
    /// # Errors
    /// As [`Self::diagnose`].
    pub fn rehearsable(&self, progress: &dyn Fn(&str)) -> Result<Rehearsable> {
        Ok(match self {
            Self::Odometry(case) => ::odometry::rehearsable(&case.case, progress)?,
            Self::Car(case) => single_track::rehearsable(&case.case, progress)?,
            Self::Wheeled(case) => ::wheeled::rehearsable(&case.case, progress)?,
        })
    }

    /// A diagnosis with what it was made from.
    pub fn envelope(&self, diagnosis: Diagnosis) -> ColumnsEnvelope {
        match self {
            Self::Odometry(case) => case.origin.envelope(self.kind(), diagnosis),
            Self::Car(case) => case.origin.envelope(self.kind(), diagnosis),
            Self::Wheeled(case) => case.origin.envelope(self.kind(), diagnosis),
        }
    }
}

/// The kind of a robot, a file or built in, if it names its columns itself.
///
/// # Errors
/// A file that cannot be read, or holds what no such robot can have.
pub fn kind_of(robot: &str) -> Result<Option<Kind>> {
    Ok(match Kind::of_robot(robot)? {
        Some(Kind::Car) => drive_files::robot::<single_track::file::RobotFile>(robot)?.map(|_| Kind::Car),
        Some(Kind::Wheeled) => drive_files::robot::<::wheeled::file::RobotFile>(robot)?.map(|_| Kind::Wheeled),
        Some(Kind::Odometry) => drive_files::robot::<::odometry::file::RobotFile>(robot)?.map(|_| Kind::Odometry),
        None => None,
    })
}

/// Drives of a robot that names its columns itself, a file or built in, as it does them, as stated, on their inputs alone; `None` of
/// other robots.
///
/// # Errors
/// A robot file or recordings that cannot be read, or hold what no such robot can have.
pub fn simulated(robot: &str, drives: &[PathBuf]) -> Result<Option<SimulatedDrives>> {
    match Kind::of_robot(robot)? {
        Some(Kind::Odometry) => drive_files::simulated::<::odometry::file::RobotFile>(robot, drives),
        Some(Kind::Car) => drive_files::simulated::<single_track::file::RobotFile>(robot, drives),
        Some(Kind::Wheeled) => drive_files::simulated::<::wheeled::file::RobotFile>(robot, drives),
        None => Ok(None),
    }
}

/// The same of a robot that has to name its columns itself.
///
/// # Errors
/// As [`kind_of`], and a robot that is read by a mapping.
pub fn needed_kind(robot: &str) -> Result<Kind> {
    if let Some(kind) = kind_of(robot)? {
        return Ok(kind);
    }
    inputs::robot(robot)?;
    bail!(
        "robot '{robot}' reads its signals by a mapping, not by columns of its own; leave the robot out, or name the mapping instead"
    )
}
