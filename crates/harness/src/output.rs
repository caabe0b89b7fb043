//! Where commands put what they measured.

use std::path::{Path, PathBuf};

use anyhow::Context;
use indicatif::{ProgressBar, ProgressStyle};
use serde::Serialize;

/// One measured figure. `summary.json` of every command is a flat list of these, so that versions can be compared.
#[derive(Debug, Serialize)]
pub struct Figure {
    /// What was measured.
    pub name: String,
    /// The value.
    pub value: f64,
    /// Its unit, empty if it has none.
    pub unit: String,
    /// What is asked, if anything is.
    pub target: Option<String>,
    /// Whether it is met, if anything is asked.
    pub pass: Option<bool>,
}

/// What is asked of a figure.
#[derive(Debug, Clone, Copy)]
pub enum Asked {
    /// This or more.
    AtLeast(f64),
    /// This or less.
    AtMost(f64),
}

impl Figure {
    /// A figure of which nothing is asked.
    pub fn free(name: impl Into<String>, value: f64, unit: &str) -> Self {
        Self { name: name.into(), value, unit: unit.into(), target: None, pass: None }
    }

    /// The same figure with what is asked of it.
    #[must_use]
    pub fn asked(self, asked: Asked) -> Self {
        let (target, pass) = match asked {
            Asked::AtLeast(least) => (format!(">= {least}"), self.value >= least),
            Asked::AtMost(most) => (format!("<= {most}"), self.value <= most),
        };
        Self { target: Some(target), pass: Some(pass), ..self }
    }
}

/// A bar on a terminal; indicatif hides it anywhere else.
///
/// # Errors
///
/// None but a template that indicatif does not read.
pub fn progress(count: u64, what: &str) -> anyhow::Result<ProgressBar> {
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} {msg}, {eta} left")?;
    Ok(ProgressBar::new(count).with_style(style).with_message(what.to_owned()))
}

/// A section for a page that has a title of its own: without the title, headings one deeper.
///
/// # Errors
///
/// When the text is no page: there is nothing below its title.
pub fn below_title(page: &str) -> anyhow::Result<String> {
    let (_, below) = page.split_once("\n\n").context("a page without a title")?;
    Ok(below.trim().replace("\n## ", "\n### ") + "\n")
}

/// The workspace's folder.
fn root() -> PathBuf {
    // Cargo sets this for `cargo run`; started by hand, the program writes below the current folder.
    let package = std::env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from);
    let lock = |folder: &&Path| folder.join("Cargo.lock").is_file();
    package.iter().flat_map(|folder| folder.ancestors()).find(lock).map(Path::to_path_buf).unwrap_or_default()
}

/// A path as seen from the workspace's folder.
pub fn beside(path: &str) -> PathBuf {
    root().join(path)
}

/// A folder of the documentation.
pub fn docs(name: &str) -> PathBuf {
    root().join("docs").join(name)
}

/// Writes text into a page of the documentation, between two marks, and leaves the rest of the page as it is.
///
/// # Errors
///
/// When the page cannot be read or written, or has no such marks.
pub fn into_docs(name: &str, marks: [&str; 2], text: &str) -> anyhow::Result<()> {
    let path = docs(name);
    let page = std::fs::read_to_string(&path).with_context(|| format!("cannot read '{}'", path.display()))?;
    let page = between(&page, marks, text)
        .with_context(|| format!("'{}' has no place for the table: '{}'", path.display(), marks[0].trim()))?;
    std::fs::write(&path, page).with_context(|| format!("cannot write '{}'", path.display()))
}

/// A page with text between two marks instead of what is there; `None` where a mark is missing.
fn between(page: &str, marks: [&str; 2], text: &str) -> Option<String> {
    let (before, rest) = page.split_once(marks[0])?;
    let (_, after) = rest.split_once(marks[1])?;
    Some([before, marks[0], "\n", text, "\n", marks[1], after].concat())
}

/// The folder `target/COMMAND` of the workspace, created if needed.
///
/// # Errors
///
/// When it cannot be created.
pub fn folder(command: &str) -> anyhow::Result<PathBuf> {
    let folder = root().join("target").join(command);
    std::fs::create_dir_all(&folder).with_context(|| format!("cannot create {}", folder.display()))?;
    Ok(folder)
}

/// Writes text to a file of a folder.
///
/// # Errors
///
/// When the file cannot be written.
pub fn write(folder: &Path, name: &str, text: &str) -> anyhow::Result<()> {
    let path = folder.join(name);
    std::fs::write(&path, text).with_context(|| format!("cannot write {}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::between;

    #[test]
    fn what_stands_around_the_marks_stays() {
        let marks = ["<a>\n", "<b>\n"];
        let once = between("before\n<a>\nold\n<b>\nafter\n", marks, "new\n").expect("both marks");
        assert_eq!(once, "before\n<a>\n\nnew\n\n<b>\nafter\n");
        assert_eq!(between(&once, marks, "new\n").as_deref(), Some(once.as_str()));
        assert_eq!(between("<b>\n<a>\n", marks, "new"), None);
    }
}
