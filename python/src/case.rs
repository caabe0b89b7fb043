//! What a diagnosis is asked for, from Python's arguments.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use anyhow::{Result, bail, ensure};
use case_files::case_folder::{self, CaseFolder};
use case_files::inputs::{self, Loaded};
use case_files::own_effects;
use case_files::parts::folders;
use case_files::which_mapping;
use inference::KnownEffects;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};
use recordings::{Mapping, Policy, Read, ReadOptions};
use robot_file::RobotSpec;

use crate::arrays;
use crate::error::{LacunaError, raised};

/// What stands for a mapping where nothing was read from files.
const ARRAYS: &str = "arrays";

/// A robot: a built-in one or a file by name, or a robot file as a dict.
pub(crate) enum RobotGiven {
    Named(String),
    Text(String),
}

impl RobotGiven {
    pub(crate) fn of(given: &Bound<'_, PyAny>) -> PyResult<Self> {
        if given.is_instance_of::<PyDict>() {
            let text = given.py().import("json")?.call_method1("dumps", (given,))?;
            return Ok(Self::Text(text.extract()?));
        }
        Ok(Self::Named(path(given)?.display().to_string()))
    }

    /// The robot, whose effects may be some of one's own.
    pub(crate) fn open(&self, known: KnownEffects) -> Result<RobotSpec> {
        match self {
            Self::Named(name) => case_folder::robot_with(known, name),
            Self::Text(text) => Ok(RobotSpec::parse_with(known, "robot.json", text)?),
        }
    }
}

/// A path: text, or what has a path.
pub(crate) fn path(given: &Bound<'_, PyAny>) -> PyResult<PathBuf> {
    given.extract()
}

/// A mapping by name, or a file.
pub(crate) fn mapping(given: Option<&Bound<'_, PyAny>>) -> PyResult<Option<String>> {
    given.map(|given| Ok(path(given)?.display().to_string())).transpose()
}

/// The catalogue with the effects of law files, and laws that the simulation is given: of each one, or an iterable of them.
pub(crate) fn effects(
    given: Option<&Bound<'_, PyAny>>,
    adopted: Option<&Bound<'_, PyAny>>,
) -> PyResult<KnownEffects> {
    let files = |given: Option<&Bound<'_, PyAny>>| given.map_or_else(|| Ok(Vec::new()), paths);
    own_effects::read(&files(given)?, &files(adopted)?).map_err(|e| raised(&e))
}

/// What to do with bad rows and cells.
pub(crate) fn reading(name: &str) -> PyResult<ReadOptions> {
    let policy = match name {
        "strict" => Policy::Strict,
        "normal" => Policy::Normal,
        "tolerant" => Policy::Tolerant,
        _ => {
            let problem = format!("reading = '{name}': give 'strict', 'normal' or 'tolerant'");
            return Err(LacunaError::new_err(problem));
        }
    };
    Ok(ReadOptions { policy })
}

/// Paths: one, or an iterable of them.
pub(crate) fn paths(given: &Bound<'_, PyAny>) -> PyResult<Vec<PathBuf>> {
    if let Ok(one) = path(given) {
        return Ok(vec![one]);
    }
    given.try_iter()?.map(|item| path(&item?)).collect()
}

/// Drives that play one part: files, folders, and recordings of arrays.
#[derive(Default)]
pub(crate) struct Part {
    paths: Vec<PathBuf>,
    arrays: Vec<Read>,
}

impl Part {
    /// One drive, or an iterable of them.
    pub(crate) fn of(given: Option<&Bound<'_, PyAny>>, usual_name: &str) -> PyResult<Self> {
        let mut out = Self::default();
        let Some(given) = given else { return Ok(out) };
        if given.is_instance_of::<PyDict>() || given.is_instance_of::<PyString>() || path(given).is_ok() {
            out.add(given, usual_name)?;
            return Ok(out);
        }
        for item in given.try_iter()? {
            out.add(&item?, usual_name)?;
        }
        Ok(out)
    }

    fn add(&mut self, given: &Bound<'_, PyAny>, usual_name: &str) -> PyResult<()> {
        if let Ok(dict) = given.cast::<PyDict>() {
            let number = self.arrays.len() + 1;
            self.arrays.push(arrays::read(dict, &format!("{usual_name}_{number}"))?);
        } else {
            self.paths.push(path(given)?);
        }
        Ok(())
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.paths.is_empty() && self.arrays.is_empty()
    }

    /// Reads the files; the arrays follow.
    fn load(self, mapping: Option<&Mapping>, options: ReadOptions) -> Result<Loaded> {
        let mut out = match mapping {
            Some(mapping) if !self.paths.is_empty() => inputs::load(mapping, &self.paths, &options)?,
            _ => Loaded::default(),
        };
        out.sources.extend(self.arrays.iter().flat_map(|read| read.sources.clone()));
        out.reads.extend(self.arrays);
        let mut names = HashSet::new();
        if let Some(twin) = out.reads.iter().map(|read| read.recording.name()).find(|name| !names.insert(*name)) {
            bail!("two recordings are called '{twin}'; give each a name of its own");
        }
        Ok(out)
    }

    /// The only recording.
    pub(crate) fn only(self, mapping: Option<&str>, options: ReadOptions) -> Result<Read> {
        let mapping = needed(mapping, &self.paths)?;
        let loaded = self.load(mapping.as_ref(), options)?;
        let names: Vec<String> = loaded.reads.iter().map(case_folder::file_names).collect();
        match <[Read; 1]>::try_from(loaded.reads) {
            Ok([read]) => Ok(read),
            Err(_) => bail!("give one recording at a time, not {}: {}", names.len(), names.join(", ")),
        }
    }
}

/// The mapping that files need; none without files.
fn needed(name: Option<&str>, paths: &[PathBuf]) -> Result<Option<Mapping>> {
    if paths.is_empty() { Ok(None) } else { which_mapping::named_or_built_in(name, paths).map(Some) }
}

/// A case that was read, with the names of its mapping.
pub(crate) struct Opened {
    pub(crate) case: CaseFolder,
    /// The mapping that was named or found.
    pub(crate) mapping: String,
    /// The mapping, where nobody named it and it is not the one of self-describing columns.
    pub(crate) found: Option<String>,
}

/// A case folder.
pub(crate) fn folder(
    case: &Path,
    robot: Option<&RobotGiven>,
    name: Option<&str>,
    options: ReadOptions,
) -> Result<Opened> {
    let parts: Vec<PathBuf> = folders(case)?.into_iter().filter(|part| part.is_dir()).collect();
    let mapping = which_mapping::named_or_built_in(name, &parts)?;
    let robot = match robot {
        Some(RobotGiven::Named(robot)) => Some(robot.as_str()),
        Some(RobotGiven::Text(_)) => {
            bail!("a case folder takes a robot by name or file; give its drives one by one instead")
        }
        None => None,
    };
    let case = CaseFolder::open(case, robot, &mapping, &options)?;
    Ok(opened(case, name, Some(mapping)))
}

/// Drives one by one: references, recordings, held-out drives.
pub(crate) fn drives(
    robot: &RobotGiven,
    known: KnownEffects,
    parts: [Part; 3],
    name: Option<&str>,
    options: ReadOptions,
) -> Result<Opened> {
    let robot = robot.open(known)?;
    ensure!(!parts[1].is_empty(), "there is nothing to diagnose; give drives as recordings");
    let paths: Vec<PathBuf> = parts.iter().flat_map(|part| part.paths.clone()).collect();
    let mapping = needed(name, &paths)?;
    let [reference, recordings, held_out] = parts.map(|part| part.load(mapping.as_ref(), options));
    let case = CaseFolder::new(robot, [reference?, recordings?, held_out?])?;
    Ok(opened(case, name, mapping))
}

fn opened(case: CaseFolder, name: Option<&str>, mapping: Option<Mapping>) -> Opened {
    let mapping = mapping.map_or_else(|| ARRAYS.to_owned(), |mapping| mapping.name);
    let is_known = name.is_some() || mapping == which_mapping::SELF_DESCRIBING || mapping == ARRAYS;
    let found = (!is_known).then(|| mapping.clone());
    Opened { case, mapping: name.map_or(mapping, str::to_owned), found }
}
