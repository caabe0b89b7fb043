//! One CSV file against one entry of a mapping: rows become samples, and what does not is counted.

mod blocks;
mod parse;

use std::sync::Arc;

use bags::{Loss, LossKind, Place, ReadSeek};

use crate::column::{Column, Keep};
use crate::error::RecordingError;
use crate::header::Header;
use crate::input::Policy;
use crate::mapping::FileMapping;
use crate::row::Row;
use crate::samples::Samples;
use blocks::{Block, Blocks};
use parse::{Layout, Line, Parsed};

/// What a table gave.
pub(crate) struct Table<K> {
    pub(crate) columns: Vec<Column<K>>,
    pub(crate) unused: Vec<String>,
    pub(crate) bytes: u64,
    pub(crate) sha256: String,
}

/// Reads a file's rows; the columns that hold samples, on clock `clock`. The file is passed over once, in blocks that
/// are parsed on all cores and taken in order.
pub(crate) fn read_rows<K: Keep>(
    (keep, policy): (&K, Policy),
    (name, source): (&str, &mut dyn ReadSeek),
    (file, mapping): (&FileMapping, &str),
    clock: usize,
    losses: &mut Vec<Loss>,
) -> Result<Table<K::Kept>, RecordingError> {
    let mut blocks = Blocks::new(name, source);
    let first = blocks.first()?;
    let header = Header::find(name, &first, file, mapping)?;
    let layout = Layout::new(&header, file.delimiter, file.decimal_comma, file.time.ns_per_unit);
    let mut samples = Samples::new(keep, name, Place::Line, policy, (&file.time, header.time), header.columns);
    let (mut number, mut first_line) = (0_u64, header.line + 1);
    let mut take = |block: &Block, parsed: Parsed| {
        for (index, at) in parsed.lines.iter().enumerate() {
            let line = Line { layout: &layout, block, parsed: &parsed, index, begins: first_line };
            if at.fields == layout.width {
                samples.take(&line, number)?;
            } else {
                let error = || {
                    let (found, expected) = (at.fields, layout.width);
                    RecordingError::WrongFieldCount { file: name.to_owned(), line: line.place(), found, expected }
                };
                samples.lose_row(LossKind::FieldCount, || line.place(), error)?;
            }
            number += 1;
        }
        first_line += parsed.line_ends;
        Ok(())
    };
    let first = Block { bytes: Arc::new(first), from: header.below };
    let passed = blocks.pass(first, &|block: &Block| Parsed::new(block, &layout), &mut take)?;
    if number == 0 {
        return Err(RecordingError::NoRows { file: name.to_owned(), line: header.line });
    }
    let columns = samples.finish(clock, losses)?;
    Ok(Table { columns, unused: header.unused, bytes: passed.bytes, sha256: passed.sha256 })
}
