//! Where commands put what they measured.

use std::path::{Path, PathBuf};

use anyhow::Context;
use serde::Serialize;

/// One measured figure. `summary.json` of every command is a flat list of these, so that versions can be compared.
#[derive(Debug, Serialize)]
pub(crate) struct Figure {
    /// What was measured.
    pub(crate) name: String,
    /// The value.
    pub(crate) value: f64,
    /// Its unit, empty if it has none.
    pub(crate) unit: String,
    /// What is asked, if anything is.
    pub(crate) target: Option<String>,
    /// Whether it is met, if anything is asked.
    pub(crate) pass: Option<bool>,
}

/// The folder `target/COMMAND` of the workspace, created if needed.
pub(crate) fn folder(command: &str) -> anyhow::Result<PathBuf> {
    // Cargo sets this for `cargo run`; started by hand, the program writes below the current folder.
    let root = std::env::var_os("CARGO_MANIFEST_DIR")
        .and_then(|dir| Path::new(&dir).parent().map(Path::to_path_buf))
        .unwrap_or_default();
    let folder = root.join("target").join(command);
    std::fs::create_dir_all(&folder).with_context(|| format!("cannot create {}", folder.display()))?;
    Ok(folder)
}

/// Writes text to a file of a folder.
pub(crate) fn write(folder: &Path, name: &str, text: &str) -> anyhow::Result<()> {
    let path = folder.join(name);
    std::fs::write(&path, text).with_context(|| format!("cannot write {}", path.display()))
}
