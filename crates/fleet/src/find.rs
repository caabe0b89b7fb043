//! Units in folders.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Result, ensure};
use case_files::case_folder::robot_of;
use case_files::inputs::{endings, list, mapping};
use case_files::parts::folders;
use case_files::which_mapping::SELF_DESCRIBING;
use recordings::Mapping;

use super::unit::{Defaults, Setup, Unit};

/// Folders within folders that are looked into.
pub const DEEPEST: usize = 8;
/// A mapping of bags: all of them find the runs of bags in the same way.
const ANY_BAGS: &str = "kobuki-bag";

/// What was found in a folder.
#[derive(Debug, Default)]
pub struct FolderContents {
    /// The units.
    pub units: Vec<Unit>,
    /// Files that end like recordings and that no mapping reads: a loss.
    pub unread: Vec<String>,
}

/// A recording in a folder.
struct Run {
    /// Its name below the folder.
    name: String,
    files: Vec<PathBuf>,
}

/// Every recording of every case folder in a folder, however deep below it (at most [`DEEPEST`]). A case folder holds
/// `robot.toml` or `robot.json` and `recordings/`; its references are those of each of its recordings.
///
/// # Errors
/// When a folder cannot be listed, or there is no case folder.
pub fn cases_below(folder: &Path, named: Option<&str>) -> Result<FolderContents> {
    let mut cases = Vec::new();
    find_cases(folder, DEEPEST, &mut BTreeSet::new(), &mut cases)?;
    let shown = folder.display();
    ensure!(
        !cases.is_empty(),
        "there is no case folder (robot.toml or robot.json, and recordings/) in '{shown}' or up to {DEEPEST} folders below \
         it; if it holds recordings of one robot, name that with --robot"
    );
    let known = named.map(mapping).transpose()?;
    let mut out = FolderContents::default();
    for case in cases {
        let [reference, recordings, _] = folders(&case)?;
        let below = relative(folder, &case);
        let own_name =
            || case.canonicalize().ok().and_then(|c| c.file_name().map(|n| n.to_string_lossy().into_owned()));
        let robot_id = if below.is_empty() { own_name().unwrap_or_default() } else { below.clone() };
        let setup = Setup {
            // Two robot files in one folder are no reason to leave the other cases: the units will tell.
            robot: robot_of(&case).unwrap_or_else(|_| case.join("robot.toml")).display().to_string(),
            reference: if reference.is_dir() { vec![reference] } else { Vec::new() },
            mapping: named.map(str::to_owned),
        };
        let (runs, unread) = runs_below(&recordings, known.as_ref(), &[])?;
        out.unread.extend(unread);
        out.units.extend(runs.into_iter().map(|run| Unit {
            id: if below.is_empty() { run.name } else { format!("{below}/{}", run.name) },
            recording: run.files,
            robot_id: Some(robot_id.clone()),
            date: None,
            setup: setup.clone(),
        }));
    }
    Ok(out)
}

/// Every recording in a folder, however deep below it (at most [`DEEPEST`]), of one robot; its references aside.
///
/// # Errors
/// When a folder cannot be listed, or there is no recording.
pub fn recordings_below(folder: &Path, robot: &str, defaults: &Defaults) -> Result<FolderContents> {
    let named = defaults.mapping.as_deref().map(mapping).transpose()?;
    let (runs, unread) = runs_below(folder, named.as_ref(), &defaults.reference)?;
    let setup =
        Setup { robot: robot.to_owned(), reference: defaults.reference.clone(), mapping: defaults.mapping.clone() };
    let unit = |run: Run| Unit { id: run.name, recording: run.files, robot_id: None, date: None, setup: setup.clone() };
    let units: Vec<Unit> = runs.into_iter().map(unit).collect();
    ensure!(
        !units.is_empty(),
        "there is no recording in '{}' or up to {DEEPEST} folders below it{}",
        folder.display(),
        named.map_or_else(String::new, |m| format!(" that fits the mapping '{}'", m.name))
    );
    Ok(FolderContents { units, unread })
}

/// Whether a folder is a case.
fn is_case(folder: &Path) -> bool {
    let has_robot = ["robot.json", "robot.toml"].iter().any(|f| folder.join(f).is_file());
    has_robot && folder.join("recordings").is_dir()
}

fn find_cases(folder: &Path, depth: usize, seen: &mut BTreeSet<PathBuf>, out: &mut Vec<PathBuf>) -> Result<()> {
    if is_case(folder) {
        out.push(folder.to_owned());
        return Ok(());
    }
    // A link may lead back to a folder above.
    if depth > 0 && fs::canonicalize(folder).is_ok_and(|real| seen.insert(real)) {
        for inside in list(folder)?.iter().filter(|path| path.is_dir()) {
            find_cases(inside, depth - 1, seen, out)?;
        }
    }
    Ok(())
}

/// The recordings in a folder and below it, but for what lies at `aside`; and files that end like recordings and are none.
fn runs_below(folder: &Path, named: Option<&Mapping>, aside: &[PathBuf]) -> Result<(Vec<Run>, Vec<String>)> {
    let aside: Vec<PathBuf> = aside.iter().filter_map(|path| fs::canonicalize(path).ok()).collect();
    let mut files = Vec::new();
    find_files(folder, DEEPEST, &mut BTreeSet::new(), &aside, &mut files)?;
    let mut names: Vec<String> = files.iter().map(|f| f.display().to_string()).collect();
    let built_in;
    let mappings: Vec<&Mapping> = if let Some(named) = named {
        vec![named]
    } else {
        built_in = [Mapping::built_in(SELF_DESCRIBING)?, Mapping::built_in(ANY_BAGS)?];
        built_in.iter().collect()
    };
    let mut runs = Vec::new();
    for mapping in &mappings {
        let grouping = mapping.group(&names);
        for group in grouping.groups {
            let files = group.files.iter().map(|f| PathBuf::from(&f.name)).collect();
            runs.push(Run { name: relative(folder, Path::new(&group.run)), files });
        }
        names = grouping.unmatched;
    }
    tell_apart(&mut runs, folder);
    let like_one = |name: &String| {
        let ending = Path::new(name).extension().and_then(|e| e.to_str()).unwrap_or_default();
        mappings.iter().any(|m| endings(m).iter().any(|e| e.eq_ignore_ascii_case(ending)))
    };
    names.retain(like_one);
    Ok((runs, names))
}

fn find_files(
    folder: &Path,
    depth: usize,
    seen: &mut BTreeSet<PathBuf>,
    aside: &[PathBuf],
    out: &mut Vec<PathBuf>,
) -> Result<()> {
    if depth == 0 || !fs::canonicalize(folder).is_ok_and(|real| seen.insert(real)) {
        return Ok(());
    }
    for path in list(folder)? {
        if fs::canonicalize(&path).is_ok_and(|real| aside.contains(&real)) {
            continue;
        }
        if path.is_dir() {
            find_files(&path, depth - 1, seen, aside, out)?;
        } else {
            out.push(path);
        }
    }
    Ok(())
}

/// Runs of the same name, of different formats, take the name of their first file.
fn tell_apart(runs: &mut [Run], folder: &Path) {
    let names: Vec<String> = runs.iter().map(|r| r.name.clone()).collect();
    for run in runs.iter_mut() {
        if names.iter().filter(|name| **name == run.name).count() > 1
            && let Some(first) = run.files.first()
        {
            run.name = relative(folder, first);
        }
    }
}

/// A path below a folder, with slashes.
fn relative(folder: &Path, path: &Path) -> String {
    let below = path.strip_prefix(folder).unwrap_or(path);
    below.components().map(|c| c.as_os_str().to_string_lossy()).collect::<Vec<_>>().join("/")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder_with(files: &[&str]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().expect("a folder");
        for file in files {
            let path = folder.path().join(file);
            fs::create_dir_all(path.parent().expect("a folder")).expect("creates");
            fs::write(path, "x").expect("writes");
        }
        folder
    }

    fn ids(found: &FolderContents) -> Vec<&str> {
        found.units.iter().map(|u| u.id.as_str()).collect()
    }

    #[test]
    fn cases_are_found_at_any_depth_with_their_references() {
        let folder = folder_with(&[
            "a/robot.toml",
            "a/reference/ref_1.csv",
            "a/recordings/run_1.csv",
            "a/recordings/run_2.csv",
            "b/c/d/robot.json",
            "b/c/d/recordings/walk/walk_0.mcap",
            "b/c/d/recordings/walk/walk_1.mcap",
            "b/c/d/recordings/walk/metadata.yaml",
            "notes/readme.csv",
        ]);
        let found = cases_below(folder.path(), None).expect("two cases");
        assert_eq!(ids(&found), ["a/run_1", "a/run_2", "b/c/d/walk/walk"]);
        assert_eq!(found.units[0].setup.reference, [folder.path().join("a/reference")]);
        assert_eq!(found.units[0].robot_id.as_deref(), Some("a"));
        assert_eq!((found.units[2].recording.len(), found.units[2].setup.reference.len()), (2, 0));
        let one = cases_below(&folder.path().join("a"), None).expect("a case");
        assert_eq!((ids(&one), one.units[0].robot_id.as_deref()), (vec!["run_1", "run_2"], Some("a")));
        let none = cases_below(&folder.path().join("notes"), None).expect_err("no case").to_string();
        assert!(none.contains("--robot") && none.contains("robot.toml"), "{none}");
    }

    #[test]
    fn every_recording_below_a_folder_is_a_unit_but_for_the_references() {
        let folder =
            folder_with(&["good/r.csv", "day 1/run_1.csv", "day 1/run_1.mcap", "day 2/x/run_1.csv", "notes.txt"]);
        let defaults = Defaults { reference: vec![folder.path().join("good")], ..Defaults::default() };
        let found = recordings_below(folder.path(), "husky-a200", &defaults).expect("recordings");
        assert_eq!(ids(&found), ["day 1/run_1.csv", "day 2/x/run_1", "day 1/run_1.mcap"]);
        let defaults = Defaults { mapping: Some("husky-open".to_owned()), ..Defaults::default() };
        let error = recordings_below(folder.path(), "husky-a200", &defaults).expect_err("none fits").to_string();
        assert!(error.contains("husky-open"), "{error}");
    }

    #[cfg(unix)]
    #[test]
    fn a_link_that_leads_back_is_followed_once() {
        let folder = folder_with(&["a/robot.toml", "a/recordings/run_1.csv", "b/run_2.csv"]);
        std::os::unix::fs::symlink(folder.path(), folder.path().join("b/back")).expect("links");
        assert_eq!(ids(&cases_below(folder.path(), None).expect("a case")), ["a/run_1"]);
        let all = recordings_below(folder.path(), "husky-a200", &Defaults::default()).expect("recordings");
        assert_eq!(ids(&all), ["a/recordings/run_1", "b/run_2"]);
    }
}
