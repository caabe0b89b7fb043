//! One run of cargo in a fresh target folder.

use std::env::consts::EXE_SUFFIX;
use std::fs;
use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::Instant;

use anyhow::{Context, Result, ensure};
use harness::child::processor_of_children;

use crate::output;

/// Jobs of cargo, threads of tests: the goals are stated for two cores.
const CORES: &str = "2";

/// What one run of cargo took.
#[derive(Debug)]
pub(super) struct Step {
    /// The command as a reader would type it.
    pub(super) command: String,
    /// Crates that were compiled.
    pub(super) crates: usize,
    /// From start to end, s.
    pub(super) seconds: f64,
    /// Time on processors, s, where the system tells.
    pub(super) processor: Option<f64>,
}

/// A target folder that is empty at first and removed at last.
#[derive(Debug)]
pub(super) struct Fresh(PathBuf);

impl Fresh {
    pub(super) fn new(name: &str) -> Result<Self> {
        let folder = output::folder("cold")?.join(name);
        if folder.exists() {
            fs::remove_dir_all(&folder).with_context(|| format!("cannot remove '{}'", folder.display()))?;
        }
        Ok(Self(folder))
    }

    /// Runs cargo, whose output is shown as it comes. It must not fail.
    pub(super) fn cargo(&self, args: &[&str]) -> Result<Step> {
        let command = format!("cargo {}", args.join(" "));
        eprintln!("{command}");
        let (before, start) = (processor_of_children(), Instant::now());
        let mut child = cargo()
            .args(args)
            .env("CARGO_TARGET_DIR", &self.0)
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .context("cannot start cargo")?;

        let mut crates = 0;
        for line in BufReader::new(child.stderr.take().context("no standard error")?).lines() {
            let line = line.context("cannot read what cargo says")?;
            crates += usize::from(line.trim_start().starts_with("Compiling "));
            eprintln!("{line}");
        }
        let status = child.wait().context("cannot ask how cargo ended")?;
        ensure!(status.success(), "`{command}` ended with {status}; see above");

        let processor = processor_of_children().zip(before).map(|(after, before)| after - before);
        Ok(Step { command, crates, seconds: start.elapsed().as_secs_f64(), processor })
    }

    /// Bytes of a program that was built.
    pub(super) fn size_of(&self, profile: &str, program: &str) -> Result<u64> {
        let path = self.0.join(profile).join(format!("{program}{EXE_SUFFIX}"));
        Ok(fs::metadata(&path).with_context(|| format!("cargo built no '{}'", path.display()))?.len())
    }
}

impl Drop for Fresh {
    fn drop(&mut self) {
        // What remains is removed before the next measurement.
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Fetches what is not there yet: how fast a network is says nothing about this workspace.
pub(super) fn fetch() -> Result<()> {
    let status = cargo().args(["fetch", "--locked"]).status().context("cannot start cargo")?;
    ensure!(status.success(), "the crates could not be fetched ({status}); see above");
    Ok(())
}

/// Cargo, in the workspace, for two cores.
fn cargo() -> Command {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.current_dir(output::beside(".")).stdin(Stdio::null());
    for variable in ["CARGO_BUILD_JOBS", "RUST_TEST_THREADS", "RAYON_NUM_THREADS"] {
        command.env(variable, CORES);
    }
    command
}
