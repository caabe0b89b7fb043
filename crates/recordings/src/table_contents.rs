//! What is inside a table, before anybody has said what its columns mean.

use std::io::{Cursor, Read, SeekFrom};

use bags::{FileError, Format, LARGEST_RECORD, ReadSeek, Stored, cannot_read, head, read_whole};
use csv::ByteRecord;
use sha2::{Digest, Sha256};

use crate::cell;
use crate::column_survey::{ColumnContents, ColumnSurvey};
use crate::error::RecordingError;
use crate::header::{head_line, split};
use crate::parquet;
use crate::row::shown;
use crate::table_guess::{is_headless, written};

/// Bytes at the start of a CSV file that delimiter and decimal sign are guessed by.
const GUESSED_BY: u64 = 64 << 10;

/// What is inside a table.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct TableContents {
    /// How it is written.
    pub format: TableFormat,
    /// Its columns in the order of the file.
    pub columns: Vec<ColumnContents>,
    /// Rows, the header not counted.
    pub rows: u64,
    /// Rows of CSV with another number of fields than the header; nothing is counted in them.
    pub misfits: u64,
    /// The first line holds only numbers: the names of the columns are missing.
    pub headless: bool,
    /// Length of the file in bytes.
    pub bytes: u64,
    /// SHA-256 of the file, 64 hexadecimal digits.
    pub sha256: String,
}

/// How a table is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TableFormat {
    /// Text; delimiter and decimal sign as they were inferred.
    Csv {
        /// What stands between fields.
        delimiter: u8,
        /// Numbers have a decimal comma.
        decimal_comma: bool,
    },
    /// Parquet.
    Parquet,
}

impl TableContents {
    /// The column that looks most like a time: by its name among those that rise, else the first of them.
    pub fn time(&self) -> Option<&ColumnContents> {
        let rising = || self.columns.iter().filter(|column| column.time.is_some());
        rising().find(|column| column.is_called_time()).or_else(|| rising().next())
    }
}

/// Passes over a table and tells what is inside: columns, numbers, gaps, and which columns look like a time. CSV of any
/// length needs little memory; Parquet, and what is compressed with zstd, is read whole.
///
/// # Errors
/// When the source fails, and when the file is empty, no table, or too large for a format that is read whole.
///
/// ```
/// use std::io::Cursor;
/// let table = recordings::table_contents("a.csv", &mut Cursor::new(b"t;speed\n0,0;1,5\n0,5;\n1,0;2,5\n"))?;
/// assert_eq!(table.time().map(|column| column.name.as_str()), Some("t"));
/// assert_eq!((table.columns[1].numbers, table.columns[1].range), (2, Some((1.5, 2.5))));
/// # Ok::<(), recordings::RecordingError>(())
/// ```
pub fn table_contents(name: &str, source: &mut dyn ReadSeek) -> Result<TableContents, RecordingError> {
    let stored = Stored::of(name, &head(name, source)?);
    let whole = match stored {
        Stored::As(Format::Csv) => return text(name, source),
        Stored::As(Format::Parquet) | Stored::Compressed => read_whole(name, source)?.unbroken(name)?,
        Stored::As(Format::Mcap | Format::Sqlite) => {
            let (file, message) = (name.to_owned(), "it is a bag".to_owned());
            return Err(FileError::NotReadable { file, format: "table", message }.into());
        }
    };
    let mut table = if Stored::of("", &whole.bytes) == Stored::As(Format::Parquet) {
        let (columns, rows) = parquet::survey(name, whole.bytes)?;
        let columns = columns.into_iter().map(ColumnSurvey::finish).collect();
        let (format, sha256) = (TableFormat::Parquet, String::new());
        TableContents { format, columns, rows, misfits: 0, headless: false, bytes: 0, sha256 }
    } else {
        text(name, &mut Cursor::new(whole.bytes))?
    };
    (table.bytes, table.sha256) = (whole.file_bytes, whole.sha256);
    Ok(table)
}

/// The same of CSV.
fn text(name: &str, source: &mut dyn ReadSeek) -> Result<TableContents, RecordingError> {
    let failed = |byte: u64, error: &std::io::Error| cannot_read(name, byte, error);
    let mut start = Vec::new();
    (&mut *source).take(GUESSED_BY).read_to_end(&mut start).map_err(|error| failed(0, &error))?;
    source.seek(SeekFrom::Start(0)).map_err(|error| failed(0, &error))?;
    let first = head_line(name, &start)?;
    let (delimiter, decimal_comma) = written(first.text, first.body, (start.len() as u64) < GUESSED_BY);
    let names = split(first.text, delimiter);
    let headless = is_headless(&names, decimal_comma);
    let mut columns: Vec<ColumnSurvey> = names.into_iter().map(ColumnSurvey::new).collect();

    let mut hashed = Hashed { source, sha256: Sha256::new(), bytes: 0, line: 0 };
    let mut lines = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .quoting(false)
        .delimiter(delimiter)
        .from_reader(&mut hashed);
    let (mut record, mut below_header) = (ByteRecord::new(), false);
    let (mut rows, mut misfits) = (0, 0);
    loop {
        match lines.read_byte_record(&mut record) {
            Ok(true) => {}
            Ok(false) => break,
            Err(error) => {
                let byte = error.position().map_or(0, csv::Position::byte);
                return Err(failed(byte, &std::io::Error::other(error)).into());
            }
        }
        if !below_header {
            let mark: &[u8] = b"\xef\xbb\xbf";
            below_header = !record.iter().all(|cell| cell.strip_prefix(mark).unwrap_or(cell).trim_ascii().is_empty());
            continue;
        }
        rows += 1;
        if record.len() != columns.len() {
            misfits += 1;
            continue;
        }
        for (column, cell) in columns.iter_mut().zip(&record) {
            let number = cell::with_point(cell, decimal_comma).and_then(|cell| cell::number(&cell));
            column.look(number, || shown(&String::from_utf8_lossy(cell::bare(cell))));
        }
    }
    drop(lines);
    if rows == 0 {
        return Err(RecordingError::NoRows { file: name.to_owned(), line: first.line });
    }
    let format = TableFormat::Csv { delimiter, decimal_comma };
    let columns = columns.into_iter().map(ColumnSurvey::finish).collect();
    let (bytes, sha256) = (hashed.bytes, hex::encode(hashed.sha256.finalize()));
    Ok(TableContents { format, columns, rows, misfits, headless, bytes, sha256 })
}

/// A source whose bytes are counted and hashed as they pass; a line without end is refused before it fills the memory.
struct Hashed<'a> {
    source: &'a mut dyn ReadSeek,
    sha256: Sha256,
    bytes: u64,
    /// Bytes since the last end of a line.
    line: usize,
}

impl Read for Hashed<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let count = self.source.read(buffer)?;
        let passed = &buffer[..count];
        self.sha256.update(passed);
        self.bytes += count as u64;
        let since = passed.iter().rev().position(|byte| b"\r\n".contains(byte));
        self.line = since.unwrap_or(self.line + count);
        if self.line > LARGEST_RECORD {
            return Err(std::io::Error::other(format!(
                "a line is longer than {LARGEST_RECORD} bytes: this is no table"
            )));
        }
        Ok(count)
    }
}
