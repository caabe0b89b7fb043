//! A Parquet table against one entry of a mapping, or by the names of its columns.
//!
//! Pages carry no checksum of their own and the library may panic on damaged ones: any trouble refuses the file.

use std::collections::HashMap;
use std::panic::{AssertUnwindSafe, catch_unwind};

use bags::{Cell, FileError, Loss, Place, suggest};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::reader::RowIter;
use parquet::record::{Field, Row as ParquetRow};
use parquet::schema::types::Type;

use crate::cell::CellError;
use crate::column::{Column, Keep};
use crate::column_survey::ColumnSurvey;
use crate::described::Described;
use crate::error::RecordingError;
use crate::input::Policy;
use crate::mapping::FileMapping;
use crate::named_columns::{NamedColumn, NamedColumns};
use crate::row::{self, Row, shown};
use crate::samples::{PlacedColumn, Samples};

/// What a table gave.
pub(crate) struct Table<K> {
    pub(crate) columns: Vec<Column<K>>,
    pub(crate) unused: Vec<String>,
    /// What the file says of itself.
    pub(crate) about: HashMap<String, String>,
}

/// Columns with what a file that says `about` says of each.
pub(crate) fn described<K>(
    columns: Vec<Column<K>>,
    about: &HashMap<String, String>,
) -> Vec<(Column<K>, Option<Described>)> {
    let say = |key: &str| about.get(key).map(String::as_str);
    let describe = |read: Column<K>| {
        let column = read.signal.column_name();
        let said = Described::read(read.signal.name(), |key| match key {
            "clock" => None,
            "clock_name" => say("clock"),
            "clock_rate_hz" => say(key),
            "column" => say(&format!("{column}.source")),
            key => say(&format!("{column}.{key}")),
        });
        (read, said)
    };
    columns.into_iter().map(describe).collect()
}

/// Reads the mapped columns; those that hold samples, on clock `clock`.
pub(crate) fn read_rows<K: Keep>(
    (keep, policy): (&K, Policy),
    name: &str,
    bytes: Vec<u8>,
    file: &FileMapping,
    mapping: &str,
    clock: usize,
    losses: &mut Vec<Loss>,
) -> Result<Table<K::Kept>, RecordingError> {
    let refuse = |message: String| refused(name, message);
    let read = AssertUnwindSafe(|| {
        let reader = SerializedFileReader::new(bytes::Bytes::from(bytes)).map_err(|error| refuse(error.to_string()))?;
        let metadata = reader.metadata().file_metadata();
        let said = metadata.key_value_metadata().into_iter().flatten();
        let about = said.filter_map(|pair| Some((pair.key.clone(), pair.value.clone()?))).collect();
        let schema = metadata.schema();
        let names: Vec<&str> = schema.get_fields().iter().map(|field| field.name()).collect();
        let chosen = Chosen::of(&names, name, file, mapping)?;
        let rows = rows_of(&reader, &chosen.names).map_err(|error| refuse(error.to_string()))?;
        let mut samples = Samples::new(keep, name, Place::Row, policy, (&file.time, chosen.time), chosen.columns);
        for (number, row) in (0..).zip(rows) {
            let row = row.map_err(|error| refuse(error.to_string()))?;
            samples.take(&TableRow { row, number }, number)?;
        }
        let unused = names.iter().filter(|name| !chosen.names.contains(name)).map(|&name| name.to_owned()).collect();
        let mut lost = Vec::new();
        let columns = samples.finish(clock, &mut lost)?;
        Ok((Table { columns, unused, about }, lost))
    });
    let (table, lost) = catch_unwind(read).unwrap_or_else(|_| Err(refuse("a page is damaged".to_owned())))?;
    losses.extend(lost);
    Ok(table)
}

/// Looks at every cell; the columns and the number of rows.
pub(crate) fn survey(name: &str, bytes: Vec<u8>) -> Result<(Vec<ColumnSurvey>, u64), RecordingError> {
    let refuse = |message: String| refused(name, message);
    let read = AssertUnwindSafe(|| {
        let reader = SerializedFileReader::new(bytes::Bytes::from(bytes)).map_err(|error| refuse(error.to_string()))?;
        let fields = reader.metadata().file_metadata().schema().get_fields();
        let mut columns: Vec<ColumnSurvey> =
            fields.iter().map(|field| ColumnSurvey::new(field.name().to_owned())).collect();
        let mut rows = 0;
        for row in reader.get_row_iter(None).map_err(|error| refuse(error.to_string()))? {
            let row = row.map_err(|error| refuse(error.to_string()))?;
            for (column, (_, field)) in columns.iter_mut().zip(row.get_column_iter()) {
                let cell = cell(field);
                column.ns_per_unit = cell.and_then(|(_, ns_per_unit)| ns_per_unit).or(column.ns_per_unit);
                let number = cell.map_or(Err(CellError::NotANumber), |(cell, _)| row::number(cell));
                column.look(number, || shown(field.to_string().trim_matches('"')));
            }
            rows += 1;
        }
        Ok((columns, rows))
    });
    catch_unwind(read).unwrap_or_else(|_| Err(refuse("a page is damaged".to_owned())))
}

/// The columns of these names; instants in the unit that the file has them in.
pub(crate) fn named(name: &str, bytes: Vec<u8>, wanted: &[&str]) -> Result<NamedColumns, RecordingError> {
    let refuse = |message: String| refused(name, message);
    let read = AssertUnwindSafe(|| {
        let reader = SerializedFileReader::new(bytes::Bytes::from(bytes)).map_err(|error| refuse(error.to_string()))?;
        let schema = reader.metadata().file_metadata().schema();
        let names: Vec<String> = schema.get_fields().iter().map(|field| field.name().to_owned()).collect();
        let mut columns: Vec<NamedColumn> = Vec::new();
        for column in names.iter().filter(|name| wanted.contains(&name.as_str())) {
            if columns.iter().any(|known| known.name == *column) {
                let (file, column) = (name.to_owned(), column.clone());
                return Err(RecordingError::DuplicateColumn { file, line: 1, column });
            }
            columns.push(NamedColumn::new(column));
        }
        for row in rows_of(&reader, wanted).map_err(|error| refuse(error.to_string()))? {
            let row = row.map_err(|error| refuse(error.to_string()))?;
            for (column, (_, field)) in columns.iter_mut().zip(row.get_column_iter()) {
                let text = || shown(field.to_string().trim_matches('"'));
                column.push(cell(field).map(|(cell, _)| cell.number()).ok_or_else(text));
            }
        }
        Ok(NamedColumns { names, columns, ..NamedColumns::default() })
    });
    catch_unwind(read).unwrap_or_else(|_| Err(refuse("a page is damaged".to_owned())))
}

/// Rows of the columns of these names, in the order of the file.
fn rows_of<'a>(reader: &'a dyn FileReader, names: &[&str]) -> parquet::errors::Result<RowIter<'a>> {
    let schema = reader.metadata().file_metadata().schema();
    let fields = schema.get_fields().iter().filter(|field| names.contains(&field.name())).cloned().collect();
    let wanted = Type::group_type_builder(schema.name()).with_fields(fields).build()?;
    reader.get_row_iter(Some(wanted))
}

/// A file that cannot be read, and why.
fn refused(name: &str, message: String) -> RecordingError {
    FileError::NotReadable { file: name.to_owned(), format: "Parquet", message }.into()
}

/// The columns that are read, in the order of the file, and where they are among these.
struct Chosen<'a> {
    names: Vec<&'a str>,
    time: Option<usize>,
    columns: Vec<PlacedColumn<'a>>,
}

impl<'a> Chosen<'a> {
    fn of(all: &[&'a str], name: &str, file: &'a FileMapping, mapping: &str) -> Result<Self, RecordingError> {
        let missing = |column: &str, key: String| {
            let hint = suggest::hint(column, all).replacen("known are:", "the columns are:", 1);
            RecordingError::MissingColumn { file: name.to_owned(), line: 1, column: column.to_owned(), key, hint }
        };
        let there = |column: &str| all.contains(&column);
        if let Some(column) = file.time.column.as_deref().filter(|column| !there(column)) {
            return Err(missing(column, format!("the time of mapping {mapping}")));
        }
        let lacking = file.columns.iter().find(|mapped| !mapped.optional && !there(&mapped.column));
        if let Some(mapped) = lacking {
            return Err(missing(&mapped.column, format!("{} of mapping {mapping}", mapped.signal)));
        }
        let is_time = |column: &str| file.time.column.as_deref() == Some(column);
        let is_mapped = |column: &str| file.columns.iter().any(|mapped| mapped.column == column);
        let names: Vec<&str> = all.iter().copied().filter(|column| is_time(column) || is_mapped(column)).collect();
        let position = |column: &str| names.iter().position(|other| *other == column);
        let columns: Vec<PlacedColumn<'a>> = file
            .columns
            .iter()
            .filter_map(|mapped| Some(PlacedColumn { position: position(&mapped.column)?, mapped }))
            .collect();
        if columns.is_empty() {
            let (file, mapping, hint) = (name.to_owned(), mapping.to_owned(), format!("columns: {}", all.join(", ")));
            return Err(RecordingError::NoSignals { file, line: 1, mapping, hint });
        }
        let time = file.time.column.as_deref().and_then(position);
        Ok(Self { names, time, columns })
    }
}

/// A row of the chosen columns.
struct TableRow {
    row: ParquetRow,
    /// Number of the row, from 0.
    number: u64,
}

impl TableRow {
    fn field(&self, position: usize) -> Option<&Field> {
        self.row.get_column_iter().nth(position).map(|(_, field)| field)
    }

    /// The cell, with the nanoseconds in its unit where it is an instant by itself.
    fn cell(&self, position: usize) -> Option<(Cell, Option<i64>)> {
        cell(self.field(position)?)
    }
}

/// A field as a cell, with the nanoseconds in its unit where it is an instant by itself; `None` for what is no number.
fn cell(field: &Field) -> Option<(Cell, Option<i64>)> {
    let whole = |value: i64| (Cell::Whole(value.into()), None);
    Some(match field {
        Field::Null => (Cell::Gap, None),
        Field::Bool(yes) => whole((*yes).into()),
        Field::Byte(value) => whole((*value).into()),
        Field::Short(value) => whole((*value).into()),
        Field::Int(value) => whole((*value).into()),
        Field::Long(value) => whole(*value),
        Field::UByte(value) => whole((*value).into()),
        Field::UShort(value) => whole((*value).into()),
        Field::UInt(value) => whole((*value).into()),
        Field::ULong(value) => (Cell::Whole((*value).into()), None),
        Field::Float(value) => (Cell::real((*value).into()), None),
        Field::Double(value) => (Cell::real(*value), None),
        Field::TimestampMillis(value) => (Cell::Whole((*value).into()), Some(1_000_000)),
        Field::TimestampMicros(value) => (Cell::Whole((*value).into()), Some(1_000)),
        _ => return None,
    })
}

impl Row for TableRow {
    fn number(&self, position: usize) -> Result<Option<f64>, CellError> {
        row::number(self.cell(position).ok_or(CellError::NotANumber)?.0)
    }

    fn instant_ns(&self, position: usize, ns_per_unit: i64) -> Result<Option<i64>, CellError> {
        let (cell, own) = self.cell(position).ok_or(CellError::NotANumber)?;
        row::instant_ns(cell, own.unwrap_or(ns_per_unit))
    }

    fn text(&self, position: usize) -> String {
        shown(self.field(position).map(ToString::to_string).unwrap_or_default().trim_matches('"'))
    }

    fn place(&self) -> u64 {
        self.number + 1
    }
}
