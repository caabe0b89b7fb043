//! Folders of a case, and what of it nobody reads.

use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use recordings::{Format, is_bag};

/// Folders of a case with what belongs into them.
pub(crate) const FOLDERS: [(&str, &str); 3] = [
    ("reference", "drives in which the simulation was right"),
    ("recordings", "drives in which it was not"),
    ("heldout", "inputs whose response is to be predicted"),
];

/// Other names under which they are found.
const SPELLINGS: [&[&str]; 3] = [&["references"], &["recording"], &["held_out", "held-out"]];

/// The folder of a simulator's logs.
pub(crate) const SIMULATION: &str = "simulation";

/// The folders of recorded drives that a case may have.
///
/// # Errors
/// Two folders that are one part of it.
pub fn folders(case: &Path) -> Result<[PathBuf; 3]> {
    let mut out = FOLDERS.map(|(name, _)| case.join(name));
    for (folder, spellings) in out.iter_mut().zip(SPELLINGS) {
        let there = std::iter::once(folder.clone()).chain(spellings.iter().map(|name| case.join(name)));
        let there: Vec<PathBuf> = there.filter(|folder| folder.is_dir()).collect();
        match there.as_slice() {
            [] => {}
            [one] => folder.clone_from(one),
            [one, two, ..] => {
                bail!(
                    "'{}' and '{}' are one part of a case; put the drives into one of them",
                    one.display(),
                    two.display()
                )
            }
        }
    }
    Ok(out)
}

/// Folders of a case that hold recordings and are no part of it, so that nobody reads them.
pub fn unread_folders(case: &Path) -> Vec<String> {
    let parts: Vec<&str> =
        FOLDERS.iter().map(|(name, _)| *name).chain(SPELLINGS.concat()).chain([SIMULATION]).collect();
    let holds_recordings = |folder: &Path| {
        let mut inside = std::fs::read_dir(folder).into_iter().flatten().flatten();
        let is_one = |name: &str| is_bag(name) || Format::stem_of_table(name).is_some();
        inside.any(|entry| is_one(&entry.file_name().to_string_lossy()))
    };
    let inside = std::fs::read_dir(case).into_iter().flatten().flatten();
    let mut out: Vec<String> = inside
        .filter(|entry| entry.path().is_dir() && !parts.iter().any(|part| entry.file_name() == *part))
        .filter(|entry| holds_recordings(&entry.path()))
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    out.sort();
    out
}

/// The folder of a simulator's logs in a case folder, if it is there.
pub fn simulation_of(case: &Path) -> Vec<PathBuf> {
    let folder = case.join(SIMULATION);
    if folder.is_dir() { vec![folder] } else { Vec::new() }
}

#[cfg(test)]
mod tests {
    use super::{folders, unread_folders};

    #[test]
    fn parts_are_found_by_their_usual_spellings_and_what_nobody_reads_is_listed() {
        let case = tempfile::tempdir().expect("a folder");
        let make = |name: &str| std::fs::create_dir(case.path().join(name)).expect("made");
        let found = || folders(case.path()).map(|parts| parts.map(|p| p.file_name().expect("a name").to_owned()));
        assert_eq!(found().expect("none is there"), ["reference", "recordings", "heldout"]);
        ["references", "recordings", "monday", "plots"].into_iter().for_each(make);
        assert_eq!(found().expect("one of each"), ["references", "recordings", "heldout"]);
        std::fs::write(case.path().join("monday/a.csv"), "").expect("written");
        assert_eq!(unread_folders(case.path()), ["monday"]);
        make("reference");
        let twice = found().expect_err("two of one part").to_string();
        assert!(twice.contains("references' are one part of a case; put the drives into one of them"), "{twice}");
    }
}
