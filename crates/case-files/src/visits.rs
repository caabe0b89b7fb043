//! Which drives are of one day, place and load: as the user says, by folders, or by start times.

use std::collections::{BTreeMap, HashSet};
use std::path::{Path, PathBuf};

use anyhow::{Result, bail, ensure};
use recordings::Read;
use torque_driven::{KnownBy, Visit};

use crate::case_folder::file_names;
use crate::inputs::Loaded;

/// Drives that are listed where a visit is of none.
const LISTED: usize = 6;

/// A visit that the user names, and which drives are of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct GivenVisit {
    /// Its name.
    pub name: String,
    /// Files or folders, or the ends of their paths; `*` stands for anything.
    pub patterns: Vec<String>,
}

impl GivenVisit {
    /// Reads `NAME=FILE[,FILE...]`.
    ///
    /// ```
    /// use case_files::visits::GivenVisit;
    ///
    /// let visit = GivenVisit::parse("monday=reference/mon_*,recordings/run_1.csv")?;
    /// assert_eq!((visit.name.as_str(), visit.patterns.len()), ("monday", 2));
    /// assert!(GivenVisit::parse("monday").is_err());
    /// # Ok::<(), String>(())
    /// ```
    ///
    /// # Errors
    /// A sentence on what is missing.
    pub fn parse(text: &str) -> Result<Self, String> {
        let example = "write it as monday=reference/mon_* or monday=reference/,recordings/run_1.csv";
        let (name, patterns) = text.split_once('=').ok_or_else(|| format!("'{text}' has no `=`; {example}"))?;
        let patterns: Vec<String> = patterns.split(',').map(|p| p.trim().to_owned()).collect();
        if name.trim().is_empty() {
            return Err(format!("'{text}' names no visit before the `=`; {example}"));
        }
        if patterns.iter().any(String::is_empty) {
            return Err(format!("'{text}' names no file or folder after the `=` or a comma; {example}"));
        }
        Ok(Self { name: name.trim().to_owned(), patterns })
    }

    /// The pattern that a drive fits, if any does.
    fn pattern_of(&self, read: &Read) -> Option<&str> {
        self.patterns.iter().map(String::as_str).find(|pattern| fits(pattern, read))
    }
}

/// Whether a drive fits a pattern: by its name, or by the path of one of its files or the end of that path.
fn fits(pattern: &str, read: &Read) -> bool {
    let pattern = pattern.replace('\\', "/");
    let pattern = pattern.trim_end_matches('/');
    let below = format!("{pattern}/*");
    let is_path = |path: &str| matches(pattern, path) || matches(&below, path);
    let ends = |path: &str| {
        let path = path.replace('\\', "/");
        let starts = path.match_indices('/').map(|(at, _)| at + 1);
        std::iter::once(0).chain(starts).any(|at| is_path(&path[at..]))
    };
    matches(pattern, read.recording.name()) || read.sources.iter().any(|source| ends(&source.name))
}

/// Whether a text is that of a pattern, in which `*` stands for any text.
fn matches(pattern: &str, text: &str) -> bool {
    let mut parts = pattern.split('*');
    let Some(mut rest) = parts.next().and_then(|first| text.strip_prefix(first)) else { return false };
    let Some(last) = parts.next_back() else { return rest.is_empty() };
    for part in parts {
        let Some(at) = rest.find(part) else { return false };
        rest = &rest[at + part.len()..];
    }
    rest.ends_with(last)
}

/// Refuses visits of which one is named twice, one is of no drive, or two are of the same drive.
///
/// # Errors
/// The first of these, with what to do.
pub fn check(given: &[GivenVisit], parts: [&Loaded; 2]) -> Result<()> {
    let mut names = HashSet::new();
    if let Some(twice) = given.iter().find(|visit| !names.insert(&visit.name)) {
        bail!(
            "--visit names '{0}' twice; name it once, with all of its files: --visit '{0}={1}'",
            twice.name,
            given.iter().filter(|v| v.name == twice.name).map(|v| v.patterns.join(",")).collect::<Vec<_>>().join(",")
        );
    }

    let reads = || parts.into_iter().flat_map(|part| &part.reads);
    for visit in given {
        let lost = visit.patterns.iter().find(|pattern| !reads().any(|read| fits(pattern, read)));
        if let Some(pattern) = lost {
            let shown: Vec<String> = reads().take(LISTED).map(file_names).collect();
            let rest = if reads().count() > LISTED { ", ..." } else { "" };
            bail!(
                "--visit {}: no reference and no recording is '{pattern}'; give the name of a file or a folder, or its end, with \
                 `*` for anything ({}{rest})",
                visit.name,
                shown.join(", ")
            );
        }
    }
    for read in reads() {
        let mut fitting = given.iter().filter_map(|visit| Some((&visit.name, visit.pattern_of(read)?)));
        if let (Some((one, first)), Some((other, second))) = (fitting.next(), fitting.next()) {
            ensure!(
                false,
                "'{}' is of two visits, '{one}' ({first}) and '{other}' ({second}); a drive is of one: make the files of one \
                 --visit fewer",
                file_names(read)
            );
        }
    }
    Ok(())
}

/// The visit of each drive of a part (`reference` or `recordings`): the one that the user names, else the one that is found;
/// `None` where all others of the part are of one.
pub(crate) fn of(part: &str, loaded: &Loaded, given: &[GivenVisit]) -> Vec<Option<Visit>> {
    let of_user = |read: &Read| {
        let visit = given.iter().find(|visit| visit.pattern_of(read).is_some())?;
        Some(Visit { name: visit.name.clone(), known_by: KnownBy::User })
    };
    let found = by_folder(part, &loaded.reads).or_else(|| by_start(part, &loaded.reads));
    let found = found.unwrap_or_else(|| vec![None; loaded.reads.len()]);
    loaded.reads.iter().zip(found).map(|(read, found)| of_user(read).or(found)).collect()
}

/// Visits by the folders in which files lie, if there are several and not every drive has one of its own: many loggers
/// make a folder of each drive.
fn by_folder(part: &str, reads: &[Read]) -> Option<Vec<Option<Visit>>> {
    let folders: Vec<PathBuf> = reads.iter().map(folder).collect();
    let mut drives: BTreeMap<&PathBuf, HashSet<&str>> = BTreeMap::new();
    for (folder, read) in folders.iter().zip(reads) {
        drives.entry(folder).or_default().insert(recording(read));
    }
    if drives.len() < 2 || drives.values().all(|of_folder| of_folder.len() < 2) {
        return None;
    }
    let mut names = HashSet::new();
    let last = |folder: &Path| folder.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    let are_short = drives.keys().all(|folder| names.insert(last(folder)));
    let name = |folder: &PathBuf| if are_short { last(folder) } else { folder.display().to_string() };
    let visit = |folder| Visit { name: format!("{part}: {}", name(folder)), known_by: KnownBy::Folder };
    Some(folders.iter().map(|folder| Some(visit(folder))).collect())
}

/// The folder in which a drive lies; a bag may itself be a folder.
fn folder(read: &Read) -> PathBuf {
    let file = Path::new(read.sources.first().map_or("", |source| &source.name));
    let own = file.parent().unwrap_or(file);
    if own.join("metadata.yaml").is_file() { own.parent().unwrap_or(own).to_owned() } else { own.to_owned() }
}

/// What a drive was recorded in: stretches of a long one have it in common.
fn recording(read: &Read) -> &str {
    read.sources.first().map_or_else(|| read.recording.name(), |source| &source.name)
}

/// Visits by when drives were started, if they were started hours apart and their clocks tell so.
fn by_start(part: &str, reads: &[Read]) -> Option<Vec<Option<Visit>>> {
    let first = |read: &Read| read.recording.channels().iter().filter_map(|c| c.t_ns().first().copied()).min();
    let mut starts: BTreeMap<&str, i64> = BTreeMap::new();
    for read in reads {
        let start = first(read)?;
        let known = starts.entry(recording(read)).or_insert(start);
        *known = start.min(*known);
    }
    let of_reads: Vec<i64> = reads.iter().filter_map(|read| starts.get(recording(read)).copied()).collect();
    let visits = diagnosis::visits::by_start(&of_reads)?;

    let name = |visit: usize| {
        let of_it = (0..reads.len()).filter(|&i| visits[i] == visit).min_by_key(|&i| of_reads[i]);
        of_it.map_or_else(String::new, |i| reads[i].recording.name().to_owned())
    };
    let visit =
        |&visit: &usize| Some(Visit { name: format!("{part}: from {} on", name(visit)), known_by: KnownBy::StartTime });
    Some(visits.iter().map(visit).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use recordings::{Channel, Clock, Recording, Signal, Source};

    const HOUR: i64 = 3_600_000_000_000;
    const MONDAY: i64 = 1_772_352_000_000_000_000;

    /// A drive in a file, with its first stamp.
    fn read(file: &str, start_ns: i64) -> Read {
        let stem = Path::new(file).file_stem().expect("a name").to_string_lossy().into_owned();
        let channel = Channel::new(Signal::GyroZ, 0, vec![start_ns, start_ns + HOUR], vec![0.0; 2]).expect("rising");
        let clocks = vec![Clock { name: file.to_owned(), nominal_rate_hz: None }];
        let recording = Recording::new(stem, clocks, vec![channel]).expect("a recording");
        let sources = vec![Source { name: file.to_owned(), bytes: 0, sha256: file.to_owned() }];
        Read { recording, losses: Vec::new(), sources, unused: Vec::new() }
    }

    fn part(files: &[&str]) -> Loaded {
        Loaded { reads: files.iter().map(|file| read(file, 0)).collect(), ..Loaded::default() }
    }

    fn given(texts: &[&str]) -> Vec<GivenVisit> {
        texts.iter().map(|text| GivenVisit::parse(text).expect("a visit")).collect()
    }

    fn names(visits: &[Option<Visit>]) -> Vec<Option<&str>> {
        visits.iter().map(|visit| visit.as_ref().map(|visit| visit.name.as_str())).collect()
    }

    #[test]
    fn a_drive_fits_its_name_its_file_and_its_folders() {
        let drive = read("case/reference/mon/run_12.csv", 0);
        let fitting = [
            "*",
            "run_12",
            "run_12.csv",
            "run_*",
            "*_1*.csv",
            "mon",
            "mon/",
            "reference",
            "reference/*",
            "reference/mon/run_12.csv",
            "case/reference/mon/run_12.csv",
            r"reference\mon",
        ];
        for pattern in fitting {
            assert!(fits(pattern, &drive), "{pattern}");
        }
        for pattern in ["run_1", "run", "on/run_12.csv", "on", "recordings/*", "run_12.csv/x", "*_2.csv", "run_*12_*"] {
            assert!(!fits(pattern, &drive), "{pattern}");
        }
    }

    #[test]
    fn what_is_no_visit_is_refused_with_an_example() {
        for text in ["monday", "=run_1", " =run_1", "monday=", "monday=a,,b"] {
            let error = GivenVisit::parse(text).expect_err("refused");
            assert!(error.contains(&format!("'{text}'")) && error.contains("monday=reference/"), "{error}");
        }
    }

    #[test]
    fn visits_that_contradict_each_other_or_are_of_no_drive_are_refused() {
        let (reference, recordings) = (part(&["reference/a.csv", "reference/b.csv"]), part(&["recordings/c.csv"]));
        let error = |texts: &[&str]| check(&given(texts), [&reference, &recordings]).expect_err("refused").to_string();
        assert!(check(&given(&["x=a,c", "y=b"]), [&reference, &recordings]).is_ok());

        let twice = error(&["x=a", "x=c.csv"]);
        assert!(twice.contains("names 'x' twice") && twice.contains("--visit 'x=a,c.csv'"), "{twice}");
        let none = error(&["x=a,d"]);
        assert!(none.contains("--visit x:") && none.contains("is 'd'") && none.contains("recordings/c.csv"), "{none}");
        let both = error(&["x=reference", "y=*b.csv"]);
        let wanted = "'reference/b.csv' is of two visits, 'x' (reference) and 'y' (*b.csv)";
        assert!(both.contains(wanted), "{both}");
    }

    #[test]
    fn what_the_user_says_goes_before_what_is_found() {
        let days = part(&["r/mon/a.csv", "r/mon/b.csv", "r/tue/c.csv"]);
        let found = of("reference", &days, &[]);
        let monday = Some("reference: mon");
        assert_eq!(names(&found), [monday, monday, Some("reference: tue")]);
        assert!(found.iter().flatten().all(|visit| visit.known_by == KnownBy::Folder));

        let said = of("reference", &days, &given(&["today=b,c"]));
        assert_eq!(names(&said), [monday, Some("today"), Some("today")]);
        assert_eq!(said[1].as_ref().map(|visit| visit.known_by), Some(KnownBy::User));
    }

    #[test]
    fn a_folder_for_every_drive_and_a_folder_for_all_are_no_visits() {
        assert_eq!(of("reference", &part(&["r/1/a.csv", "r/2/a.csv", "r/3/a.csv"]), &[]), [None, None, None]);
        assert_eq!(of("reference", &part(&["r/a.csv", "r/b.csv"]), &[]), [None, None]);
    }

    #[test]
    fn drives_that_were_started_a_night_apart_are_of_two_visits() {
        let at = |starts: [i64; 3]| {
            let files = ["a.csv", "b.csv", "c.csv"];
            let reads = files.iter().zip(starts).map(|(file, start)| read(file, start)).collect();
            of("recordings", &Loaded { reads, ..Loaded::default() }, &[])
        };
        let first = Some("recordings: from b on");
        assert_eq!(
            names(&at([MONDAY + 24 * HOUR, MONDAY, MONDAY + HOUR])),
            [Some("recordings: from a on"), first, first]
        );
        assert_eq!(at([MONDAY, MONDAY + 5 * HOUR, MONDAY + 10 * HOUR]), [None, None, None], "a day with two breaks");
        assert_eq!(at([0, 24 * HOUR, 48 * HOUR]), [None, None, None], "clocks that start with the robot tell no date");
    }

    #[test]
    fn stretches_of_a_long_drive_are_of_one_visit() {
        let stretch = |start| read("long.csv", start);
        let reads = vec![stretch(MONDAY), stretch(MONDAY + 20 * HOUR)];
        assert_eq!(of("recordings", &Loaded { reads, ..Loaded::default() }, &[]), [None, None]);
    }
}
