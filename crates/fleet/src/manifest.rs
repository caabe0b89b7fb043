//! Units in a list: CSV, or the same as lines of JSON.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use case_files::TextError;
use case_files::inputs::is_path;
use recordings::{Mapping, Spot, suggest};
use robot_file::BUILT_IN;
use robot_file::RobotSpec;
use serde_json::{Map, Value};

use super::date::Date;
use super::unit::{Defaults, Setup, Unit};

/// The columns that are read.
const COLUMNS: [&str; 7] = ["recording", "id", "robot", "robot_id", "reference", "mapping", "date"];
/// What stands between paths.
const BETWEEN: char = ';';

/// A line of the list: its values with their columns.
struct Line {
    number: u32,
    /// By the names of [`COLUMNS`]: column of the text and value.
    values: HashMap<&'static str, (u32, String)>,
}

/// A list with the name of its file.
struct List<'a> {
    shown: &'a str,
    /// Paths count from here.
    folder: &'a Path,
}

/// Reads a list of recordings: CSV with a header, or lines of JSON where the file ends in `.jsonl`, `.ndjson` or `.json`.
/// Paths are relative to the list; several are separated by `;` (a list of strings in JSON).
///
/// # Errors
/// With line and column: unknown columns and names, missing values, dates that are none, an id that is given twice.
pub fn read(file: &Path, defaults: &Defaults) -> Result<Vec<Unit>> {
    let shown = file.display().to_string();
    let text = fs::read_to_string(file).with_context(|| format!("cannot read the list '{shown}'"))?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    let list = List { shown: &shown, folder: file.parent().unwrap_or(Path::new("")) };
    let ending = file.extension().and_then(|e| e.to_str()).unwrap_or_default().to_lowercase();
    let lines = if ["jsonl", "ndjson", "json"].contains(&ending.as_str()) { list.json(text)? } else { list.csv(text)? };
    let mut seen: HashMap<String, u32> = HashMap::new();
    let mut out = Vec::new();
    for line in &lines {
        let unit = list.unit(line, defaults)?;
        if let Some(before) = seen.insert(unit.id.clone(), line.number) {
            let column = line.values.get("id").or(line.values.get("recording")).map_or(1, |v| v.0);
            let id = &unit.id;
            let message =
                format!("the id `{id}` is that of line {before} already; give each recording an id of its own");
            return Err(list.wrong(line.number, column, message));
        }
        out.push(unit);
    }
    if out.is_empty() {
        return Err(list.wrong(1, 1, "the list names no recording; add a line for each".to_owned()));
    }
    Ok(out)
}

impl List<'_> {
    fn wrong(&self, line: u32, column: u32, message: String) -> anyhow::Error {
        TextError { spot: Spot { file: self.shown.to_owned(), at: Some((line, column)) }, message }.into()
    }

    /// The column that a name stands for; none if it is nothing like any of them.
    fn column(&self, line: u32, column: u32, name: &str) -> Result<Option<&'static str>> {
        if let Some(known) = COLUMNS.iter().find(|known| **known == name) {
            return Ok(Some(known));
        }
        // A column of the user's own is no mistake, one that is nearly ours is.
        match suggest::nearest(name, COLUMNS) {
            Some(near) => Err(self.wrong(line, column, format!("unknown column `{name}`; did you mean `{near}`?"))),
            None => Ok(None),
        }
    }

    fn csv(&self, text: &str) -> Result<Vec<Line>> {
        let mut reader = csv::ReaderBuilder::new().has_headers(false).trim(csv::Trim::All).from_reader(text.as_bytes());
        let mut known: Option<Vec<Option<&'static str>>> = None;
        let mut out = Vec::new();
        for record in reader.records() {
            let record = record.map_err(|error| {
                let line = error.position().map_or(1, |p| p.line() as u32);
                let message = match error.kind() {
                    csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
                        format!(
                            "this line has {len} fields, the header {expected_len}; quote a field that holds a comma"
                        )
                    }
                    _ => format!("this is no CSV: {error}"),
                };
                self.wrong(line, 1, message)
            })?;
            let (line, start) = record.position().map_or((1, 0), |p| (p.line() as u32, p.byte() as usize));
            let at = |field: usize| column_of(text, start, field);
            let Some(columns) = &known else {
                let columns = record.iter().enumerate().map(|(i, name)| self.column(line, at(i), name));
                let columns = columns.collect::<Result<Vec<_>>>()?;
                if !columns.contains(&Some("recording")) {
                    let message = format!("the header has no column `recording`; known are: {}", COLUMNS.join(", "));
                    return Err(self.wrong(line, 1, message));
                }
                known = Some(columns);
                continue;
            };
            let mut values = HashMap::new();
            for (i, (column, value)) in columns.iter().zip(&record).enumerate() {
                if let Some(column) = column.filter(|_| !value.is_empty())
                    && values.insert(column, (at(i), value.to_owned())).is_some()
                {
                    return Err(self.wrong(line, at(i), format!("the column `{column}` is there twice; keep one")));
                }
            }
            out.push(Line { number: line, values });
        }
        Ok(out)
    }

    fn json(&self, text: &str) -> Result<Vec<Line>> {
        let mut out = Vec::new();
        for (number, text) in (1..).zip(text.lines()).filter(|(_, text)| !text.trim().is_empty()) {
            let object: Map<String, Value> = serde_json::from_str(text).map_err(|error| {
                let message = error.to_string();
                let end = message.find(" at line ").unwrap_or(message.len());
                let message = format!("this line is no JSON object: {}", &message[..end]);
                self.wrong(number, error.column().max(1) as u32, message)
            })?;
            let mut values = HashMap::new();
            for (key, value) in &object {
                let quoted = text.find(&format!("\"{key}\"")).unwrap_or(0);
                let at = text[..quoted].chars().count() as u32 + 1;
                let Some(column) = self.column(number, at, key)? else { continue };
                let value = match value {
                    Value::Null => continue,
                    Value::String(text) => text.clone(),
                    Value::Array(all) if ["recording", "reference"].contains(&column) => {
                        let texts: Option<Vec<&str>> = all.iter().map(Value::as_str).collect();
                        let wrong = || self.wrong(number, at, format!("`{column}` is a path or a list of paths"));
                        texts.ok_or_else(wrong)?.join(";")
                    }
                    other => return Err(self.wrong(number, at, format!("`{column}` is a text, not {other}"))),
                };
                values.insert(column, (at, value));
            }
            out.push(Line { number, values });
        }
        Ok(out)
    }

    fn unit(&self, line: &Line, defaults: &Defaults) -> Result<Unit> {
        let get = |name: &str| line.values.get(name).filter(|(_, text)| !text.trim().is_empty());
        let value = |name: &str| get(name).map(|(_, text)| text.trim().to_owned());
        let paths = |text: &str| -> Vec<PathBuf> {
            text.split(BETWEEN).map(str::trim).filter(|p| !p.is_empty()).map(|p| self.folder.join(p)).collect()
        };
        let recording = value("recording").map(|text| paths(&text)).unwrap_or_default();
        let Some(first) = recording.first() else {
            let at = line.values.get("recording").map_or(1, |v| v.0);
            return Err(self.wrong(line.number, at, "this line names no recording; give its path".to_owned()));
        };
        let robot = match (get("robot"), &defaults.robot) {
            (Some((at, name)), _) => self.robot(line.number, *at, name.trim())?,
            (None, Some(robot)) => robot.clone(),
            (None, None) => {
                let message = "this line names no robot; add a column `robot`, or name one for all with --robot";
                return Err(self.wrong(line.number, 1, message.to_owned()));
            }
        };
        let date = match get("date") {
            Some((at, text)) => {
                Some(Date::parse(text.trim()).map_err(|message| self.wrong(line.number, *at, message))?)
            }
            None => None,
        };
        let mapping = match get("mapping") {
            Some((at, name)) => Some(self.mapping(line.number, *at, name.trim())?),
            None => defaults.mapping.clone(),
        };
        let plain = first.strip_prefix(self.folder).unwrap_or(first).with_extension("");
        Ok(Unit {
            id: value("id").unwrap_or_else(|| plain.to_string_lossy().replace('\\', "/")),
            robot_id: value("robot_id"),
            date,
            setup: Setup {
                robot,
                reference: value("reference").map_or_else(|| defaults.reference.clone(), |text| paths(&text)),
                mapping,
            },
            recording,
        })
    }

    /// A file beside the list, or what is built in.
    fn robot(&self, line: u32, column: u32, name: &str) -> Result<String> {
        let file = self.folder.join(name);
        if file.is_file() {
            return Ok(file.display().to_string());
        }
        if is_path(name) {
            return Err(self.wrong(line, column, format!("there is no robot file '{}'", file.display())));
        }
        if RobotSpec::built_in(name).is_err() {
            let hint = suggest::hint(name, &BUILT_IN.iter().map(|b| b.0).collect::<Vec<_>>());
            return Err(self.wrong(line, column, format!("there is no robot `{name}`; {hint}")));
        }
        Ok(name.to_owned())
    }

    /// The same for a mapping.
    fn mapping(&self, line: u32, column: u32, name: &str) -> Result<String> {
        let file = self.folder.join(name);
        if file.is_file() {
            return Ok(file.display().to_string());
        }
        if is_path(name) {
            return Err(self.wrong(line, column, format!("there is no mapping file '{}'", file.display())));
        }
        Mapping::built_in(name).map_err(|error| self.wrong(line, column, error.to_string()))?;
        Ok(name.to_owned())
    }
}

/// The column, in characters from 1, at which a field of the CSV record that starts at a byte begins.
fn column_of(text: &str, start: usize, field: usize) -> u32 {
    let rest = text.get(start..).unwrap_or_default();
    // A record may begin behind the end of the line before.
    let record = rest.trim_start_matches(['\r', '\n']);
    let (mut quoted, mut passed, mut column) = (false, 0, 1);
    for c in record.chars() {
        if passed == field {
            break;
        }
        match c {
            '"' => quoted = !quoted,
            ',' if !quoted => passed += 1,
            '\n' => break,
            _ => {}
        }
        column += 1;
    }
    column
}

#[cfg(test)]
mod tests;
