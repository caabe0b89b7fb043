//! `cargo xtask browser`: the tests that open the pages in Chromium, whose driver nothing else builds, with pictures of the pages.

use std::process::Command;

use anyhow::{Context, Result};

/// Runs the tests; true if none failed. Without a browser each is shown as ignored.
pub(crate) fn run() -> Result<bool> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    // As part of the workspace: with the features of all its packages, what its other tests built is used again.
    let status = Command::new(cargo)
        .args(["test", "--workspace", "--locked", "--features", "lacuna-workspace/browser", "--test", "browser"])
        .env("PICTURES", "1")
        .status()
        .context("cannot start cargo, which builds the tests")?;
    Ok(status.success())
}
