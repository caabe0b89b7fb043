//! The Python that has the packages of the peers.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, ensure};

use super::job::{Answer, Job};

/// Names the Python.
const VARIABLE: &str = "LACUNA_PEERS_PYTHON";
/// How its packages are had.
const INSTALL: &str = "pip install pysindy gplearn scikit-learn numpy";

/// A Python that has the packages.
#[derive(Debug)]
pub(in super::super) struct Python(PathBuf);

impl Python {
    /// The one that is named by the environment.
    ///
    /// # Errors
    /// Where none is named, or it lacks a package: with what to install.
    pub(in super::super) fn named() -> Result<Self> {
        Self::checked(std::env::var_os(VARIABLE))
    }

    fn checked(named: Option<OsString>) -> Result<Self> {
        let named = named.with_context(|| {
            format!("--peers needs a Python with the peers; make one with `{INSTALL}` and name it with {VARIABLE}")
        })?;
        let has_all = Command::new(&named)
            .args(["-c", "import gplearn, numpy, pysindy, sklearn"])
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .status()
            .is_ok_and(|status| status.success());
        let shown = Path::new(&named).display();
        ensure!(has_all, "'{shown}', named by {VARIABLE}, is no Python with the peers: `{INSTALL}`");
        Ok(Self(PathBuf::from(named)))
    }

    /// Runs `fit.py` on a job, with its files in a folder.
    pub(super) fn fit(&self, folder: &Path, job: &Job<'_>) -> Result<Answer> {
        let [script, input, output] = ["fit.py", "job.json", "result.json"].map(|name| folder.join(name));
        let write = |path: &Path, text: &str| {
            std::fs::write(path, text).with_context(|| format!("cannot write '{}'", path.display()))
        };
        write(&script, include_str!("fit.py"))?;
        write(&input, &serde_json::to_string(job)?)?;
        let ended = Command::new(&self.0)
            .arg(&script)
            .args([&input, &output])
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .output()
            .with_context(|| format!("cannot start '{}'", self.0.display()))?;
        let said = String::from_utf8_lossy(&ended.stderr);
        ensure!(ended.status.success(), "the peers did not run ({}): {said}", ended.status);
        let text = std::fs::read_to_string(&output).with_context(|| format!("cannot read '{}'", output.display()))?;
        serde_json::from_str(&text).with_context(|| format!("'{}' is no result", output.display()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_a_python_that_has_them_it_says_what_to_install() {
        for named in [None, Some(OsString::from("no-such-python"))] {
            let said = Python::checked(named).expect_err("there is none").to_string();
            assert!(said.contains(INSTALL) && said.contains(VARIABLE), "{said}");
        }
    }
}
