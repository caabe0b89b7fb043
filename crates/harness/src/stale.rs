//! Whether a program is older than its sources.

use std::fs;
use std::path::{Path, PathBuf};

/// A source file that was changed after the program was built from it, as far as cargo and the file system know.
pub fn newer_source(program: &Path) -> Option<PathBuf> {
    let written = |path: &Path| fs::metadata(path).and_then(|m| m.modified()).ok();
    let built = written(program)?;
    // Cargo lists the sources beside the program as a rule of make, in which a space of a name has a backslash.
    let rule = fs::read_to_string(program.with_extension("d")).ok()?;
    let (_, sources) = rule.lines().next()?.split_once(": ")?;
    let names = sources.replace("\\ ", "\0");
    let mut paths = names.split(' ').map(|name| PathBuf::from(name.replace('\0', " ")));
    paths.find(|path| written(path).is_some_and(|changed| changed > built))
}
