//! On what the figures were measured.

use std::path::Path;
use std::process::{Command, Stdio};
use std::thread::available_parallelism;

use serde::{Deserialize, Serialize};

use crate::examples;

/// The machine, and what compiled and interpreted the programs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Machine {
    pub(super) processor: String,
    pub(super) cores: usize,
    /// Processes that wanted to run in the last minute, before and after the measurement, where the system tells.
    pub(super) load: Vec<f64>,
    /// The vector unit that `pulp` chose.
    pub(super) vector_unit: String,
    pub(super) rust: String,
    pub(super) c: String,
    pub(super) python: String,
}

const UNKNOWN: &str = "unknown";

impl Machine {
    /// What this machine tells, and the vector unit that `pulp` chose.
    pub(super) fn read(python: Option<&Path>, vector_unit: Option<String>) -> Self {
        let or_unknown = |text: Option<String>| text.unwrap_or_else(|| UNKNOWN.into());
        Self {
            processor: or_unknown(std::fs::read_to_string("/proc/cpuinfo").ok().as_deref().and_then(processor)),
            cores: available_parallelism().map_or(0, usize::from),
            load: load().into_iter().collect(),
            vector_unit: or_unknown(vector_unit),
            rust: rust_version().unwrap_or_else(|| UNKNOWN.into()),
            c: or_unknown(first_line("gcc", "--version")),
            python: python.map_or_else(|| "none".into(), |p| or_unknown(super::python::versions(p))),
        }
    }

    /// Notes the load once more.
    pub(super) fn note_load(&mut self) {
        self.load.extend(load());
    }

    /// The machine in sentences.
    pub(super) fn words(&self) -> String {
        let load: Vec<String> = self.load.iter().map(|x| format!("{x:.1}")).collect();
        let load = if load.is_empty() { UNKNOWN.to_owned() } else { load.join(" before, ") + " after" };
        format!(
            "{}, {} cores, load {load}. pulp chose {}. {}. C: {}. {}.",
            self.processor, self.cores, self.vector_unit, self.rust, self.c, self.python
        )
    }
}

/// The vector unit that `pulp` chooses on this machine, as the weak form's example tells it.
pub(super) fn vector_unit() -> Option<String> {
    let example = examples::built("weak-form", "kernel").ok()?;
    let told = Command::new(example).args(["--rows", "100", "--rounds", "1"]).stdin(Stdio::null()).output().ok()?;
    examples::vector_unit(&String::from_utf8(told.stdout).ok()?)
}

/// The processor's name in `/proc/cpuinfo`.
fn processor(text: &str) -> Option<String> {
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}

fn load() -> Option<f64> {
    std::fs::read_to_string("/proc/loadavg").ok()?.split_whitespace().next()?.parse().ok()
}

/// The compiler of this workspace, `rustc 1.95.0 (...)`.
pub(crate) fn rust_version() -> Option<String> {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    first_line(rustc, "--version")
}

fn first_line(program: impl AsRef<std::ffi::OsStr>, argument: &str) -> Option<String> {
    let told = Command::new(program).arg(argument).stdin(Stdio::null()).stderr(Stdio::null()).output().ok()?;
    let text = String::from_utf8(told.stdout).ok()?;
    text.lines().next().map(str::to_owned).filter(|line| told.status.success() && !line.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_processor_is_found() {
        let text = "processor\t: 0\nmodel name\t: Some Processor 9000\nstepping\t: 1\n";
        assert_eq!(processor(text).as_deref(), Some("Some Processor 9000"));
        assert_eq!(processor("processor\t: 0\n"), None);
    }
}
