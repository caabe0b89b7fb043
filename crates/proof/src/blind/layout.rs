//! Where things are below the folder of a set.

use std::path::{Path, PathBuf};

/// The folder of a set.
#[derive(Debug, Clone)]
pub(crate) struct Layout {
    root: PathBuf,
}

impl Layout {
    pub(crate) fn new(root: PathBuf) -> Self {
        Self { root }
    }

    pub(crate) fn root(&self) -> &Path {
        &self.root
    }

    /// All that a diagnoser gets to see.
    pub(crate) fn cases(&self) -> PathBuf {
        self.root.join("cases")
    }

    /// The folder of a case.
    pub(crate) fn case(&self, name: &str) -> PathBuf {
        self.cases().join(name)
    }

    /// What was hidden in a case.
    pub(super) fn truth(&self, name: &str) -> PathBuf {
        self.root.join("truth").join(name)
    }

    pub(super) fn seals(&self) -> PathBuf {
        self.root.join("seals.json")
    }

    /// Answers in the form that scorers read.
    pub(super) fn answers(&self) -> PathBuf {
        self.root.join("answers")
    }

    pub(super) fn answer(&self, name: &str) -> PathBuf {
        self.answers().join(format!("{name}.json"))
    }

    /// Predicted responses of a case's held-out drives.
    pub(super) fn predictions(&self, name: &str) -> PathBuf {
        self.answers().join(name)
    }

    /// What the diagnosing process left behind.
    pub(super) fn run(&self, name: &str) -> PathBuf {
        self.root.join("runs").join(name)
    }

    /// The whole diagnosis of a case.
    pub(super) fn diagnosis(&self, name: &str) -> PathBuf {
        self.run(name).join("diagnosis.json")
    }
}
