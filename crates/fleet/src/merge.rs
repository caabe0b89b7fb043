//! The table of one or several folders of answers.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result, bail, ensure};

use super::overview::Overview;
use super::parquet_rows;
use super::row::{Outcome, Row};
use super::store::{Entry, Store};

/// Name of the table.
const TABLE: &str = "rows.parquet";

/// What was joined.
#[derive(Debug, Clone, Default)]
pub struct Merged {
    /// Counts over all rows.
    pub overview: Overview,
    /// Units that were given more than once, with the same answer.
    pub twice: usize,
}

impl Store {
    /// Writes the table of all rows that are here, in the order of their ids; `each` is given every row.
    ///
    /// # Errors
    /// A row that cannot be read, and those of the disk.
    pub fn write_table(&self, each: &mut dyn FnMut(&Row)) -> Result<()> {
        let mut rows = self.entries()?.into_iter().map(|entry| {
            let row = self.row(&entry.name)?;
            each(&row);
            Ok(row)
        });
        parquet_rows::write(&self.root().join(TABLE), &mut rows)
    }

    /// Where the table is.
    pub fn table(&self) -> std::path::PathBuf {
        self.root().join(TABLE)
    }
}

/// Joins folders of answers into another, which is then as if `lacuna batch` had written it in one run: rows, whole answers,
/// table. A unit that is in several counts once; one that failed in one of them gives way to its answer.
///
/// # Errors
/// A folder that is none, or a unit with two answers.
pub fn merge(parts: &[Store], all: &Store, each: &mut dyn FnMut(&Row)) -> Result<Merged> {
    let mut entries: Vec<(Entry, usize)> = Vec::new();
    for (part, store) in parts.iter().enumerate() {
        entries.extend(store.entries()?.into_iter().map(|entry| (entry, part)));
    }
    ensure!(!entries.is_empty(), "there is no finished recording in {}", shown(parts));
    entries.sort_by(|a, b| (&a.0.id, a.1, &a.0.name).cmp(&(&b.0.id, b.1, &b.0.name)));
    let known: std::collections::HashSet<String> = entries.iter().map(|(entry, _)| entry.name.clone()).collect();
    if let Some(foreign) = all.entries()?.iter().find(|entry| !known.contains(&entry.name)) {
        bail!(
            "'{}' holds an answer for '{}' that is in none of the folders; name an empty folder with -o",
            all.root().display(),
            foreign.id
        );
    }
    let mut out = Merged::default();
    for same in entries.chunk_by(|a, b| a.0.id == b.0.id) {
        let rows = same.iter().map(|(entry, part)| parts[*part].row(&entry.name)).collect::<Result<Vec<_>>>()?;
        // What failed somewhere is no answer: it gives way to one.
        let is_answer = |row: &Row| row.outcome == Outcome::Done;
        let chosen = rows.iter().position(is_answer).unwrap_or(0);
        let path = |i: usize| parts[same[i].1].row_path(&same[i].0.name).display().to_string();
        let differs = |row: &Row| row.key != rows[chosen].key || !row.agrees_with(&rows[chosen]);
        if let Some(other) = rows.iter().position(|row| is_answer(row) && differs(row)) {
            bail!(
                "'{}' has two answers: '{}' and '{}'; its files, robot, options or program were not the same: run one of \
                 them again, or leave it out",
                rows[chosen].id,
                path(chosen),
                path(other)
            );
        }
        out.twice += rows.len() - 1;
        take(&parts[same[chosen].1], all, &rows[chosen])?;
    }
    all.write_table(&mut |row| {
        out.overview.add(row);
        each(row);
    })?;
    Ok(out)
}

fn shown(parts: &[Store]) -> String {
    parts.iter().map(|p| format!("'{}'", p.root().display())).collect::<Vec<_>>().join(", ")
}

/// Takes an answer over: the whole of it first.
fn take(from: &Store, all: &Store, row: &Row) -> Result<()> {
    if let Some(json) = &row.json {
        let (source, target) = (from.root().join(json), all.root().join(json));
        if !same_file(&source, &target) {
            let shown = || format!("cannot copy '{}' to '{}'", source.display(), target.display());
            // Written anew and not over: a link would change the other.
            let _ = fs::remove_file(&target);
            if fs::hard_link(&source, &target).is_err() {
                fs::copy(&source, &target).map(drop).with_context(shown)?;
            }
        }
    }
    all.keep_row(row)
}

fn same_file(a: &Path, b: &Path) -> bool {
    fs::canonicalize(a).is_ok_and(|a| fs::canonicalize(b).is_ok_and(|b| a == b))
}
