//! SHA-256 of every file of a case and of its truth, written before anything is diagnosed.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};
use examiner::{DrawnCase, sha256};
use serde::{Deserialize, Serialize};

use super::layout::Layout;

/// SHA-256 by path within a folder; paths have forward slashes on every system.
type Files = BTreeMap<String, String>;

/// The seal of a case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Seal {
    /// SHA-256 of what the case was drawn from: its plan and the drawing program.
    pub(super) plan: String,
    /// What the diagnoser gets.
    case: Files,
    /// What was hidden.
    truth: Files,
}

impl Seal {
    pub(super) fn of(plan: String, drawn: &DrawnCase) -> Self {
        let files = |list: &[(PathBuf, Vec<u8>)]| -> Files {
            list.iter().map(|(path, bytes)| (slashed(path), sha256(bytes))).collect()
        };
        Self { plan, case: files(&drawn.files), truth: files(&drawn.truth_files) }
    }

    /// One text that stands for all files.
    pub(super) fn digest(&self) -> String {
        let mut all = String::new();
        for (path, hash) in self.case.iter().chain(&self.truth) {
            all += &[path, " ", hash, "\n"].concat();
        }
        sha256(all.as_bytes())
    }

    /// Whether every file is there, whatever it holds.
    pub(super) fn is_there(&self, layout: &Layout, name: &str) -> bool {
        let all = |folder: &Path, files: &Files| files.keys().all(|path| folder.join(path).is_file());
        all(&layout.case(name), &self.case) && all(&layout.truth(name), &self.truth)
    }

    /// Checks what the diagnoser gets.
    pub(super) fn check_case(&self, layout: &Layout, name: &str) -> Result<()> {
        check(&layout.case(name), &self.case)
            .with_context(|| format!("case {name} is not what was sealed; delete its folder to have it drawn again"))
    }

    /// Checks what was hidden.
    pub(super) fn check_truth(&self, layout: &Layout, name: &str) -> Result<()> {
        check(&layout.truth(name), &self.truth).with_context(|| {
            format!("the truth of case {name} is not what was sealed; delete its folder to have it drawn again")
        })
    }
}

/// The seals of all cases in a folder, by name.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub(crate) struct Seals(pub(super) BTreeMap<String, Seal>);

impl Seals {
    /// The seals of what was drawn into this folder before. A folder with cases of others is refused: drawing would
    /// replace them.
    pub(crate) fn open(layout: &Layout) -> Result<Self> {
        let path = layout.seals();
        if !path.exists() {
            let cases = layout.cases();
            ensure!(
                fs::read_dir(&cases).map_or(true, |mut entries| entries.next().is_none()),
                "'{}' holds cases that were not drawn by this command; choose another folder with --out",
                cases.display()
            );
            return Ok(Self::default());
        }
        let text = fs::read_to_string(&path).with_context(|| format!("cannot read '{}'", path.display()))?;
        serde_json::from_str(&text)
            .with_context(|| format!("'{}' holds no seals; delete it together with the cases", path.display()))
    }

    /// Names of the cases that are sealed, in order.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.0.keys().map(String::as_str)
    }

    pub(super) fn save(&self, layout: &Layout) -> Result<()> {
        let path = layout.seals();
        fs::create_dir_all(layout.root())
            .and_then(|()| fs::write(&path, serde_json::to_string_pretty(self)? + "\n"))
            .with_context(|| format!("cannot write '{}'", path.display()))
    }

    pub(super) fn of(&self, name: &str) -> Result<&Seal> {
        self.0.get(name).with_context(|| format!("case {name} has no seal"))
    }
}

/// Every sealed file as it was, and no other.
fn check(folder: &Path, sealed: &Files) -> Result<()> {
    for (path, hash) in sealed {
        let path = folder.join(path);
        let bytes = fs::read(&path).with_context(|| format!("cannot read '{}'", path.display()))?;
        ensure!(sha256(&bytes) == *hash, "'{}' was changed: its SHA-256 is not {hash}", path.display());
    }
    let mut found = BTreeSet::new();
    list(folder, folder, &mut found)?;
    let stranger = found.iter().find(|path| !sealed.contains_key(*path));
    ensure!(stranger.is_none(), "'{}' was added to it", stranger.map_or("", String::as_str));
    Ok(())
}

/// All files below a folder, by their paths within `root`.
fn list(root: &Path, folder: &Path, found: &mut BTreeSet<String>) -> Result<()> {
    let unreadable = || format!("cannot list '{}'", folder.display());
    for entry in fs::read_dir(folder).with_context(unreadable)? {
        let path = entry.with_context(unreadable)?.path();
        if path.is_dir() {
            list(root, &path, found)?;
        } else {
            found.insert(slashed(path.strip_prefix(root).unwrap_or(&path)));
        }
    }
    Ok(())
}

fn slashed(path: &Path) -> String {
    let parts: Vec<_> = path.components().map(|c| c.as_os_str().to_string_lossy()).collect();
    parts.join("/")
}
