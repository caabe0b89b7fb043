//! The programs that ours are compared with: sources beside the workspace, compiled here.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::output;

/// Where they are expected, from the workspace.
const BESIDE: &str = "../shared/anchors";

/// The anchors, as far as they are there.
#[derive(Debug)]
pub(super) struct Anchors {
    /// Sources and scripts; or why there are none.
    pub(super) sources: Result<PathBuf, String>,
    /// Compiled programs; or why there are none.
    pub(super) compiled: Result<PathBuf, String>,
}

/// Finds the sources in a folder or beside the workspace, and compiles them into another.
pub(super) fn ready(named: Option<&Path>, out: &Path) -> Anchors {
    let folder = named.map_or_else(|| output::beside(BESIDE), Path::to_path_buf);
    let Ok(sources) = folder.canonicalize().and_then(|f| f.join("Makefile").metadata().map(|_| f)) else {
        let why = format!("there is no Makefile in '{}'; name the anchors' folder with --anchors", folder.display());
        eprintln!("SKIPPED: all that is not ours: {why}");
        return Anchors { sources: Err(why.clone()), compiled: Err(why) };
    };
    let compiled = compile(&sources, out);
    if let Err(why) = &compiled {
        eprintln!("SKIPPED: all compiled anchors: {why}");
    }
    Anchors { sources: Ok(sources), compiled }
}

fn compile(sources: &Path, out: &Path) -> Result<PathBuf, String> {
    let out = std::path::absolute(out).map_err(|e| e.to_string())?;
    let mut assignment = std::ffi::OsString::from("OUT=");
    assignment.push(&out);
    let made = Command::new("make")
        .arg("-C")
        .arg(sources)
        .args(["--silent", "--keep-going"])
        .arg(assignment)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .output()
        .map_err(|e| format!("make cannot be started ({e}); install make and a C and a C++ compiler"))?;
    if made.status.success() {
        return Ok(out);
    }
    let told = String::from_utf8_lossy(&made.stderr);
    let errors: Vec<&str> = told.lines().filter(|line| line.contains("rror")).take(5).collect();
    // With --keep-going those that do compile are there: they are tried one by one.
    eprintln!("note: not every anchor could be compiled:\n  {}", errors.join("\n  "));
    if out.is_dir() { Ok(out) } else { Err(format!("make ended with {}", made.status)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn missing_anchors_are_reported_with_their_folder_and_a_remedy() {
        let folder = tempfile::tempdir().expect("a folder");
        let missing = folder.path().join("nowhere");
        let anchors = ready(Some(&missing), folder.path());
        let why = anchors.compiled.expect_err("nothing to compile");
        assert!(why.contains("nowhere") && why.contains("--anchors"), "{why}");
        assert_eq!(anchors.sources.expect_err("no sources"), why);
    }

    #[test]
    fn anchors_are_compiled_where_they_were_asked_for() {
        let folder = tempfile::tempdir().expect("a folder");
        let (sources, out) = (folder.path().join("sources"), folder.path().join("out"));
        std::fs::create_dir_all(&sources).expect("a folder");
        std::fs::write(sources.join("Makefile"), "all:\n\tmkdir -p $(OUT)\n\techo 1 > $(OUT)/peak\n").expect("writes");
        if Command::new("make").arg("--version").stdout(Stdio::null()).status().is_err() {
            eprintln!("SKIPPED: there is no make");
            return;
        }
        let compiled = ready(Some(&sources), &out).compiled.expect("compiles");
        assert!(compiled.join("peak").is_file());
        // Nothing is written beside the sources.
        assert_eq!(std::fs::read_dir(&sources).expect("a folder").count(), 1);
    }
}
