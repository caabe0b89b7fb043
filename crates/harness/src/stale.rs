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

#[cfg(test)]
mod tests {
    use std::fs::File;
    use std::time::{Duration, SystemTime};

    use super::newer_source;

    #[test]
    fn a_source_that_is_newer_than_the_program_is_found() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str, age: u64| {
            let path = folder.path().join(name);
            let file = File::create(&path).expect("a file");
            file.set_modified(SystemTime::now() - Duration::from_secs(age)).expect("its time");
            path
        };
        let program = at("lacuna", 50);
        let (old, new) = (at("old.rs", 100), at("a new.rs", 10));
        let rule = |sources: &[&std::path::PathBuf]| {
            let names: Vec<String> = sources.iter().map(|s| s.display().to_string().replace(' ', "\\ ")).collect();
            std::fs::write(program.with_extension("d"), format!("lacuna: {}\n", names.join(" "))).expect("writes");
        };
        assert_eq!(newer_source(&program), None, "nobody knows");
        rule(&[&old]);
        assert_eq!(newer_source(&program), None);
        rule(&[&old, &new]);
        assert_eq!(newer_source(&program), Some(new));
    }
}
