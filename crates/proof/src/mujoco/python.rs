//! A Python that has MuJoCo.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result};

/// What is installed.
const PACKAGES: [&str; 2] = ["mujoco==4.0.0", "numpy==2.4.6"];
/// Names a Python that has it already.
const VARIABLE: &str = "LACUNA_MUJOCO_PYTHON";

/// The Python to use: the one that is named, or that of a virtual environment, made if need be. `None`, with a reason on
/// standard error, where there is no Python or no network.
pub(super) fn ready(folder: &Path) -> Option<PathBuf> {
    if let Some(named) = std::env::var_os(VARIABLE) {
        return Some(PathBuf::from(named));
    }
    let environment = folder.join("venv");
    let python = environment.join("bin").join("python");
    if has_mujoco(&python) {
        return Some(python);
    }
    eprintln!("making a virtual environment with {} in {}", PACKAGES.join(" and "), environment.display());
    let made = succeeds(Command::new("python3").args(["-m", "venv"]).arg(&environment))
        && succeeds(Command::new(&python).args(["-m", "pip", "install", "--quiet"]).args(PACKAGES));
    if made && has_mujoco(&python) {
        return Some(python);
    }
    eprintln!(
        "SKIPPED: no Python with MuJoCo could be had; name one with {VARIABLE}, or run again with Python 3 and a network"
    );
    None
}

fn has_mujoco(python: &Path) -> bool {
    succeeds(Command::new(python).args(["-c", "import mujoco"]).stderr(Stdio::null()))
}

fn succeeds(command: &mut Command) -> bool {
    command.stdin(Stdio::null()).stdout(Stdio::null()).status().is_ok_and(|status| status.success())
}

/// Runs `run.py` on a job and returns what it writes.
pub(super) fn simulate(python: &Path, folder: &Path, job: &serde_json::Value) -> Result<Vec<Vec<[f64; 3]>>> {
    let (script, input, output) = (folder.join("run.py"), folder.join("job.json"), folder.join("result.json"));
    let write = |path: &Path, text: &str| {
        std::fs::write(path, text).with_context(|| format!("cannot write '{}'", path.display()))
    };
    write(&script, include_str!("run.py"))?;
    write(&input, &serde_json::to_string(job)?)?;
    let status = Command::new(python)
        .arg(&script)
        .args([&input, &output])
        .stdin(Stdio::null())
        .status()
        .with_context(|| format!("cannot start '{}'", python.display()))?;
    anyhow::ensure!(status.success(), "MuJoCo did not run the models ({status}); see above");
    let text = std::fs::read_to_string(&output).with_context(|| format!("cannot read '{}'", output.display()))?;
    serde_json::from_str(&text).with_context(|| format!("'{}' is no result", output.display()))
}
