//! Cases of robots whose wheel motion is compared with a pose: robot files of `kind = "odometry"`, tables of their drives.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};
use odometry::file::RobotFile;
use odometry::{Case, Drive, diagnosis, left_out};
use verdict::Diagnosis;

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
    let (drives, files) = drives(folder, parts, &mut ignored, |part, name, text| {
        Ok(if part == Part::HeldOut { file.held_out(name, text)? } else { file.drive(name, text)? })
    })?;
    let [references, recordings, held_out] = drives;
    if recordings.is_empty() {
        bail!("robot '{name}' is of kind odometry, but there are no recordings; give CSV files with --recordings");
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

/// Drives and files, by their part.
type Parts<D> = ([Vec<D>; 3], [Vec<SourceFile>; 3]);

/// Drives of a case folder or of paths (references, recordings, held out), read by `drive` from part, name and text.
pub(crate) fn drives<D>(
    folder: Option<&Path>,
    paths: [&[PathBuf]; 3],
    ignored: &mut Vec<String>,
    drive: impl Fn(Part, &str, &str) -> Result<D>,
) -> Result<Parts<D>> {
    let paths: [Vec<PathBuf>; 3] = match folder {
        Some(folder) => folders(folder).map(|part| if part.is_dir() { vec![part] } else { Vec::new() }),
        None => paths.map(<[PathBuf]>::to_vec),
    };
    let mut drives = [Vec::new(), Vec::new(), Vec::new()];
    let mut files: [Vec<SourceFile>; 3] = Default::default();
    for (k, part) in [Part::Reference, Part::Recording, Part::HeldOut].into_iter().enumerate() {
        for path in tables(&paths[k], ignored)? {
            let text = std::fs::read_to_string(&path).with_context(|| format!("cannot read '{}'", path.display()))?;
            let stem = path.file_stem().map_or_else(String::new, |s| s.to_string_lossy().into_owned());
            drives[k].push(drive(part, &stem, &text)?);
            files[k].push(source(path.display().to_string(), &text));
        }
    }
    Ok((drives, files))
}

/// Tables below paths, sorted within each folder.
fn tables(paths: &[PathBuf], ignored: &mut Vec<String>) -> Result<Vec<PathBuf>> {
    let mut out = Vec::new();
    for path in paths {
        ensure!(path.exists(), "there is no file or folder '{}'; give a table, or a folder of tables", path.display());
        if path.is_dir() {
            for inside in list(path)? {
                let is_table = inside.extension().is_some_and(|e| e.eq_ignore_ascii_case("csv"));
                if is_table { out.push(inside) } else { ignored.push(inside.display().to_string()) }
            }
        } else {
            out.push(path.clone());
        }
    }
    Ok(out)
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
