//! The header line of a CSV file: where the mapped columns are.

use bags::suggest;

use crate::cell::bare;
use crate::error::RecordingError;
use crate::mapping::FileMapping;
use crate::samples::PlacedColumn;
use crate::units::{Unit, parse_unit};

/// The header, and what is below it.
pub(crate) struct Header<'a> {
    /// Line of the header, from 1.
    pub(crate) line: u64,
    /// Byte at which the rows begin.
    pub(crate) below: usize,
    /// Number of columns.
    pub(crate) width: usize,
    /// Where the time is, when there is a time column.
    pub(crate) time: Option<usize>,
    /// The mapped columns that are there.
    pub(crate) columns: Vec<PlacedColumn<'a>>,
    /// The columns that no signal or time was read from.
    pub(crate) unused: Vec<String>,
}

impl<'a> Header<'a> {
    /// Finds the mapped columns in the first line that is not blank.
    pub(crate) fn find(
        file_name: &str,
        bytes: &[u8],
        file: &'a FileMapping,
        mapping: &str,
    ) -> Result<Self, RecordingError> {
        let name = || file_name.to_owned();
        let HeadLine { line, text, body } = head_line(file_name, bytes)?;
        let names = split(text, file.delimiter);

        let hint = |column: &str| {
            let known: Vec<&str> = names.iter().map(String::as_str).collect();
            hint(column, &known, file.delimiter)
        };
        // By the whole name, or by the name before a unit in brackets.
        let position = |column: &str| {
            let whole = |name: &&str| **name == *column.trim();
            let without_unit = |name: &&str| split_unit(name).is_some_and(|(before, _)| before == column.trim());
            let find = |is: &dyn Fn(&&str) -> bool| -> Vec<usize> {
                (0..names.len()).filter(|&index| is(&names[index].as_str())).collect()
            };
            let places = Some(find(&whole)).filter(|places| !places.is_empty()).unwrap_or_else(|| find(&without_unit));
            match places[..] {
                [] => Ok(None),
                [one] => Ok(Some(one)),
                _ => Err(RecordingError::DuplicateColumn { file: name(), line, column: column.to_owned() }),
            }
        };
        let same_unit = |index: usize, factor: f64, unit: Unit| {
            let stated = split_unit(&names[index]).map(|(_, stated)| stated);
            let meaning = stated.and_then(|stated| Some((stated, parse_unit(stated)?)));
            match meaning {
                Some((stated, is)) if is.unit != unit || is.factor != factor => {
                    let (column, stated) = (names[index].clone(), stated.to_owned());
                    Err(RecordingError::HeaderUnit { file: name(), line, column, stated })
                }
                _ => Ok(()),
            }
        };
        let missing = |column: &str, key: String| {
            let (column, hint) = (column.to_owned(), hint(column));
            RecordingError::MissingColumn { file: name(), line, column, key, hint }
        };

        let time = match &file.time.column {
            Some(column) => {
                let position = position(column)?;
                let position = position.ok_or_else(|| missing(column, "the time of mapping ".to_owned() + mapping))?;
                same_unit(position, file.time.ns_per_unit as f64 / 1e9, Unit::Second)?;
                Some(position)
            }
            None => None,
        };
        let mut columns = Vec::new();
        for mapped in &file.columns {
            match position(&mapped.column)? {
                Some(position) => {
                    same_unit(position, mapped.unit.factor, mapped.unit.unit)?;
                    columns.push(PlacedColumn { position, mapped });
                }
                None if mapped.optional => {}
                None => {
                    return Err(missing(&mapped.column, format!("{} of mapping {mapping}", mapped.signal)));
                }
            }
        }
        if columns.is_empty() {
            let first = file.columns.first().map_or("", |mapped| mapped.column.as_str());
            let (mapping, hint) = (mapping.to_owned(), hint(first));
            return Err(RecordingError::NoSignals { file: name(), line, mapping, hint });
        }
        let used = |index: &usize| time == Some(*index) || columns.iter().any(|found| found.position == *index);
        let unused = (0..names.len()).filter(|index| !used(index)).map(|index| names[index].clone()).collect();
        Ok(Self { line, below: bytes.len() - body.len(), width: names.len(), time, columns, unused })
    }
}

/// The first line that is not blank.
pub(crate) struct HeadLine<'a> {
    /// Its number, from 1.
    pub(crate) line: u64,
    /// What it says.
    pub(crate) text: &'a str,
    /// Everything below.
    pub(crate) body: &'a [u8],
}

/// Finds the first line that is not blank.
pub(crate) fn head_line<'a>(name: &str, bytes: &'a [u8]) -> Result<HeadLine<'a>, RecordingError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let start = bytes.iter().position(|byte| !byte.is_ascii_whitespace());
    let start = start.ok_or_else(|| RecordingError::EmptyFile { file: name.to_owned() })?;
    let line = 1 + line_ends(&bytes[..start]);
    let rest = &bytes[start..];
    let end = rest.iter().position(|byte| b"\r\n".contains(byte)).unwrap_or(rest.len());
    let (head, body) = rest.split_at(end);
    let body = body.strip_prefix(b"\r\n").or_else(|| body.get(1..)).unwrap_or_default();
    let head = str::from_utf8(head).ok().filter(|head| !head.contains('\0'));
    let text = head.ok_or_else(|| RecordingError::NotText { file: name.to_owned(), line })?;
    Ok(HeadLine { line, text, body })
}

/// Ends of lines: `\n`, `\r\n` or a lone `\r`.
pub(crate) fn line_ends(bytes: &[u8]) -> u64 {
    let is_end = |index: usize| match bytes[index] {
        b'\n' => true,
        b'\r' => bytes.get(index + 1) != Some(&b'\n'),
        _ => false,
    };
    (0..bytes.len()).filter(|&index| is_end(index)).count() as u64
}

/// A column's name and the unit behind it: `wz [rad/s]`, `speed (m/s)`.
pub(crate) fn split_unit(name: &str) -> Option<(&str, &str)> {
    let (open, inside) =
        [('[', ']'), ('(', ')')].iter().find_map(|&(open, close)| Some((open, name.strip_suffix(close)?)))?;
    let (before, unit) = inside.rsplit_once(open)?;
    Some((before.trim(), unit.trim()))
}

/// The names in a header line, quotes and blanks around them removed.
pub(crate) fn split(head: &str, delimiter: u8) -> Vec<String> {
    let mut reader = csv::ReaderBuilder::new();
    let mut reader = reader.has_headers(false).delimiter(delimiter).from_reader(head.as_bytes());
    let mut record = csv::ByteRecord::new();
    // Reading from memory cannot fail; an error leaves the record empty, and every column is missing.
    let _ = reader.read_byte_record(&mut record);
    record.iter().map(|name| String::from_utf8_lossy(bare(name)).into_owned()).collect()
}

/// What to do about a column that is not there.
fn hint(column: &str, names: &[&str], delimiter: u8) -> String {
    if let (1, Some(only)) = (names.len(), names.first()) {
        let others = [b',', b';', b'\t', b'|'];
        if let Some(&other) = others.iter().find(|&&other| other != delimiter && only.contains(char::from(other))) {
            let other = char::from(other).escape_default();
            return format!("the header is one field; set delimiter = \"{other}\" in the mapping");
        }
    }
    let hint = suggest::hint(column, names);
    hint.replacen("known are:", "the columns are:", 1) + "; correct the mapping or the file"
}
