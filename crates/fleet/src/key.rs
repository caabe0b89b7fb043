//! What an answer depends on, as a hash.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use anyhow::Result;
use case_files::envelope::Program;
use case_files::inputs::{self, complete};
use recordings::Mapping;
use sha2::{Digest, Sha256};

use super::unit::{Setup, Unit};
use super::{FORMAT, Settings};

/// How deep folders of recordings are looked into: a folder of folders of bags.
const DEPTH: usize = 3;

/// A hash in the making: parts cannot run into each other.
struct Parts(Sha256);

impl Parts {
    fn new() -> Self {
        Self(Sha256::new())
    }

    fn add(&mut self, part: &str) {
        self.0.update((part.len() as u64).to_le_bytes());
        self.0.update(part.as_bytes());
    }

    fn finish(self) -> String {
        hex::encode(self.0.finalize())
    }
}

/// SHA-256 of a text.
pub(crate) fn of_text(text: &str) -> String {
    hex::encode(Sha256::digest(text.as_bytes()))
}

/// SHA-256 of a file, which need not fit into memory.
fn of_file(path: &Path) -> io::Result<String> {
    /// As an `io::Write`, which `io::copy` takes.
    struct Hasher(Sha256);
    impl io::Write for Hasher {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            self.0.update(bytes);
            Ok(bytes.len())
        }
        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }
    let mut hasher = Hasher(Sha256::new());
    io::copy(&mut File::open(path)?, &mut hasher)?;
    Ok(hex::encode(hasher.0.finalize()))
}

/// Adds files by their names and bytes. Where they lie does not matter; that one is not there does.
fn add_files(parts: &mut Parts, files: &[PathBuf]) {
    for file in files {
        parts.add(&file.file_name().unwrap_or_default().to_string_lossy());
        parts.add(&of_file(file).unwrap_or_else(|error| error.kind().to_string()));
    }
}

/// All files at a path.
fn files_at(path: &Path, depth: usize, out: &mut Vec<PathBuf>) {
    match (path.is_dir(), inputs::list(path)) {
        (true, Ok(inside)) if depth > 0 => inside.iter().for_each(|path| files_at(path, depth - 1, out)),
        (true, _) => {}
        (false, _) => out.push(path.to_path_buf()),
    }
}

fn all_files(paths: &[PathBuf]) -> Vec<PathBuf> {
    let mut out = Vec::new();
    for path in paths {
        files_at(path, DEPTH, &mut out);
    }
    out
}

/// The hash of what units of a robot share: robot, references, mapping, options, version of the program.
pub(crate) fn of_setup(setup: &Setup, settings: &Settings) -> String {
    let mut parts = Parts::new();
    parts.add(&format!("{} {FORMAT} {:?}", Program::default().version, settings.budget));
    parts.add(&format!("{:?} {}", settings.options, settings.reading_name));
    for name in [Some(&setup.robot), setup.mapping.as_ref()] {
        // Of what is built in, the version of the program says the rest.
        let text = name.and_then(|name| fs::read_to_string(name).ok()).or_else(|| name.cloned());
        parts.add(text.as_deref().unwrap_or("-"));
    }
    add_files(&mut parts, &all_files(&setup.reference));
    parts.finish()
}

/// The hash of a unit: its id, its files, and what it shares with others.
pub(crate) fn of_unit(unit: &Unit, of_setup: &str) -> Result<String> {
    let mut parts = Parts::new();
    parts.add(of_setup);
    parts.add(&unit.id);
    let mut files = all_files(&unit.recording);
    if let Some(name) = &unit.setup.mapping {
        // Naming one of a pair is enough to have both read.
        files = with_companions(&inputs::mapping(name)?, &files);
    }
    add_files(&mut parts, &files);
    Ok(parts.finish())
}

/// Files with those that a mapping reads beside them.
fn with_companions(mapping: &Mapping, files: &[PathBuf]) -> Vec<PathBuf> {
    let names: Vec<String> = files.iter().map(|f| f.display().to_string()).collect();
    let mut grouping = mapping.group(&names);
    let mut out: Vec<String> = grouping.unmatched;
    for group in &mut grouping.groups {
        complete(group, mapping);
        out.extend(group.files.iter().map(|f| f.name.clone()));
    }
    out.into_iter().map(PathBuf::from).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use case_files::long::Budget;

    fn settings() -> Settings {
        Settings {
            options: inference::Options::default(),
            reading: recordings::ReadOptions::default(),
            reading_name: "normal".to_owned(),
            budget: Budget::default(),
            threads: 1,
            limit: None,
        }
    }

    #[test]
    fn a_key_changes_with_everything_that_the_answer_depends_on_and_not_with_the_place() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        for (name, text) in [("a/run_1.csv", "1"), ("b/run_1.csv", "1"), ("ref/r.csv", "2"), ("robot.toml", "3")] {
            let path = at(name);
            fs::create_dir_all(path.parent().expect("a folder")).expect("creates");
            fs::write(path, text).expect("writes");
        }
        let unit = |recording: &str| Unit {
            id: "x".to_owned(),
            recording: vec![at(recording)],
            robot_id: None,
            date: None,
            setup: Setup { robot: at("robot.toml").display().to_string(), reference: vec![at("ref")], mapping: None },
        };
        let key = |unit: &Unit, settings: &Settings| of_unit(unit, &of_setup(&unit.setup, settings)).expect("a key");
        let first = key(&unit("a/run_1.csv"), &settings());
        assert_eq!(first, key(&unit("b/run_1.csv"), &settings()));
        assert_ne!(first, key(&Unit { id: "y".to_owned(), ..unit("a/run_1.csv") }, &settings()));
        assert_ne!(first, key(&unit("a/run_1.csv"), &Settings { reading_name: "strict".to_owned(), ..settings() }));
        assert_ne!(first, key(&unit("a/none.csv"), &settings()));
        for name in ["a/run_1.csv", "ref/r.csv", "robot.toml"] {
            fs::write(at(name), "changed").expect("writes");
            assert_ne!(first, key(&unit("a/run_1.csv"), &settings()), "{name}");
            let before = if name == "a/run_1.csv" {
                "1"
            } else if name == "ref/r.csv" {
                "2"
            } else {
                "3"
            };
            fs::write(at(name), before).expect("writes");
        }
        fs::write(at("ref/another.csv"), "4").expect("writes");
        assert_ne!(first, key(&unit("a/run_1.csv"), &settings()));
    }
}
