//! One CSV file against one entry of a mapping: rows become samples, and what does not is counted.

use csv::ByteRecord;

use crate::cell::{self, CellError};
use crate::column::{Column, Keep};
use crate::error::RecordingError;
use crate::header::Header;
use crate::loss::{Loss, LossKind};
use crate::mapping::FileMapping;
use crate::place::Place;
use crate::read::Policy;
use crate::samples::{Row, Samples, shown};

/// Reads the rows below `header`; the columns that hold samples, on clock `clock`.
pub(crate) fn read_rows<K: Keep>(
    (keep, policy): (&K, Policy),
    name: &str,
    file: &FileMapping,
    header: &Header<'_>,
    clock: usize,
    losses: &mut Vec<Loss>,
) -> Result<Vec<Column<K::Kept>>, RecordingError> {
    let mut rows = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        // Numbers need no quotes, and an open quote would swallow the rest of the file.
        .quoting(false)
        .delimiter(file.delimiter)
        .from_reader(header.body);
    let mut samples = Samples::new(keep, name, Place::Line, policy, (&file.time, header.time), header.columns.clone());
    let mut record = ByteRecord::new();
    let mut number = 0_u64;
    // Reading from memory without UTF-8 checks and with any number of fields cannot fail; an error ends the rows.
    while rows.read_byte_record(&mut record).unwrap_or(false) {
        let offset = record.position().map_or(0, csv::Position::byte);
        if record.len() == header.width {
            samples.take(&Line { header, comma: file.decimal_comma, record: &record, offset }, number)?;
        } else {
            let line = || header.line_at(offset);
            let error = || {
                let (found, expected) = (record.len(), header.width);
                RecordingError::WrongFieldCount { file: name.to_owned(), line: line(), found, expected }
            };
            samples.lose_row(LossKind::FieldCount, line, error)?;
        }
        number += 1;
    }
    if number == 0 {
        return Err(RecordingError::NoRows { file: name.to_owned(), line: header.line });
    }
    samples.finish(clock, losses)
}

/// A line below the header.
struct Line<'a> {
    header: &'a Header<'a>,
    /// Numbers are written with a decimal comma.
    comma: bool,
    record: &'a ByteRecord,
    /// Byte in the body at which the line starts.
    offset: u64,
}

impl Row for Line<'_> {
    fn number(&self, position: usize) -> Result<Option<f64>, CellError> {
        cell::number(&cell::with_point(&self.record[position], self.comma)?)
    }

    fn instant_ns(&self, position: usize, ns_per_unit: i64) -> Result<Option<i64>, CellError> {
        cell::instant_ns(&cell::with_point(&self.record[position], self.comma)?, ns_per_unit)
    }

    fn text(&self, position: usize) -> String {
        shown(&String::from_utf8_lossy(cell::bare(&self.record[position])))
    }

    fn place(&self) -> u64 {
        self.header.line_at(self.offset)
    }
}
