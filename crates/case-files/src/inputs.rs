//! Recordings, mappings and robots read from disk.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};
use inference::KnownEffects;
use recordings::{
    Group, GroupFile, Grouping, Loss, Mapping, Opened, Read, ReadOptions, RecordingError, Source, Survey, read_from,
    suggest, survey_from,
};
use robot_file::{RobotFileError, RobotSpec};

use crate::columns::Kind;
use crate::watched::{Pass, Watch, Watched};

/// Recordings read from files, with what was lost.
#[derive(Debug, Clone, Default)]
pub struct Loaded {
    /// Recordings in the order of their names.
    pub reads: Vec<Read>,
    /// What could not be read.
    pub losses: Vec<Loss>,
    /// Files and their SHA-256.
    pub sources: Vec<Source>,
    /// Files that were meant to be read and that no entry of the mapping fits: a loss.
    pub unmatched: Vec<String>,
    /// Other things in the folders, which were not read: no loss, worth telling.
    pub ignored: Vec<String>,
    /// What was read and cannot be, in sentences: a loss.
    pub impossible: Vec<String>,
}

impl Loaded {
    /// What was lost, in sentences.
    pub fn lost(&self) -> impl Iterator<Item = String> + '_ {
        let left_out = self.impossible.iter().cloned();
        self.losses.iter().map(ToString::to_string).chain(not_read(&self.unmatched)).chain(left_out)
    }
}

/// Recordings that were measured and not kept.
#[derive(Debug, Default)]
pub struct Surveyed {
    /// What was found, in the order of the recordings' names.
    pub surveys: Vec<Survey>,
    /// Files that were meant to be read and that no entry of the mapping fits: a loss.
    pub unmatched: Vec<String>,
}

impl Surveyed {
    /// What was lost, in sentences.
    pub fn lost(&self) -> impl Iterator<Item = String> + '_ {
        self.surveys.iter().flat_map(|s| &s.losses).map(ToString::to_string).chain(not_read(&self.unmatched))
    }
}

/// A sentence on each file that no entry fits.
fn not_read(unmatched: &[String]) -> impl Iterator<Item = String> + '_ {
    unmatched.iter().map(|f| format!("{f}: not read: it fits no pattern of the mapping, or stands there twice"))
}

/// A mapping: a built-in one by name, or a TOML file.
///
/// # Errors
/// When it can be neither found nor parsed.
pub fn mapping(name: &str) -> Result<Mapping> {
    let path = Path::new(name);
    if path.is_file() {
        let text = fs::read_to_string(path).with_context(|| format!("cannot read mapping '{name}'"))?;
        return Ok(Mapping::parse(name, &text)?);
    }
    ensure!(!is_path(name), "there is no mapping file '{name}'");
    Ok(Mapping::built_in(name)?)
}

/// A robot: a file, or a built-in one by name.
///
/// # Errors
/// When it can be neither found nor parsed.
pub fn robot(name: &str) -> Result<RobotSpec> {
    robot_with(KnownEffects::default(), name)
}

/// The same of a file whose effects may be some of one's own.
///
/// # Errors
/// As [`robot`].
pub fn robot_with(known: KnownEffects, name: &str) -> Result<RobotSpec> {
    let path = Path::new(name);
    if path.is_file() {
        let text = fs::read_to_string(path).with_context(|| format!("cannot read robot file '{name}'"))?;
        if let Some(kind) = Kind::of_file(&text) {
            bail!(without_signals(name, kind));
        }
        return Ok(RobotSpec::parse_with(known, name, &text)?);
    }
    ensure!(!is_path(name), "there is no robot file '{name}'");
    for kind in Kind::ALL {
        ensure!(kind.built_in().iter().all(|robot| robot.0 != name), without_signals(name, kind));
    }

    let known_names = || {
        let of_columns = Kind::ALL.into_iter().flat_map(Kind::built_in);
        robot_file::BUILT_IN.iter().chain(of_columns).map(|robot| robot.0).collect::<Vec<_>>()
    };
    let spec = RobotSpec::built_in(name).map_err(|e| match e {
        RobotFileError::Unknown { name, .. } => {
            RobotFileError::Unknown { hint: suggest::hint(&name, &known_names()), name }
        }
        other => other,
    })?;
    Ok(RobotSpec { known, ..spec }.adopting())
}

/// Why a robot whose file names its columns itself cannot be asked what needs torques or speeds.
fn without_signals(name: &str, kind: Kind) -> String {
    format!(
        "robot '{name}' is of kind {}, which compares {}: `lacuna diagnose` takes it; this command needs a robot \
         file of one that is driven by torques, set speeds or commanded speeds",
        kind.name(),
        kind.compares()
    )
}

/// Whether a name can only be meant as a file: no built-in name has a slash or ends so.
pub fn is_path(name: &str) -> bool {
    let ends = [".toml", ".json"].iter().any(|e| name.ends_with(e));
    ends || name.contains(['/', '\\'])
}

/// What the given paths hold.
#[derive(Default)]
struct Files {
    /// Files to be read.
    meant: Vec<String>,
    /// What else lies in the folders.
    ignored: Vec<String>,
}

/// Endings of files that a mapping reads: `csv` of `imu_*.csv`, both of `*.{mcap,db3}`.
pub fn endings(mapping: &Mapping) -> BTreeSet<&str> {
    let ending = |pattern: &'_ str| pattern.rsplit_once('*').map_or(pattern.len(), |(start, _)| start.len() + 1);
    let all = mapping.files.iter().flat_map(|f| f.pattern[ending(&f.pattern)..].split(['{', ',', '}']));
    all.filter_map(|end| end.rsplit('.').next()).filter(|end| !end.is_empty()).collect()
}

/// All files below `paths` (a folder's files, those of its folders, or a file itself), sorted within each folder. A bag may
/// be a folder: where the mapping reads bags, folders are looked into one deeper.
///
/// In a folder, a file is meant when it fits the mapping or ends like something that does; notes beside are not.
fn files(mapping: &Mapping, paths: &[PathBuf]) -> Result<Files> {
    let endings = endings(mapping);
    let bags = mapping.files.iter().any(|f| f.topic.is_some());
    let mut out = Files::default();
    for path in paths {
        if path.is_dir() {
            folder(mapping, &endings, path, if bags { 2 } else { 1 }, &mut out)?;
        } else {
            let shown = path.display();
            ensure!(path.exists(), "there is no file or folder '{shown}'; give a recording, or a folder of recordings");
            out.meant.push(shown.to_string());
        }
    }
    Ok(out)
}

/// What lies in a folder, hidden files aside, in the order of the names.
///
/// # Errors
/// When it cannot be listed.
pub fn list(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut inside = fs::read_dir(folder)
        .and_then(Iterator::collect::<std::io::Result<Vec<_>>>)
        .with_context(|| format!("cannot list '{}'", folder.display()))?;
    inside.sort_by_key(fs::DirEntry::file_name);
    inside.retain(|entry| !entry.file_name().as_encoded_bytes().starts_with(b"."));
    Ok(inside.iter().map(fs::DirEntry::path).collect())
}

/// Adds the files of a folder, and of the folders in it down to a depth.
fn folder(mapping: &Mapping, endings: &BTreeSet<&str>, path: &Path, depth: usize, out: &mut Files) -> Result<()> {
    for file in list(path)? {
        let name = file.display().to_string();
        if file.is_dir() && depth > 0 {
            let mut below = Files::default();
            folder(mapping, endings, &file, depth - 1, &mut below)?;
            if below.meant.is_empty() {
                out.ignored.push(name);
            } else {
                out.meant.append(&mut below.meant);
                out.ignored.append(&mut below.ignored);
            }
            continue;
        }
        let ending = file.extension().and_then(|e| e.to_str()).unwrap_or_default();
        let fits = mapping.files.iter().any(|f| f.run_id(&name).is_some());
        let meant = fits || endings.iter().any(|e| e.eq_ignore_ascii_case(ending));
        let list = if file.is_file() && meant { &mut out.meant } else { &mut out.ignored };
        list.push(name);
    }
    Ok(())
}

/// Adds the files of a run that were not named but lie where they should: naming one of a pair is enough.
pub fn complete(group: &mut Group, mapping: &Mapping) {
    for name in std::mem::take(&mut group.missing) {
        let entry = mapping.files.iter().position(|f| f.run_id(&name).is_some());
        match entry.filter(|_| Path::new(&name).is_file()) {
            Some(entry) => group.files.push(GroupFile { entry, name }),
            None => group.missing.push(name),
        }
    }
}

/// Names of the runs: the file's alone, since labels in folder names are no evidence; with the folder where two runs
/// would be called the same.
pub(crate) fn run_names(groups: &[Group]) -> Vec<String> {
    let last = |run: &str, parts: usize| {
        let all: Vec<&str> = run.split(['/', '\\']).filter(|p| !p.is_empty()).collect();
        all[all.len().saturating_sub(parts)..].join("/")
    };
    let mut names: Vec<String> = groups.iter().map(|g| last(&g.run, 1)).collect();
    for parts in 2..=usize::MAX {
        let mut count: BTreeMap<&str, usize> = BTreeMap::new();
        for name in &names {
            *count.entry(name).or_default() += 1;
        }
        let longer: Vec<String> = names
            .iter()
            .zip(groups)
            .map(|(name, g)| if count[name.as_str()] > 1 { last(&g.run, parts) } else { name.clone() })
            .collect();
        if longer == names {
            break;
        }
        names = longer;
    }
    names
}

/// Reads every recording in files and folders.
///
/// # Errors
/// The first file that cannot be read, or none at all.
pub fn load(mapping: &Mapping, paths: &[PathBuf], options: &ReadOptions) -> Result<Loaded> {
    let runs = runs(mapping, paths, &|_, _| {}, |run, files| read_from(mapping, run, files, options))?;
    let (losses, sources) = (runs.found.iter().flat_map(|r| &r.losses), runs.found.iter().flat_map(|r| &r.sources));
    Ok(Loaded {
        losses: losses.cloned().collect(),
        sources: sources.cloned().collect(),
        reads: runs.found,
        unmatched: runs.unmatched,
        ignored: runs.ignored,
        ..Loaded::default()
    })
}

/// Measures every recording in files and folders, without keeping its samples; `watch` is told how far that is.
///
/// # Errors
/// As [`load`].
pub fn survey(mapping: &Mapping, paths: &[PathBuf], options: &ReadOptions, watch: Watch<'_>) -> Result<Surveyed> {
    let runs = runs(mapping, paths, watch, |run, files| survey_from(mapping, run, files, options))?;
    Ok(Surveyed { surveys: runs.found, unmatched: runs.unmatched })
}

/// What was found of each run, and what is none.
struct Runs<T> {
    found: Vec<T>,
    unmatched: Vec<String>,
    ignored: Vec<String>,
}

/// The runs in files and folders, none of them opened yet.
pub struct Plan {
    groups: Vec<Group>,
    names: Vec<String>,
    /// Files that were meant to be read and that no entry of the mapping fits: a loss.
    pub unmatched: Vec<String>,
    /// Other things in the folders.
    pub ignored: Vec<String>,
}

impl Plan {
    /// Looks which files make which runs.
    ///
    /// # Errors
    /// A path that is not there, and when no file fits the mapping.
    pub fn new(mapping: &Mapping, paths: &[PathBuf]) -> Result<Self> {
        let files = files(mapping, paths)?;
        let Grouping { mut groups, unmatched } = mapping.group(&files.meant);
        for group in &mut groups {
            complete(group, mapping);
        }
        if groups.is_empty() {
            let quoted: Vec<String> = paths.iter().map(|p| format!("'{}'", p.display())).collect();
            let mut patterns: Vec<&str> = Vec::new();
            for pattern in mapping.files.iter().map(|f| f.pattern.as_str()) {
                // A mapping of bags has an entry, and a pattern, for each topic.
                if !patterns.contains(&pattern) {
                    patterns.push(pattern);
                }
            }
            bail!(
                "no file in {} fits the mapping '{}' ({}); put recordings there, or name another mapping with --mapping",
                quoted.join(", "),
                mapping.name,
                patterns.join(", ")
            );
        }
        let names = run_names(&groups);
        Ok(Self { groups, names, unmatched, ignored: files.ignored })
    }

    /// Names of the runs, at least one.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// How many runs there are.
    pub(crate) fn len(&self) -> usize {
        self.groups.len()
    }

    /// Bytes of the files of a run, as far as they can be told.
    pub(crate) fn bytes(&self, run: usize) -> u64 {
        self.groups[run].files.iter().filter_map(|f| Some(fs::metadata(&f.name).ok()?.len())).sum()
    }

    /// Opens the files of a run, and gives them with its name to `read`; `pass` is called
    /// with what is read of them.
    pub(crate) fn open<T>(
        &self,
        run: usize,
        pass: &Pass<'_>,
        read: impl FnOnce(&str, &mut [Opened<'_>]) -> Result<T, RecordingError>,
    ) -> Result<T> {
        let files = &self.groups[run].files;
        let mut sources = files
            .iter()
            .map(|f| {
                let file = fs::File::open(&f.name).with_context(|| format!("cannot read '{}'", f.name))?;
                Ok(Watched::new(file, pass))
            })
            .collect::<Result<Vec<_>>>()?;
        let mut opened: Vec<Opened<'_>> =
            files.iter().zip(&mut sources).map(|(f, source)| Opened { name: &f.name, source }).collect();
        Ok(read(&self.names[run], &mut opened)?)
    }
}

/// Opens the files of every run in files and folders, and gives them with the run's name to `read`.
fn runs<T>(
    mapping: &Mapping,
    paths: &[PathBuf],
    watch: Watch<'_>,
    mut read: impl FnMut(&str, &mut [Opened<'_>]) -> Result<T, RecordingError>,
) -> Result<Runs<T>> {
    let plan = Plan::new(mapping, paths)?;
    let pass = Pass::new((0..plan.len()).map(|run| plan.bytes(run)).sum(), watch);
    let found = (0..plan.len()).map(|run| plan.open(run, &pass, &mut read)).collect::<Result<_>>()?;
    Ok(Runs { found, unmatched: plan.unmatched, ignored: plan.ignored })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn endings_are_those_of_the_patterns() {
        let of = |name: &str| {
            endings(&Mapping::built_in(name).expect("built in")).into_iter().map(str::to_owned).collect::<Vec<_>>()
        };
        assert_eq!(of("husky-open"), ["csv"]);
        assert_eq!(of("kobuki-bag"), ["db3", "mcap", "zstd"]);
    }

    #[test]
    fn a_pattern_of_many_entries_is_listed_once() {
        let folder = tempfile::tempdir().expect("a folder");
        let bags = Mapping::built_in("kobuki-bag").expect("built in");
        assert!(bags.files.len() > 1, "a mapping of bags has an entry for each topic");
        let refused = Plan::new(&bags, &[folder.path().to_owned()]).map(|_| ()).expect_err("nothing is there");
        let message = refused.to_string();
        assert_eq!(message.matches(&bags.files[0].pattern).count(), 1, "{message}");
    }

    #[test]
    fn runs_take_as_much_of_their_path_as_tells_them_apart() {
        let group = |run: &str| Group { run: run.to_owned(), files: vec![], missing: vec![] };
        let names = run_names(&[group("a/x/01"), group("a/y/01"), group("a/y/02"), group("01")]);
        assert_eq!(names, ["x/01", "y/01", "02", "01"]);
        assert_eq!(run_names(&[group("01"), group("01")]), ["01", "01"]);
    }
}
