//! Case folders: a robot, `reference/`, `recordings/`, and perhaps `heldout/`.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};
use recordings::{Input, Loss, Mapping, Read, ReadOptions, Source};

use crate::robot_file::RobotSpec;

/// Recordings read from files, with what was lost.
#[derive(Debug, Default)]
pub struct Loaded {
    /// Recordings in the order of their names.
    pub reads: Vec<Read>,
    /// What could not be read.
    pub losses: Vec<Loss>,
    /// Files and their SHA-256.
    pub sources: Vec<Source>,
    /// Files that no entry of the mapping fits.
    pub unmatched: Vec<String>,
}

/// A mapping: a built-in one by name, or a TOML file.
///
/// # Errors
/// When it can be neither found nor parsed.
pub fn mapping(name: &str) -> Result<Mapping> {
    let path = Path::new(name);
    if path.exists() {
        let text = fs::read_to_string(path).with_context(|| format!("cannot read mapping '{name}'"))?;
        return Ok(Mapping::parse(name, &text)?);
    }
    Ok(Mapping::built_in(name)?)
}

/// A robot: a file, or a built-in one by name.
///
/// # Errors
/// When it can be neither found nor parsed.
pub fn robot(name: &str) -> Result<RobotSpec> {
    let path = Path::new(name);
    if path.exists() {
        let text = fs::read_to_string(path).with_context(|| format!("cannot read robot file '{name}'"))?;
        return Ok(RobotSpec::parse(name, &text)?);
    }
    Ok(RobotSpec::built_in(name)?)
}

/// All files below `paths` (a folder's files, or a file itself), sorted.
fn files(paths: &[PathBuf]) -> Result<Vec<PathBuf>> {
    let mut out = Vec::new();
    for p in paths {
        if p.is_dir() {
            let mut inside: Vec<PathBuf> = fs::read_dir(p)
                .with_context(|| format!("cannot list '{}'", p.display()))?
                .filter_map(|e| e.ok().map(|e| e.path()))
                .filter(|f| f.is_file() && f.extension().is_some_and(|e| e.eq_ignore_ascii_case("csv")))
                .collect();
            inside.sort();
            out.extend(inside);
        } else {
            ensure!(p.exists(), "there is no file or folder '{}'", p.display());
            out.push(p.clone());
        }
    }
    Ok(out)
}

/// Reads every recording in files and folders.
///
/// # Errors
/// The first file that cannot be read, or none at all.
pub fn load(mapping: &Mapping, paths: &[PathBuf], options: &ReadOptions) -> Result<Loaded> {
    let files = files(paths)?;
    let names: Vec<String> = files.iter().map(|f| f.display().to_string()).collect();
    let grouping = mapping.group(&names);
    let mut out = Loaded { unmatched: grouping.unmatched, ..Loaded::default() };
    for group in &grouping.groups {
        let bytes = group
            .files
            .iter()
            .map(|f| fs::read(&f.name).with_context(|| format!("cannot read '{}'", f.name)))
            .collect::<Result<Vec<_>>>()?;
        let inputs: Vec<Input<'_>> = group.files.iter().zip(&bytes).map(|(f, b)| Input { name: &f.name, bytes: b }).collect();
        // The run's name is the file's alone: labels in folder names are not evidence.
        let run = Path::new(&group.run).file_name().map_or(group.run.clone(), |n| n.to_string_lossy().into_owned());
        let read = recordings::read(mapping, &run, &inputs, options)?;
        out.losses.extend(read.losses.iter().cloned());
        out.sources.extend(read.sources.iter().cloned());
        out.reads.push(read);
    }
    if out.reads.is_empty() {
        bail!(
            "no file in {} fits the mapping '{}'; its patterns are: {}",
            paths.iter().map(|p| format!("'{}'", p.display())).collect::<Vec<_>>().join(", "),
            mapping.name,
            mapping.files.iter().map(|f| f.pattern.as_str()).collect::<Vec<_>>().join(", ")
        );
    }
    Ok(out)
}

/// A case with what was lost in reading it.
#[derive(Debug)]
pub struct CaseFolder {
    /// The robot.
    pub robot: RobotSpec,
    /// Recordings in which the simulation is right.
    pub reference: Loaded,
    /// Recordings in which it is not.
    pub recordings: Loaded,
    /// Inputs whose response is to be predicted.
    pub held_out: Loaded,
}

impl CaseFolder {
    /// Opens a case folder: `robot.json` or `robot.toml` (or `robot` given), `reference/`, `recordings/`, and
    /// `heldout/` if it is there.
    ///
    /// # Errors
    /// What is missing or cannot be read.
    pub fn open(folder: &Path, robot_name: Option<&str>, mapping: &Mapping, options: &ReadOptions) -> Result<Self> {
        ensure!(folder.is_dir(), "there is no case folder '{}'", folder.display());
        let robot = if let Some(name) = robot_name {
            robot(name)?
        } else {
            let file = ["robot.json", "robot.toml"]
                .iter()
                .map(|f| folder.join(f))
                .find(|f| f.exists())
                .with_context(|| format!("'{}' holds no robot.json or robot.toml; add one, or name a robot with --robot", folder.display()))?;
            self::robot(&file.display().to_string())?
        };
        let part = |name: &str| -> Result<Loaded> {
            let dir = folder.join(name);
            ensure!(dir.is_dir(), "'{}' has no folder '{name}/'", folder.display());
            load(mapping, &[dir], options)
        };
        let held_out = if folder.join("heldout").is_dir() { part("heldout")? } else { Loaded::default() };
        Ok(Self { robot, reference: part("reference")?, recordings: part("recordings")?, held_out })
    }

    /// The case as the diagnosis takes it, for a torque-driven robot.
    ///
    /// # Errors
    /// Recordings without the signals that are needed.
    pub fn torque_driven(&self) -> Result<diagnosis::Case> {
        let runs = |l: &Loaded| -> Result<Vec<diagnosis::Run>> {
            Ok(l.reads.iter().map(|r| diagnosis::Run::new(&r.recording)).collect::<Result<Vec<_>, _>>()?)
        };
        let held_out =
            self.held_out.reads.iter().map(|r| diagnosis::HeldOut::new(&r.recording)).collect::<Result<Vec<_>, _>>()?;
        Ok(diagnosis::Case {
            robot: self.robot.robot,
            sigma: self.robot.sigma,
            pose_sigma: self.robot.pose_sigma,
            references: runs(&self.reference)?,
            recordings: runs(&self.recordings)?,
            held_out,
        })
    }
}
