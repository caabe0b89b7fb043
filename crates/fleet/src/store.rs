//! Where answers lie: `json/NAME.json` is what `lacuna diagnose --json` writes, `done/NAME.json` the row of it.

use std::collections::HashMap;
use std::fs::{self, File};
use std::io::{BufReader, BufWriter, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use case_files::envelope::Answered;
use serde::{Deserialize, Serialize};

use super::key::of_text;
use super::row::Row;

/// Folder of the answers.
const JSON: &str = "json";
/// Folder of the rows: a unit is finished when its row is there.
const DONE: &str = "done";
/// Letters of an id that are part of a file name.
const SHOWN: usize = 60;
/// Digits of the hash of an id, and of a key, in a file name.
const DIGITS: usize = 16;

/// A folder of answers.
#[derive(Debug, Clone)]
pub struct Store {
    root: PathBuf,
}

/// A row that is there, without what it says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Entry {
    /// Name of the unit.
    pub id: String,
    /// Name of its files.
    pub name: String,
}

/// The part of a row that orders it.
#[derive(Deserialize)]
struct Id {
    id: String,
}

impl Store {
    /// Opens a folder for answers, which is made if it is not there.
    ///
    /// # Errors
    /// When it cannot be made.
    pub fn create(root: &Path) -> Result<Self> {
        for folder in [JSON, DONE] {
            let folder = root.join(folder);
            fs::create_dir_all(&folder).with_context(|| format!("cannot create '{}'", folder.display()))?;
        }
        Ok(Self { root: root.to_owned() })
    }

    /// Opens a folder that `lacuna batch` has written.
    ///
    /// # Errors
    /// When it is none.
    pub fn open(root: &Path) -> Result<Self> {
        anyhow::ensure!(
            root.join(DONE).is_dir(),
            "'{}' has no folder '{DONE}/': it is not what `lacuna batch -o` writes",
            root.display()
        );
        Ok(Self { root: root.to_owned() })
    }

    /// The folder.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// The name of a unit's files: readable, and unlike that of any other unit or any other input.
    pub(crate) fn name(id: &str, key: &str) -> String {
        let plain = |c: char| if c.is_ascii_alphanumeric() || "._-".contains(c) { c } else { '_' };
        let shown: String = id.chars().map(plain).take(SHOWN).collect();
        // A file that begins with a dot is hidden.
        format!("{}.{}.{}", shown.trim_start_matches('.'), Self::hash_of(id), &key[..DIGITS.min(key.len())])
    }

    fn hash_of(id: &str) -> String {
        of_text(id)[..DIGITS].to_owned()
    }

    /// The whole answer, relative to the folder.
    pub(crate) fn json(name: &str) -> String {
        format!("{JSON}/{name}.json")
    }

    /// Where a row is.
    pub(crate) fn row_path(&self, name: &str) -> PathBuf {
        self.root.join(DONE).join(format!("{name}.json"))
    }

    /// Names of all rows.
    fn names(&self) -> Result<Vec<String>> {
        let folder = self.root.join(DONE);
        let shown = || format!("cannot list '{}'", folder.display());
        let mut out = Vec::new();
        for entry in fs::read_dir(&folder).with_context(shown)? {
            let name = entry.with_context(shown)?.file_name().to_string_lossy().into_owned();
            // What is being written is hidden.
            if let Some(name) = name.strip_suffix(".json").filter(|name| !name.starts_with('.')) {
                out.push(name.to_owned());
            }
        }
        Ok(out)
    }

    /// The names of the rows of each unit, by the hash of its id.
    pub(crate) fn index(&self) -> Result<Index> {
        let mut out: HashMap<String, Vec<String>> = HashMap::new();
        for name in self.names()? {
            if let Some(hash) = name.rsplit('.').nth(1) {
                out.entry(hash.to_owned()).or_default().push(name);
            }
        }
        Ok(Index(out))
    }

    /// All rows in the order of their ids.
    ///
    /// # Errors
    /// A row that cannot be read.
    pub fn entries(&self) -> Result<Vec<Entry>> {
        let mut out = Vec::new();
        for name in self.names()? {
            let Id { id } = self.read(&name)?;
            out.push(Entry { id, name });
        }
        out.sort_by(|a, b| (&a.id, &a.name).cmp(&(&b.id, &b.name)));
        Ok(out)
    }

    /// A row.
    ///
    /// # Errors
    /// When it cannot be read.
    pub fn row(&self, name: &str) -> Result<Row> {
        self.read(name)
    }

    fn read<T: for<'a> Deserialize<'a>>(&self, name: &str) -> Result<T> {
        let path = self.row_path(name);
        let file = File::open(&path).with_context(|| format!("cannot read '{}'", path.display()))?;
        let row = serde_json::from_reader(BufReader::new(file));
        row.with_context(|| format!("'{}' is no row of this version; remove it and run again", path.display()))
    }

    /// Whether a row's whole answer is there.
    pub(crate) fn has_answer(&self, row: &Row) -> bool {
        row.json.as_ref().is_some_and(|json| self.root.join(json).is_file())
    }

    /// Keeps an answer: first the whole of it, then its row.
    pub(crate) fn keep(&self, row: &mut Row, answered: Option<&Answered>) -> Result<()> {
        let name = Self::name(&row.id, &row.key);
        if let Some(answered) = answered {
            let json = Self::json(&name);
            write_json(&self.root.join(&json), answered)?;
            row.json = Some(json);
        }
        self.keep_row(row)
    }

    /// Keeps a row.
    pub(crate) fn keep_row(&self, row: &Row) -> Result<()> {
        write_json(&self.row_path(&Self::name(&row.id, &row.key)), row)
    }

    /// Takes the files of other inputs of this unit away.
    pub(crate) fn forget(&self, names: &[String], but: &str) -> Result<()> {
        for name in names.iter().filter(|name| *name != but) {
            // The row first: what it leaves behind is then no answer.
            for path in [self.row_path(name), self.root.join(Self::json(name))] {
                match fs::remove_file(&path) {
                    Err(e) if e.kind() != std::io::ErrorKind::NotFound => {
                        return Err(e).with_context(|| format!("cannot remove '{}'", path.display()));
                    }
                    _ => {}
                }
            }
        }
        Ok(())
    }
}

/// Which rows are there.
pub(crate) struct Index(HashMap<String, Vec<String>>);

impl Index {
    /// Names of the rows of a unit, of any input.
    pub(crate) fn of(&self, id: &str) -> &[String] {
        self.0.get(&Store::hash_of(id)).map_or(&[], Vec::as_slice)
    }
}

/// Writes a file that is there with all of its bytes, or not at all.
pub(crate) fn whole(path: &Path, write: impl FnOnce(&mut BufWriter<File>) -> Result<()>) -> Result<()> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let part = path.with_file_name(format!(".{name}.part"));
    let shown = || format!("cannot write '{}'", path.display());
    let mut file = BufWriter::new(File::create(&part).with_context(shown)?);
    write(&mut file).with_context(shown)?;
    file.flush().with_context(shown)?;
    drop(file);
    fs::rename(&part, path).with_context(shown)
}

fn write_json(path: &Path, value: &impl Serialize) -> Result<()> {
    whole(path, |file| {
        serde_json::to_writer_pretty(&mut *file, value)?;
        Ok(file.write_all(b"\n")?)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_readable_and_tell_ids_and_keys_apart() {
        let key = "0123456789abcdef0123";
        let name = Store::name("unit-17/März 3/run_1", key);
        assert!(name.starts_with("unit-17_M_rz_3_run_1.") && name.ends_with(".0123456789abcdef"), "{name}");
        assert_ne!(name, Store::name("unit-17/März_3/run_1", key));
        assert!(!Store::name("../.hidden", key).starts_with('.'));
        assert!(Store::name(&"x".repeat(900), key).len() < 120);
    }

    #[test]
    fn a_file_that_could_not_be_written_whole_is_not_there() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.json");
        let failed = whole(&path, |file| {
            file.write_all(b"half")?;
            anyhow::bail!("interrupted")
        });
        assert!(format!("{:#}", failed.expect_err("it failed")).contains("a.json': interrupted"));
        assert!(!path.exists());
        whole(&path, |file| Ok(file.write_all(b"whole")?)).expect("writes");
        assert_eq!(fs::read(&path).expect("reads"), b"whole");
    }
}
