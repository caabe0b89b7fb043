//! Examples of the workspace that are measured: built in release, into the target folder that this program lies in.

use std::env::consts::EXE_SUFFIX;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Builds an example and tells where it is, or why it is not.
pub(crate) fn built(package: &str, name: &str) -> Result<PathBuf, String> {
    let this = std::env::current_exe().map_err(|e| format!("cannot tell where this program is: {e}"))?;
    let target = this
        .parent()
        .and_then(Path::parent)
        .ok_or("this program lies in no target folder of cargo; run it as `cargo xtask`")?;
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let told = Command::new(cargo)
        .args(["build", "--release", "--quiet", "-p", package, "--example", name, "--target-dir"])
        .arg(target)
        .stdin(Stdio::null())
        .output()
        .map_err(|e| format!("cannot start cargo: {e}"))?;
    let path = target.join("release").join("examples").join(format!("{name}{EXE_SUFFIX}"));
    if told.status.success() && path.is_file() {
        return Ok(path);
    }
    let text = String::from_utf8_lossy(&told.stderr);
    let error = text.lines().find(|line| line.starts_with("error")).unwrap_or("cargo did not say why");
    Err(format!("example '{name}' of {package} could not be built: {error}"))
}

/// The vector unit that `pulp` chose, in what the weak form's example prints.
pub(crate) fn vector_unit(printed: &str) -> Option<String> {
    printed.split_once("vector unit: ").map(|(_, unit)| unit.trim().to_owned())
}
