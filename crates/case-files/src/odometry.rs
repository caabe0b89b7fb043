//! Cases of robots whose wheel motion is compared with a pose: robot files of `kind = "odometry"`, tables of their drives.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};
use odometry::file::RobotFile;
use odometry::{Case, Drive, diagnosis, left_out};
use recordings::is_bag;
use verdict::Diagnosis;

use crate::bag_signals::{self, Found, Wanted};
use crate::case_folder::{folders, robot_of};
use crate::columns::{ColumnsEnvelope, Kind, robot_text, source};
use crate::envelope::SourceFile;
use crate::inputs::list;

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
    let columns = columns_of(&file);
    let wanted = Wanted { robot: &name, time: &file.columns.time, columns: &columns, yaw: yaw_of(&file) };
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
        bail!(
            "robot '{name}' is of kind odometry, but there are no recordings; give CSV files or bags with --recordings"
        );
    }
    let case = Case { robot: file.robot, references, recordings };
    Ok(Some(OdometryCase { case, held_out, robot: name, text, files, ignored }))
}

/// What part a drive plays.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Part {
    /// The simulation was right.
    Reference,
    /// It was not.
    Recording,
    /// Its pose is to be predicted.
    HeldOut,
}

/// How a drive is recorded.
#[derive(Clone, Copy)]
pub(crate) enum Recorded<'a> {
    /// As comma-separated values.
    Table(&'a str),
    /// As messages, of which the wanted fields were read.
    Bag(&'a Found),
}

/// Drives and files, by their part.
type Parts<D> = ([Vec<D>; 3], [Vec<SourceFile>; 3]);

/// Columns that a drive of this robot has beside its time.
pub(crate) fn columns_of(file: &RobotFile) -> Vec<&str> {
    let names = &file.columns;
    let body = names.pose.iter().flatten().chain(&names.gyro);
    names.wheels.iter().chain(&names.steering).chain(body).map(String::as_str).collect()
}

/// Column of the heading.
pub(crate) fn yaw_of(file: &RobotFile) -> Option<&str> {
    file.columns.pose.as_ref().map(|[_, _, yaw]| yaw.as_str())
}

/// Drives of a case folder or of paths (references, recordings, held out), read by `drive` from part, name and what is recorded:
/// `wanted` of a bag.
pub(crate) fn drives<D>(
    folder: Option<&Path>,
    paths: [&[PathBuf]; 3],
    ignored: &mut Vec<String>,
    wanted: &Wanted<'_>,
    drive: impl Fn(Part, &str, Recorded<'_>) -> Result<D>,
) -> Result<Parts<D>> {
    let paths: [Vec<PathBuf>; 3] = match folder {
        Some(folder) => folders(folder).map(|part| if part.is_dir() { vec![part] } else { Vec::new() }),
        None => paths.map(<[PathBuf]>::to_vec),
    };
    let mut drives = [Vec::new(), Vec::new(), Vec::new()];
    let mut files: [Vec<SourceFile>; 3] = Default::default();
    for (k, part) in [Part::Reference, Part::Recording, Part::HeldOut].into_iter().enumerate() {
        for path in &paths[k] {
            let shown = path.display();
            ensure!(path.exists(), "there is no file or folder '{shown}'; give a table or a bag, or a folder of them");
            let (tables, bags) = recordings(path, ignored)?;
            for path in tables {
                let text = table(&path)?;
                let stem = path.file_stem().map_or_else(String::new, |s| s.to_string_lossy().into_owned());
                drives[k].push(drive(part, &stem, Recorded::Table(&text))?);
                files[k].push(source(path.display().to_string(), &text));
            }
            for bag in bags {
                let found = bag_signals::signals(&bag, wanted)?;
                let read = drive(part, &bag_signals::name_of(&bag), Recorded::Bag(&found));
                drives[k].push(read.map_err(|error| found.explained(error))?);
                files[k].extend(found.files);
            }
        }
    }
    Ok((drives, files))
}

/// Tables and bags of a path, sorted within each folder; a bag may have several parts.
pub(crate) fn recordings(path: &Path, ignored: &mut Vec<String>) -> Result<(Vec<PathBuf>, Vec<Vec<PathBuf>>)> {
    if path.is_dir() {
        let is_table = |inside: &PathBuf| inside.extension().is_some_and(|e| e.eq_ignore_ascii_case("csv"));
        let tables = list(path)?.into_iter().filter(is_table).collect();
        return Ok((tables, bag_signals::bags_below(path, ignored)?));
    }
    let path = path.to_path_buf();
    Ok(if is_bag(&path.to_string_lossy()) { (Vec::new(), vec![vec![path]]) } else { (vec![path], Vec::new()) })
}

/// A table's text.
pub(crate) fn table(path: &Path) -> Result<String> {
    let shown = path.display();
    let bytes = std::fs::read(path).with_context(|| format!("cannot read '{shown}'"))?;
    let refused = || {
        format!(
            "'{shown}' is no text: robots of wheel counts and cars are read from comma-separated values and from bags (.mcap, .db3); \
             write the table as CSV"
        )
    };
    String::from_utf8(bytes).with_context(refused)
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
