//! Rows as a Parquet table.

use std::fs::File;
use std::io::BufWriter;
use std::path::Path;
use std::sync::Arc;

use anyhow::Result;
use parquet::basic::{Compression, LogicalType, Repetition, TimeUnit, Type as Physical, ZstdLevel};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::{Type, TypePtr};

use super::row::{CAUSES, Row, RowCause, verdict_name};
use super::store::whole;

/// Rows that are held and written at once.
const ROWS_PER_GROUP: usize = 1000;

/// What a row has in a column.
type Of<T> = Box<dyn Fn(&Row) -> T>;

/// One value of a column for each row, or a list of them.
enum Values {
    Text(Of<Option<String>>),
    Number(Of<Option<f64>>),
    Count(Of<Option<i64>>),
    Time(Of<Option<i64>>),
    Texts(Of<Vec<String>>),
    Numbers(Of<Vec<f64>>),
}

struct Column {
    name: String,
    values: Values,
}

fn column(name: impl Into<String>, values: Values) -> Column {
    Column { name: name.into(), values }
}

fn text(name: &str, of: impl Fn(&Row) -> Option<String> + 'static) -> Column {
    column(name, Values::Text(Box::new(of)))
}

fn number(name: &str, of: impl Fn(&Row) -> Option<f64> + 'static) -> Column {
    column(name, Values::Number(Box::new(of)))
}

fn texts(name: &str, of: impl Fn(&Row) -> Vec<String> + 'static) -> Column {
    column(name, Values::Texts(Box::new(of)))
}

fn count(name: &str, of: impl Fn(&Row) -> Option<i64> + 'static) -> Column {
    column(name, Values::Count(Box::new(of)))
}

/// The columns of a cause.
fn of_cause(number: usize) -> Vec<Column> {
    let text = |name: &str, of: fn(&RowCause) -> Option<String>| {
        column(
            format!("cause_{number}_{name}"),
            Values::Text(Box::new(move |row| row.causes.get(number - 1).and_then(of))),
        )
    };
    let value = |name: &str, of: fn(&RowCause) -> Option<f64>| {
        column(
            format!("cause_{number}_{name}"),
            Values::Number(Box::new(move |row| row.causes.get(number - 1).and_then(of))),
        )
    };
    vec![
        text("effect", |c| Some(c.effect.clone())),
        text("name", |c| Some(c.name.clone())),
        text("side", |c| c.side.clone()),
        value("probability", |c| Some(c.probability)),
        value("magnitude", |c| c.magnitude),
        value("low", |c| c.low),
        value("high", |c| c.high),
        text("unit", |c| Some(c.unit.clone())),
        value("x_m", |c| c.place.map(|p| p[0])),
        value("y_m", |c| c.place.map(|p| p[1])),
        value("radius_m", |c| c.place.map(|p| p[2])),
        value("from_s", |c| c.when.map(|w| w[0])),
        value("to_s", |c| c.when.map(|w| w[1])),
    ]
}

/// All columns in their order.
fn columns() -> Vec<Column> {
    let mut out = vec![
        text("id", |r| Some(r.id.clone())),
        texts("recording", |r| r.recording.clone()),
        text("robot_id", |r| Some(r.robot_id.clone())),
        text("robot", |r| Some(r.robot.clone())),
        column("date", Values::Time(Box::new(|r| r.date.map(super::Date::milliseconds)))),
        text("causality", |r| r.causality.clone()),
        text("mapping", |r| r.mapping.clone()),
        number("duration_s", |r| r.duration_s),
        count("rows", |r| r.rows.and_then(|n| i64::try_from(n).ok())),
        text("outcome", |r| Some(r.outcome.name().to_owned())),
        text("error", |r| r.error.clone()),
        text("verdict", |r| r.verdict.map(|v| verdict_name(v).to_owned())),
        number("probability", |r| r.probability),
        texts("sentences", |r| r.sentences.clone()),
    ];
    out.extend((1..=CAUSES).flat_map(of_cause));
    out.extend([
        texts("effects", |r| r.probabilities.iter().map(|p| p.0.clone()).collect()),
        column("probabilities", Values::Numbers(Box::new(|r| r.probabilities.iter().map(|p| p.1).collect()))),
        texts("limits", |r| r.limits.clone()),
        count("losses", |r| i64::try_from(r.lost.len()).ok()),
        texts("lost", |r| r.lost.clone()),
        texts("source_part", |r| r.sources.iter().map(|s| s.part.clone()).collect()),
        texts("source", |r| r.sources.iter().map(|s| s.name.clone()).collect()),
        texts("source_sha256", |r| r.sources.iter().map(|s| s.sha256.clone()).collect()),
        text("json", |r| r.json.clone()),
        count("format", |r| Some(i64::from(r.format))),
        text("version", |r| Some(r.version.clone())),
        text("key", |r| Some(r.key.clone())),
    ]);
    out
}

/// Writes rows as they come, a thousand at a time; the same rows in the same order give the same bytes.
///
/// # Errors
/// What `rows` fails with, and those of the disk.
pub(crate) fn write(path: &Path, rows: &mut dyn Iterator<Item = Result<Row>>) -> Result<()> {
    whole(path, |file| {
        let columns = columns();
        let properties = WriterProperties::builder()
            .set_compression(Compression::ZSTD(ZstdLevel::default()))
            .set_created_by("lacuna".to_owned())
            .build();
        let mut writer = SerializedFileWriter::new(file, schema(&columns)?, Arc::new(properties))?;
        loop {
            let group: Vec<Row> = rows.take(ROWS_PER_GROUP).collect::<Result<_>>()?;
            if group.is_empty() {
                break;
            }
            let mut out = writer.next_row_group()?;
            for column in &columns {
                write_column(&mut out, &column.values, &group)?;
            }
            out.close()?;
        }
        writer.close()?;
        Ok(())
    })
}

type GroupWriter<'a, 'f> = SerializedRowGroupWriter<'a, &'f mut BufWriter<File>>;

fn write_column(out: &mut GroupWriter<'_, '_>, values: &Values, rows: &[Row]) -> Result<(), ParquetError> {
    let Some(mut column) = out.next_column()? else { return Ok(()) };
    let bytes = |text: String| ByteArray::from(text.into_bytes());
    match values {
        Values::Text(of) => {
            let (there, values) = single(rows, of);
            let values: Vec<ByteArray> = values.into_iter().map(bytes).collect();
            column.typed::<ByteArrayType>().write_batch(&values, Some(&there), None)?;
        }
        Values::Number(of) => {
            let (there, values) = single(rows, of);
            column.typed::<DoubleType>().write_batch(&values, Some(&there), None)?;
        }
        Values::Count(of) | Values::Time(of) => {
            let (there, values) = single(rows, of);
            column.typed::<Int64Type>().write_batch(&values, Some(&there), None)?;
        }
        Values::Texts(of) => {
            let (there, repeated, values) = several(rows, of);
            let values: Vec<ByteArray> = values.into_iter().map(bytes).collect();
            column.typed::<ByteArrayType>().write_batch(&values, Some(&there), Some(&repeated))?;
        }
        Values::Numbers(of) => {
            let (there, repeated, values) = several(rows, of);
            column.typed::<DoubleType>().write_batch(&values, Some(&there), Some(&repeated))?;
        }
    }
    column.close()
}

/// For each row 1 where there is a value and 0 where not; and the values.
fn single<T>(rows: &[Row], of: &dyn Fn(&Row) -> Option<T>) -> (Vec<i16>, Vec<T>) {
    let all: Vec<Option<T>> = rows.iter().map(of).collect();
    (all.iter().map(|v| i16::from(v.is_some())).collect(), all.into_iter().flatten().collect())
}

/// For each item, or empty list, whether it is there and whether it goes on with a list; and the items.
fn several<T>(rows: &[Row], of: &dyn Fn(&Row) -> Vec<T>) -> (Vec<i16>, Vec<i16>, Vec<T>) {
    let (mut there, mut repeated, mut values) = (Vec::new(), Vec::new(), Vec::new());
    for items in rows.iter().map(of) {
        there.push(i16::from(!items.is_empty()));
        repeated.push(0);
        for _ in 1..items.len() {
            there.push(1);
            repeated.push(1);
        }
        values.extend(items);
    }
    (there, repeated, values)
}

fn schema(columns: &[Column]) -> Result<TypePtr, ParquetError> {
    let fields = columns.iter().map(|c| match &c.values {
        Values::Text(_) => primitive(&c.name, Physical::BYTE_ARRAY, Some(LogicalType::String), Repetition::OPTIONAL),
        Values::Number(_) => primitive(&c.name, Physical::DOUBLE, None, Repetition::OPTIONAL),
        Values::Count(_) => primitive(&c.name, Physical::INT64, None, Repetition::OPTIONAL),
        Values::Time(_) => {
            let instant = LogicalType::timestamp(true, TimeUnit::MILLIS);
            primitive(&c.name, Physical::INT64, Some(instant), Repetition::OPTIONAL)
        }
        Values::Texts(_) => {
            list(&c.name, primitive("element", Physical::BYTE_ARRAY, Some(LogicalType::String), Repetition::REQUIRED)?)
        }
        Values::Numbers(_) => list(&c.name, primitive("element", Physical::DOUBLE, None, Repetition::REQUIRED)?),
    });
    let fields = fields.collect::<Result<Vec<_>, _>>()?;
    Type::group_type_builder("recordings").with_fields(fields).build().map(Arc::new)
}

fn primitive(
    name: &str,
    physical: Physical,
    logical: Option<LogicalType>,
    repetition: Repetition,
) -> Result<TypePtr, ParquetError> {
    let builder = Type::primitive_type_builder(name, physical).with_repetition(repetition);
    builder.with_logical_type(logical).build().map(Arc::new)
}

/// A list in the form that readers of all languages know.
fn list(name: &str, element: TypePtr) -> Result<TypePtr, ParquetError> {
    let items = Type::group_type_builder("list").with_repetition(Repetition::REPEATED).with_fields(vec![element]);
    let list = Type::group_type_builder(name).with_repetition(Repetition::REQUIRED);
    list.with_logical_type(Some(LogicalType::List)).with_fields(vec![Arc::new(items.build()?)]).build().map(Arc::new)
}
