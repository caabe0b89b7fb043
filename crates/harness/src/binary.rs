//! The program that is examined: `lacuna` as it is shipped, beside this program.

use std::env::consts::EXE_SUFFIX;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, ensure};
use sha2::{Digest, Sha256};

use crate::stale::newer_source;

/// The program and what tells it from other builds.
#[derive(Debug, Clone)]
pub struct Binary {
    /// Where it lies.
    pub path: PathBuf,
    /// SHA-256 of the file, in hexadecimal.
    pub sha256: String,
}

/// Finds `lacuna`; builds it when it is not there.
///
/// # Errors
///
/// When it cannot be built or read.
pub fn find() -> Result<Binary> {
    let this = std::env::current_exe().context("cannot tell where this program is")?;
    let name = format!("lacuna{EXE_SUFFIX}");
    let beside = this.with_file_name(&name);
    let path = if beside.is_file() { beside } else { build(&this, &name)? };
    if let Some(source) = newer_source(&path) {
        eprintln!(
            "note: '{}' was changed after lacuna was built; to examine the present code, \
             run `cargo build --release -p lacuna --bin lacuna` and start again",
            source.display()
        );
    }
    let sha256 = sha256_of(&path)?;
    Ok(Binary { path, sha256 })
}

/// Builds `lacuna` into the target folder that this program lies in.
fn build(this: &Path, name: &str) -> Result<PathBuf> {
    let target =
        this.parent().and_then(Path::parent).context("this program lies in no target folder of cargo; run it there")?;
    eprintln!("there is no lacuna beside this program yet: building it");
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let status = Command::new(cargo)
        .args(["build", "--release", "-p", "lacuna", "--bin", "lacuna", "--target-dir"])
        .arg(target)
        .status()
        .context("cannot start cargo; build lacuna with `cargo build --release -p lacuna --bin lacuna`")?;
    ensure!(status.success(), "lacuna could not be built ({status}); see above");
    let built = target.join("release").join(name);
    ensure!(built.is_file(), "cargo built no '{}'", built.display());
    Ok(built)
}

/// SHA-256 of a file, in hexadecimal.
///
/// # Errors
///
/// When the file cannot be read.
pub fn sha256_of(path: &Path) -> Result<String> {
    let bytes = fs::read(path).with_context(|| format!("cannot read '{}'", path.display()))?;
    Ok(hex::encode(Sha256::digest(&bytes)))
}
