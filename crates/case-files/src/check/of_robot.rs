//! What a robot file that names its columns itself reads of recordings.

use std::path::PathBuf;

use anyhow::Result;
use serde_json::{Value, json};

use crate::bag_signals::{self, Wanted};
use crate::columns::Kind;
use crate::{car, odometry};

/// A signal that a column of the robot file reads.
#[derive(Debug)]
pub struct ColumnRead {
    /// The column.
    pub column: String,
    /// How many values it has.
    pub values: usize,
    /// From when to when, s from the first message.
    pub span: [f64; 2],
}

/// A recording as the robot file reads it.
#[derive(Debug)]
pub struct DriveRead {
    /// Its name.
    pub name: String,
    /// Signals of a bag; of a table nothing.
    pub columns: Vec<ColumnRead>,
    /// What was done to it, in sentences.
    pub told: Vec<String>,
    /// How long it is and where its pose was seen, or why it cannot be diagnosed.
    pub drive: Result<String, String>,
}

/// What the robot file reads.
#[derive(Debug)]
pub struct OfRobot {
    /// The robot file, or the built-in robot's name.
    pub robot: String,
    /// Its kind.
    pub kind: Kind,
    /// Recordings.
    pub drives: Vec<DriveRead>,
}

impl OfRobot {
    pub(super) fn to_json(&self) -> Value {
        let column = |read: &ColumnRead| json!({ "column": read.column, "values": read.values, "span_s": read.span });
        let drives = self.drives.iter().map(|drive| {
            json!({
                "name": drive.name, "columns": drive.columns.iter().map(column).collect::<Vec<_>>(), "told": drive.told,
                "reads": drive.drive.as_ref().ok(), "refused": drive.drive.as_ref().err(),
            })
        });
        json!({ "robot": self.robot, "kind": self.kind.name(), "recordings": drives.collect::<Vec<_>>() })
    }

    /// Recordings that cannot be diagnosed, in sentences.
    pub(super) fn refused(&self) -> impl Iterator<Item = String> + '_ {
        self.drives.iter().filter_map(|drive| drive.drive.as_ref().err().cloned())
    }
}

/// A robot of one of the kinds that name their columns themselves.
enum Robot {
    Odometry(Box<::odometry::file::RobotFile>),
    Car(Box<single_track::file::RobotFile>),
}

impl Robot {
    fn read(name: &str, kind: Kind) -> Result<Option<Self>> {
        Ok(match kind {
            Kind::Odometry => odometry::robot(name)?.map(|file| Self::Odometry(Box::new(file))),
            Kind::Car => car::robot(name)?.map(|(file, _)| Self::Car(Box::new(file))),
        })
    }

    fn columns(&self) -> Vec<&str> {
        match self {
            Self::Odometry(file) => odometry::columns_of(file),
            Self::Car(file) => car::columns_of(file),
        }
    }

    /// Columns of the time and of the heading.
    fn time_and_yaw(&self) -> (&str, Option<&str>) {
        match self {
            Self::Odometry(file) => (&file.columns.time, odometry::yaw_of(file)),
            Self::Car(file) => (&file.columns.time, file.columns.yaw.as_deref()),
        }
    }

    fn table(&self, name: &str, text: &str) -> Result<(String, Vec<String>)> {
        Ok(match self {
            Self::Odometry(file) => of_wheels(file.drive(name, text)?),
            Self::Car(file) => of_car(file.drive(name, text)?),
        })
    }

    fn bag(&self, name: &str, signals: &::odometry::file::Signals) -> Result<(String, Vec<String>)> {
        Ok(match self {
            Self::Odometry(file) => of_wheels(file.drive_of(name, signals, false)?),
            Self::Car(file) => of_car(file.drive_of(name, signals, false)?),
        })
    }
}

fn of_wheels(drive: ::odometry::Drive) -> (String, Vec<String>) {
    let rows = drive.time.len();
    let measured = if drive.heading_only { "the heading by a gyro" } else { "a pose" };
    let seen = drive.pose.iter().filter(|pose| pose[2].is_finite()).count();
    let seconds = drive.time.last().zip(drive.time.first()).map_or(0.0, |(last, first)| last - first);
    (format!("{rows} rows in {seconds:.1} s, {measured} in {seen} of them"), drive.told)
}

fn of_car(drive: single_track::Drive) -> (String, Vec<String>) {
    let pose = if drive.has_pose() { "with a pose" } else { "without a pose" };
    (format!("{:.1} s, {pose}", drive.duration()), drive.told)
}

/// Reads recordings by the columns of a robot file; `None` where its kind has none.
pub(super) fn read(name: &str, kind: Kind, paths: &[PathBuf]) -> Result<Option<OfRobot>> {
    let Some(robot) = Robot::read(name, kind)? else { return Ok(None) };
    let (columns, (time, yaw)) = (robot.columns(), robot.time_and_yaw());
    let wanted = Wanted { robot: name, time, columns: &columns, yaw };
    let mut drives = Vec::new();
    for path in paths {
        let (tables, bags) = odometry::recordings(path, &mut Vec::new())?;
        for path in tables {
            let name = path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
            let read = odometry::table(&path).and_then(|text| robot.table(&name, &text));
            drives.push(drive_read(name, Vec::new(), Vec::new(), read));
        }
        for bag in bags {
            let name = bag_signals::name_of(&bag);
            drives.push(match bag_signals::signals(&bag, &wanted) {
                Ok(found) => {
                    let column = |(column, series): (&String, &::odometry::file::Series)| ColumnRead {
                        column: column.clone(),
                        values: series.time.len(),
                        span: series.span().unwrap_or_default(),
                    };
                    let columns = found.signals.iter().map(column).collect();
                    let read = robot.bag(&name, &found.signals).map_err(|error| found.explained(error));
                    drive_read(name, columns, found.told, read)
                }
                Err(error) => drive_read(name, Vec::new(), Vec::new(), Err(error)),
            });
        }
    }
    Ok(Some(OfRobot { robot: name.to_owned(), kind, drives }))
}

fn drive_read(
    name: String,
    columns: Vec<ColumnRead>,
    mut told: Vec<String>,
    read: Result<(String, Vec<String>)>,
) -> DriveRead {
    let drive = read.map_err(|error| format!("{error:#}")).map(|(drive, own)| {
        told.extend(own);
        drive
    });
    DriveRead { name, columns, told, drive }
}
