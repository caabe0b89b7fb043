//! Columns of a table by the names in its header, for robots whose files name their columns instead of a mapping.

use bags::{FileError, Format, ReadSeek, Stored, read_whole};

use crate::cell;
use crate::error::RecordingError;
use crate::header::{head_line, split};
use crate::parquet;
use crate::row::shown;
use crate::table_guess::written;

/// Columns of a table that were asked for.
#[derive(Debug, Clone, Default, PartialEq)]
#[non_exhaustive]
pub struct NamedColumns {
    /// Names of all columns, in the order of the file.
    pub names: Vec<String>,
    /// Those that were asked for and are there.
    pub columns: Vec<NamedColumn>,
    /// How the file is written where it is no plain comma-separated text, in sentences.
    pub told: Vec<String>,
    /// Length of the file in bytes.
    pub bytes: u64,
    /// SHA-256 of the file, 64 hexadecimal digits.
    pub sha256: String,
}

/// One column.
#[derive(Debug, Clone, Default, PartialEq)]
#[non_exhaustive]
pub struct NamedColumn {
    /// Its name.
    pub name: String,
    /// Its cells; `None` of an empty one, NaN where the file says so.
    pub cells: Vec<Option<f64>>,
    /// First cell that holds no number: its row, from 1, and what it holds. It is NaN among the cells.
    pub unread: Option<(usize, String)>,
}

impl NamedColumn {
    pub(crate) fn new(name: &str) -> Self {
        Self { name: name.to_owned(), ..Self::default() }
    }

    /// Adds the next cell: `Err` with what stands there instead of a number.
    pub(crate) fn push(&mut self, cell: Result<Option<f64>, String>) {
        let cell = cell.unwrap_or_else(|text| {
            let row = self.cells.len() + 1;
            self.unread.get_or_insert((row, text));
            Some(f64::NAN)
        });
        self.cells.push(cell);
    }
}

/// Reads the columns of these names from CSV (any delimiter, decimal point or comma) or Parquet, plain or compressed with zstd.
/// Instants of Parquet stay in their own unit. A name that is not there is left out.
///
/// # Errors
/// When the source fails, and when the file is empty, no table, too large for memory, has a row of another length than its header, or
/// two columns of a wanted name.
///
/// ```
/// use std::io::Cursor;
/// let table = recordings::named_columns("a.csv", &mut Cursor::new(b"t;speed\n0,0;1,5\n0,5;\n"), &["t", "speed"])?;
/// assert_eq!(table.columns[1].cells, [Some(1.5), None]);
/// # Ok::<(), recordings::RecordingError>(())
/// ```
pub fn named_columns(name: &str, source: &mut dyn ReadSeek, wanted: &[&str]) -> Result<NamedColumns, RecordingError> {
    let whole = read_whole(name, source)?.unbroken(name)?;
    let (bytes, sha256) = (whole.file_bytes, whole.sha256);
    let read = match Stored::of("", &whole.bytes) {
        Stored::As(Format::Csv) => of_text(name, &whole.bytes, wanted)?,
        Stored::As(Format::Parquet) => parquet::named(name, whole.bytes, wanted)?,
        Stored::As(Format::Mcap | Format::Sqlite) | Stored::Compressed => {
            let (file, message) = (name.to_owned(), "it is a bag; give it its own ending".to_owned());
            return Err(FileError::NotReadable { file, format: "table", message }.into());
        }
    };
    Ok(NamedColumns { bytes, sha256, ..read })
}

fn of_text(file: &str, bytes: &[u8], wanted: &[&str]) -> Result<NamedColumns, RecordingError> {
    let head = head_line(file, bytes)?;
    let (delimiter, decimal_comma) = written(head.text, head.body, true);
    let names = split(head.text, delimiter);
    let mut places = Vec::new();
    let mut columns = Vec::new();
    for (at, name) in names.iter().enumerate().filter(|(_, name)| wanted.contains(&name.as_str())) {
        if columns.iter().any(|read: &NamedColumn| read.name == *name) {
            let (file, column) = (file.to_owned(), name.clone());
            return Err(RecordingError::DuplicateColumn { file, line: head.line, column });
        }
        places.push(at);
        columns.push(NamedColumn::new(name));
    }

    let mut rows =
        csv::ReaderBuilder::new().has_headers(false).flexible(true).delimiter(delimiter).from_reader(head.body);
    for row in rows.byte_records() {
        let row = row.map_err(|error| FileError::NotReadable {
            file: file.to_owned(),
            format: "CSV",
            message: error.to_string(),
        })?;
        if row.len() != names.len() {
            let line = head.line + row.position().map_or(1, csv::Position::line);
            let (file, found, expected) = (file.to_owned(), row.len(), names.len());
            return Err(RecordingError::WrongFieldCount { file, line, found, expected });
        }
        for (column, at) in columns.iter_mut().zip(&places) {
            let cell = row.get(*at).unwrap_or_default();
            column.push(number(cell, decimal_comma));
        }
    }
    let mut told = Vec::new();
    if delimiter != b',' {
        let commas = if decimal_comma { ", and decimals behind commas" } else { "" };
        let sign = char::from(delimiter).escape_default();
        told.push(format!("cells are taken to be separated by '{sign}'{commas}"));
    }
    Ok(NamedColumns { names, columns, told, ..NamedColumns::default() })
}

/// The number in a cell; NaN and infinity where it says so.
fn number(cell: &[u8], decimal_comma: bool) -> Result<Option<f64>, String> {
    let text = || shown(&String::from_utf8_lossy(cell::bare(cell)));
    let with_point = cell::with_point(cell, decimal_comma).map_err(|_| text())?;
    match cell::number(&with_point) {
        Ok(number) => Ok(number),
        Err(cell::CellError::NotFinite) => Ok(Some(f64::NAN)),
        Err(cell::CellError::NotANumber) => Err(text()),
    }
}
