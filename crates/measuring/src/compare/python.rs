//! A Python that has the packages of the peers.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// What a virtual environment gets.
const PACKAGES: [&str; 5] = ["numpy", "scipy", "numba", "pysindy", "mujoco[sysid]"];
/// What is asked of a Python that was named: the names under which they are imported.
const MODULES: [&str; 5] = ["numpy", "scipy", "numba", "pysindy", "mujoco"];

/// The Python to use, or why there is none: the one that was named, or that of a virtual environment, made if need be.
pub(super) fn ready(named: Option<&Path>, folder: &Path) -> Result<PathBuf, String> {
    let found = match named {
        Some(python) => asked(python),
        None => made(&folder.join("venv")),
    };
    if let Err(why) = &found {
        eprintln!("SKIPPED: all peers in Python: {why}");
    }
    found
}

/// A Python that was named. One that lacks some packages is of use: the rows that need them fail by themselves.
fn asked(python: &Path) -> Result<PathBuf, String> {
    let lacking: Vec<&str> = MODULES.into_iter().filter(|module| !imports(python, module)).collect();
    if lacking.len() == MODULES.len() {
        return Err(format!(
            "'{}' cannot import {}; install them, or leave --python out",
            python.display(),
            lacking.join(", ")
        ));
    }
    if !lacking.is_empty() {
        eprintln!("note: '{}' cannot import {}: rows that need them fail", python.display(), lacking.join(", "));
    }
    // Scripts run in their own folder. A bare name is looked for on the search path.
    if python.components().count() > 1 {
        std::path::absolute(python).map_err(|e| e.to_string())
    } else {
        Ok(python.into())
    }
}

fn made(environment: &Path) -> Result<PathBuf, String> {
    let python = environment.join("bin").join("python");
    let complete = || MODULES.iter().all(|module| imports(&python, module));
    if complete() {
        return Ok(python);
    }
    eprintln!("making a virtual environment with {} in {}", PACKAGES.join(", "), environment.display());
    let made = succeeds(Command::new("python3").args(["-m", "venv"]).arg(environment))
        && succeeds(Command::new(&python).args(["-m", "pip", "install", "--quiet"]).args(PACKAGES));
    if made && complete() {
        return Ok(python);
    }
    Err("no virtual environment could be made; name a Python that has the packages with --python, or run again with \
         Python 3 and a network"
        .into())
}

fn imports(python: &Path, module: &str) -> bool {
    succeeds(Command::new(python).arg("-c").arg(format!("import {module}")).stderr(Stdio::null()))
}

fn succeeds(command: &mut Command) -> bool {
    command.stdin(Stdio::null()).stdout(Stdio::null()).status().is_ok_and(|status| status.success())
}

/// Versions of Python and its packages, for the page.
pub(super) fn versions(python: &Path) -> Option<String> {
    let script = format!(
        "import sys, importlib.metadata as m\n\
         print('Python ' + sys.version.split()[0] + ''.join(', ' + p + ' ' + m.version(p) for p in {MODULES:?}))"
    );
    let told = Command::new(python).args(["-c", &script]).stdin(Stdio::null()).stderr(Stdio::null()).output().ok()?;
    let text = String::from_utf8(told.stdout).ok()?.trim().to_owned();
    (told.status.success() && !text.is_empty()).then_some(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_python_that_is_none_is_reported() {
        let folder = tempfile::tempdir().expect("a folder");
        let why = ready(Some(&folder.path().join("snake")), folder.path()).expect_err("no Python");
        assert!(why.contains("snake") && why.contains("numba"), "{why}");
    }
}
