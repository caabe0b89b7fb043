//! Files of drives of robots whose files name their columns: tables and bags, read by the part they play.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};
use odometry::file::Signals;
use recordings::{group_bags, is_bag};

use crate::bag_signals::{self, Found, Wanted};
use crate::case_folder::folders;
use crate::columns::source;
use crate::envelope::SourceFile;
use crate::inputs::{list, run_names};
use crate::which_mapping;

/// A robot file that names the columns of its drives.
pub(crate) trait NamesColumns {
    /// A drive of such a robot.
    type Drive;

    /// Column of the time.
    fn time(&self) -> &str;
    /// All others.
    fn columns(&self) -> Vec<&str>;
    /// The one of the heading.
    fn yaw(&self) -> Option<&str>;
    /// A drive from comma-separated values.
    fn of_table(&self, name: &str, text: &str, is_held_out: bool) -> Result<Self::Drive>;
    /// A drive from signals at instants of their own.
    fn of_signals(&self, name: &str, signals: &Signals, is_held_out: bool) -> Result<Self::Drive>;
    /// What was done to a drive, in sentences.
    fn told(drive: &mut Self::Drive) -> &mut Vec<String>;
    /// How long a drive is and what was measured, in words.
    fn described(drive: &Self::Drive) -> String;

    /// What is wanted of a bag; `robot` as it is called, `columns` those of this file.
    fn wanted<'a>(&'a self, robot: &'a str, columns: &'a [&'a str]) -> Wanted<'a> {
        Wanted { robot, time: self.time(), columns, yaw: self.yaw() }
    }

    /// A drive from what was found in a bag, with what was lost there.
    fn of_bag(&self, name: &str, found: &Found, is_held_out: bool) -> Result<Self::Drive> {
        let mut drive = self.of_signals(name, &found.signals, is_held_out).map_err(|error| found.explained(error))?;
        Self::told(&mut drive).extend(found.told.iter().cloned());
        Ok(drive)
    }
}

/// Drives and files: of the references, of the recordings, and of what is to be predicted.
type Parts<D> = ([Vec<D>; 3], [Vec<SourceFile>; 3]);

/// Drives of a case folder, or of paths (references, recordings, held out), of the robot that is called so.
pub(crate) fn drives<F: NamesColumns>(
    (robot, file): (&str, &F),
    folder: Option<&Path>,
    paths: [&[PathBuf]; 3],
    ignored: &mut Vec<String>,
) -> Result<Parts<F::Drive>> {
    let paths: [Vec<PathBuf>; 3] = match folder {
        Some(folder) => folders(folder).map(|part| if part.is_dir() { vec![part] } else { Vec::new() }),
        None => paths.map(<[PathBuf]>::to_vec),
    };
    let columns = file.columns();
    let wanted = file.wanted(robot, &columns);
    let mut drives = [Vec::new(), Vec::new(), Vec::new()];
    let mut files: [Vec<SourceFile>; 3] = Default::default();
    for (k, paths) in paths.iter().enumerate() {
        let is_held_out = k == 2;
        let recorded = Recorded::below(paths)?;
        ignored.extend(recorded.ignored);
        for path in recorded.tables {
            let text = table(&path)?;
            drives[k].push(file.of_table(&name_of(&path), &text, is_held_out)?);
            files[k].push(source(path.display().to_string(), &text));
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
                if inside.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("csv")) {
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
    table.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned())
}

/// A table's text.
pub(crate) fn table(path: &Path) -> Result<String> {
    let shown = path.display();
    let bytes = std::fs::read(path).with_context(|| format!("cannot read '{shown}'"))?;
    let refused = || {
        format!(
            "'{shown}' is no text: robots whose files name their columns are read from comma-separated values and from bags (.mcap, .db3); \
             write the table as CSV"
        )
    };
    String::from_utf8(bytes).with_context(refused)
}
