//! Files of drives of robots whose files name their columns: tables and bags, read by the part they play.

use std::fs::File;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};
use hierarchical_fit::{Column, Table};
use odometry::file::Signals;
use recordings::{Format, NamedColumn, group_bags, is_bag, named_columns};
use verdict::{Diagnosis, SimulatedPath};

use crate::bag_signals::{self, Found, Wanted};
use crate::case_folder::robot_of;
use crate::columns::{ColumnsEnvelope, Kind, robot_text};
use crate::envelope::SourceFile;
use crate::inputs::{list, run_names};
use crate::parts::folders;
use crate::which_mapping;

/// A robot file that names the columns of its drives.
pub(crate) trait NamesColumns: Sized {
    /// A drive of such a robot.
    type Drive;
    /// Its kind.
    const KIND: Kind;

    /// Reads a robot file; `shown` is what messages call it.
    fn read(shown: &str, text: &str) -> Result<Self>;

    /// Column of the time.
    fn time(&self) -> &str;
    /// All others.
    fn columns(&self) -> Vec<&str>;
    /// All columns of a table.
    fn table_columns(&self) -> Vec<&str> {
        self.columns().into_iter().chain([self.time()]).collect()
    }
    /// The one of the heading.
    fn yaw(&self) -> Option<&str>;
    /// A drive from the columns of a table.
    fn of_table(&self, table: &Table, is_held_out: bool) -> Result<Self::Drive>;
    /// A drive from signals at instants of their own.
    fn of_signals(&self, name: &str, signals: &Signals, is_held_out: bool) -> Result<Self::Drive>;
    /// What was done to a drive, in sentences.
    fn told(drive: &mut Self::Drive) -> &mut Vec<String>;
    /// How long a drive is and what was measured, in words.
    fn described(drive: &Self::Drive) -> String;
    /// A drive as the robot does it, as stated, on the inputs alone.
    fn simulated(&self, drive: &Self::Drive) -> SimulatedPath;

    /// What is wanted of a bag; `robot` as it is called, `columns` those of this file.
    fn wanted<'a>(&'a self, robot: &'a str, columns: &'a [&'a str]) -> Wanted<'a> {
        Wanted { robot, time: self.time(), columns, yaw: self.yaw() }
    }

    /// A drive from a file, with how that is written.
    fn of_file(&self, (table, told): (&Table, Vec<String>), is_held_out: bool) -> Result<Self::Drive> {
        let mut drive = self.of_table(table, is_held_out)?;
        Self::told(&mut drive).splice(0..0, told);
        Ok(drive)
    }

    /// A drive from what was found in a bag, with what was lost there.
    fn of_bag(&self, name: &str, found: &Found, is_held_out: bool) -> Result<Self::Drive> {
        let mut drive = self.of_signals(name, &found.signals, is_held_out).map_err(|error| found.explained(error))?;
        Self::told(&mut drive).extend(found.told.iter().cloned());
        Ok(drive)
    }
}

/// The robot that is named, a file or built in, and what its file says; `None` where it is of another kind.
///
/// # Errors
/// A file that cannot be read, or holds what no such robot can have.
pub(crate) fn robot<F: NamesColumns>(name: &str) -> Result<Option<(F, String)>> {
    let Some(text) = robot_text(name, F::KIND)? else { return Ok(None) };
    let shown = if Path::new(name).is_file() { name.to_owned() } else { format!("{name}.toml") };
    Ok(Some((F::read(&shown, &text)?, text)))
}

/// What was read for a case.
#[derive(Debug)]
pub struct Origin {
    /// The robot file, or the built-in robot's name.
    pub robot: String,
    /// What it says.
    pub text: String,
    /// Files of the references, of the recordings, and of the drives to be predicted.
    pub files: [Vec<SourceFile>; 3],
    /// Other things in the folders, which were not read.
    pub ignored: Vec<String>,
}

impl Origin {
    /// A diagnosis with what it was made from.
    pub fn envelope(&self, kind: Kind, diagnosis: Diagnosis) -> ColumnsEnvelope {
        ColumnsEnvelope::new(kind, [&self.robot, &self.text], &self.files, &self.ignored, diagnosis)
    }
}

/// A robot file with the drives of a case: references, recordings, held out.
pub(crate) type Read<F> = (F, [Vec<<F as NamesColumns>::Drive>; 3], Origin);

/// What there is of the case of a folder, or of a robot with files, if its robot is of this kind.
///
/// # Errors
/// A robot file or recordings that cannot be read, or hold what no such robot can have.
pub(crate) fn read<F: NamesColumns>(
    folder: Option<&Path>,
    robot_name: Option<&str>,
    parts: [&[PathBuf]; 3],
) -> Result<Option<Read<F>>> {
    let name = match (robot_name, folder) {
        (Some(name), _) => name.to_owned(),
        // What is wrong with a folder without a robot is said where other kinds are read.
        (None, Some(folder)) => match robot_of(folder) {
            Ok(path) => path.display().to_string(),
            Err(_) => return Ok(None),
        },
        (None, None) => return Ok(None),
    };
    let Some((file, text)) = robot::<F>(&name)? else { return Ok(None) };
    let mut ignored = Vec::new();
    let (drives, files) = drives((&name, &file), folder, parts, &mut ignored)?;
    if drives[1].is_empty() {
        bail!(
            "robot '{name}' is of kind {}, but there are no recordings; give tables (CSV, Parquet) or bags with --recordings",
            F::KIND.name()
        );
    }
    Ok(Some((file, drives, Origin { robot: name, text, files, ignored })))
}

/// Drives of a robot that is called so, as it does them on their inputs alone, with what was read for them; `None` where it is of
/// another kind.
///
/// # Errors
/// A robot file or recordings that cannot be read, or hold what no such robot can have.
pub(crate) fn simulated<F: NamesColumns>(name: &str, paths: &[PathBuf]) -> Result<Option<SimulatedDrives>> {
    let Some((file, _)) = robot::<F>(name)? else { return Ok(None) };
    let mut ignored = Vec::new();
    let ([_, _, drives], [_, _, sources]) = drives((name, &file), None, [&[], &[], paths], &mut ignored)?;
    ensure!(
        !drives.is_empty(),
        "there is no drive in what was given; name tables (CSV, Parquet) or bags, or a folder of them"
    );
    let told = drives.into_iter().map(|mut drive| {
        let path = file.simulated(&drive);
        (path, std::mem::take(F::told(&mut drive)))
    });
    let (paths, told): (Vec<_>, Vec<_>) = told.unzip();
    Ok(Some(SimulatedDrives { paths, sources, told: told.concat(), ignored }))
}

/// Drives as a robot does them on their inputs alone.
#[derive(Debug)]
pub struct SimulatedDrives {
    /// The drives.
    pub paths: Vec<SimulatedPath>,
    /// Files that they were read from.
    pub sources: Vec<SourceFile>,
    /// What was done to them, in sentences.
    pub told: Vec<String>,
    /// Other things in the folders, which were not read.
    pub ignored: Vec<String>,
}

/// Drives and files: of the references, of the recordings, and of what is to be predicted.
type Parts<D> = ([Vec<D>; 3], [Vec<SourceFile>; 3]);

/// Drives of a case folder, or of paths (references, recordings, held out), of the robot that is called so.
fn drives<F: NamesColumns>(
    (robot, file): (&str, &F),
    folder: Option<&Path>,
    paths: [&[PathBuf]; 3],
    ignored: &mut Vec<String>,
) -> Result<Parts<F::Drive>> {
    let paths: [Vec<PathBuf>; 3] = match folder {
        Some(folder) => folders(folder)?.map(|part| if part.is_dir() { vec![part] } else { Vec::new() }),
        None => paths.map(<[PathBuf]>::to_vec),
    };
    let columns = file.columns();
    let wanted = file.wanted(robot, &columns);
    let mut drives = [Vec::new(), Vec::new(), Vec::new()];
    let mut files: [Vec<SourceFile>; 3] = Default::default();
    for (k, paths) in paths.iter().enumerate() {
        let is_held_out = k == 2;
        let recorded = Recorded::below(paths)?;
        recorded.ensure_one_of_each()?;
        ignored.extend(recorded.ignored);
        for path in recorded.tables {
            let (table, told, source) = table(&path, &file.table_columns())?;
            drives[k].push(file.of_file((&table, told), is_held_out)?);
            files[k].push(source);
        }
        for (name, bag) in recorded.bags {
            let found = bag_signals::signals((&name, &bag), &wanted)?;
            drives[k].push(file.of_bag(&name, &found, is_held_out)?);
            files[k].extend(found.files);
        }
    }
    Ok((drives, files))
}

/// What is recorded in files and folders.
#[derive(Debug, Default)]
pub(crate) struct Recorded {
    /// Tables, sorted within each folder.
    pub(crate) tables: Vec<PathBuf>,
    /// Bags, each with its name and its parts.
    pub(crate) bags: Vec<(String, Vec<String>)>,
    /// Other things in the folders.
    pub(crate) ignored: Vec<String>,
}

impl Recorded {
    /// Refuses a drive that lies there twice, as CSV and as Parquet: it would count twice.
    fn ensure_one_of_each(&self) -> Result<()> {
        let key = |table: &PathBuf| (table.parent().map(Path::to_path_buf), name_of(table));
        for (k, table) in self.tables.iter().enumerate() {
            if let Some(other) = self.tables[..k].iter().find(|other| key(other) == key(table)) {
                bail!(
                    "'{}' and '{}' have one name, as if they were one drive; leave one of them, or rename it",
                    other.display(),
                    table.display()
                );
            }
        }
        Ok(())
    }

    pub(crate) fn below(paths: &[PathBuf]) -> Result<Self> {
        let files = which_mapping::bags(paths)?;
        let mut out = Self::default();
        for path in paths {
            let shown = path.display();
            ensure!(path.exists(), "there is no file or folder '{shown}'; give a table or a bag, or a folder of them");
            if !path.is_dir() {
                if !is_bag(&path.to_string_lossy()) {
                    out.tables.push(path.clone());
                }
                continue;
            }
            for inside in list(path)? {
                if inside.is_file() && Format::stem_of_table(&inside.to_string_lossy()).is_some() {
                    out.tables.push(inside);
                } else if !inside.ends_with("metadata.yaml") && files.iter().all(|bag| !bag.starts_with(&inside)) {
                    out.ignored.push(inside.display().to_string());
                }
            }
        }
        let groups = group_bags(&files.iter().map(|file| file.display().to_string()).collect::<Vec<_>>()).groups;
        let bags = groups.iter().map(|group| group.files.iter().map(|file| file.name.clone()).collect());
        out.bags = run_names(&groups).into_iter().zip(bags).collect();
        Ok(out)
    }
}

/// Name of the drive in a table.
pub(crate) fn name_of(table: &Path) -> String {
    let name = table.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    Format::stem_of_table(&name).unwrap_or(&name).to_owned()
}

/// The columns of a table that the robot file names, how it is written, and the file.
pub(crate) fn table(path: &Path, columns: &[&str]) -> Result<(Table, Vec<String>, SourceFile)> {
    let shown = path.display().to_string();
    let mut file = File::open(path).with_context(|| format!("cannot read '{shown}'"))?;
    let read = named_columns(&shown, &mut file, columns)?;
    let drive = name_of(path);
    let told = read.told.iter().map(|told| format!("recording '{drive}': {told}")).collect();
    let columns = read.columns.into_iter();
    let columns = columns.map(|NamedColumn { name, cells, unread, .. }| (name, Column { cells, unread })).collect();
    let source = SourceFile { name: shown, bytes: read.bytes as usize, sha256: read.sha256 };
    Ok((Table { drive, names: read.names, columns }, told, source))
}
