//! What a robot file that names its columns itself reads of recordings.

use std::path::PathBuf;

use ::odometry::file::Series;
use anyhow::Result;
use serde_json::{Value, json};

use crate::bag_signals;
use crate::columns::Kind;
use crate::drive_files::{NamesColumns, Recorded, name_of, robot, table};

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

/// Reads recordings by the columns of a robot file; `None` where its kind has none.
pub(super) fn read(name: &str, kind: Kind, paths: &[PathBuf]) -> Result<Option<OfRobot>> {
    let drives = match kind {
        Kind::Odometry => of_kind::<odometry::file::RobotFile>(name, paths),
        Kind::Car => of_kind::<single_track::file::RobotFile>(name, paths),
        Kind::Wheeled => of_kind::<wheeled::file::RobotFile>(name, paths),
    };
    let Some(drives) = drives? else { return Ok(None) };
    Ok(Some(OfRobot { robot: name.to_owned(), kind, drives }))
}

fn of_kind<F: NamesColumns>(name: &str, paths: &[PathBuf]) -> Result<Option<Vec<DriveRead>>> {
    robot::<F>(name)?.map(|(file, _)| by(name, &file, paths)).transpose()
}

fn by<F: NamesColumns>(robot: &str, file: &F, paths: &[PathBuf]) -> Result<Vec<DriveRead>> {
    let columns = file.columns();
    let wanted = file.wanted(robot, &columns);
    let recorded = Recorded::below(paths)?;
    let mut out = Vec::new();
    for path in recorded.tables {
        let name = name_of(&path);
        let read = table(&path, &file.table_columns());
        let read = read.and_then(|(table, told, _)| file.of_file((&table, told), false));
        out.push(drive_read::<F>(name, Vec::new(), read));
    }
    for (name, bag) in recorded.bags {
        let (columns, read) = match bag_signals::signals((&name, &bag), &wanted) {
            Ok(found) => (found.signals.iter().map(column_read).collect(), file.of_bag(&name, &found, false)),
            Err(error) => (Vec::new(), Err(error)),
        };
        out.push(drive_read::<F>(name, columns, read));
    }
    Ok(out)
}

fn column_read((column, series): (&String, &Series)) -> ColumnRead {
    ColumnRead { column: column.clone(), values: series.time.len(), span: series.span().unwrap_or_default() }
}

fn drive_read<F: NamesColumns>(name: String, columns: Vec<ColumnRead>, read: Result<F::Drive>) -> DriveRead {
    match read {
        Ok(mut drive) => {
            let told = std::mem::take(F::told(&mut drive));
            DriveRead { name, columns, told, drive: Ok(F::described(&drive)) }
        }
        Err(error) => DriveRead { name, columns, told: Vec::new(), drive: Err(format!("{error:#}")) },
    }
}
