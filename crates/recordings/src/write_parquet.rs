//! A recording as a Parquet table, with the columns of the CSV.

use std::io::{self, Write};
use std::sync::Arc;

use parquet::basic::{Compression, Repetition, Type as Physical, ZstdLevel};
use parquet::data_type::{DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{Type, TypePtr};

use crate::channel::Channel;
use crate::described;
use crate::recording::Recording;

/// Rows that are written, and later read, at once: some megabytes per column.
const ROWS_PER_GROUP: usize = 1 << 20;

/// Writes the channels on one clock of a recording as a Parquet table in SI: `time_ns` (64-bit whole nanoseconds), then
/// a column of doubles per channel such as `gyro_z_rad_s`; a row per instant at which any of them has a sample, a null
/// where one has none. Compressed with zstd.
///
/// A table is wide, as [`write_csv`](crate::write_csv) writes it: every tool shows it and plots it as it is, columns
/// compress well, and instants are stored once. It holds one clock, because instants of two cannot share rows. Stamps
/// and values are stored bit for bit. The file's metadata holds `recording`, `clock`, `clock_rate_hz` and for every
/// column `<column>.signal`, `.unit`, `.source`, `.set_point`, `.magnitude_only` and `.dead_band`. The built-in mapping
/// `lacuna` reads all of it back.
///
/// # Errors
/// Those of the sink.
///
/// ```
/// use recordings::{Channel, Clock, Recording, Signal, write_parquet};
/// let gyro = Channel::new(Signal::GyroZ, 0, vec![0, 10_000_000], vec![0.5, -0.25])?;
/// let clock = Clock { name: "imu".to_owned(), nominal_rate_hz: None };
/// let mut bytes = Vec::new();
/// write_parquet(&Recording::new("run", vec![clock], vec![gyro])?, 0, &mut bytes)?;
/// assert!(bytes.starts_with(b"PAR1") && bytes.ends_with(b"PAR1"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_parquet(recording: &Recording, clock: usize, sink: &mut (dyn Write + Send)) -> io::Result<()> {
    write(recording, clock, sink).map_err(|error| match error {
        ParquetError::External(error) => match error.downcast::<io::Error>() {
            Ok(error) => *error,
            Err(other) => io::Error::other(other),
        },
        other => io::Error::other(other),
    })
}

fn write(recording: &Recording, clock: usize, sink: &mut (dyn Write + Send)) -> Result<(), ParquetError> {
    let channels: Vec<&Channel> = recording.channels().iter().filter(|channel| channel.clock() == clock).collect();
    let mut stamps: Vec<i64> = channels.iter().flat_map(|channel| channel.t_ns()).copied().collect();
    stamps.sort_unstable();
    stamps.dedup();

    let properties = WriterProperties::builder()
        .set_compression(Compression::ZSTD(ZstdLevel::default()))
        .set_created_by("recordings".to_owned())
        .set_key_value_metadata(Some(about(recording, clock, &channels)))
        .build();
    let mut writer = SerializedFileWriter::new(sink, schema(&channels)?, Arc::new(properties))?;
    for rows in stamps.chunks(ROWS_PER_GROUP) {
        let mut group = writer.next_row_group()?;
        if let Some(mut column) = group.next_column()? {
            column.typed::<Int64Type>().write_batch(rows, None, None)?;
            column.close()?;
        }
        for channel in &channels {
            let (values, there) = part(channel, rows);
            if let Some(mut column) = group.next_column()? {
                column.typed::<DoubleType>().write_batch(values, Some(&there), None)?;
                column.close()?;
            }
        }
        group.close()?;
    }
    writer.close()?;
    Ok(())
}

/// The values of a channel within some rows, and for each row 1 where there is one and 0 where not.
fn part<'a>(channel: &'a Channel, rows: &[i64]) -> (&'a [f64], Vec<i16>) {
    let stamps = channel.t_ns();
    let (Some(&first), Some(&last)) = (rows.first(), rows.last()) else { return (&[], Vec::new()) };
    let start = stamps.partition_point(|&t| t < first);
    let end = stamps.partition_point(|&t| t <= last);
    let mut waiting = stamps[start..end].iter().peekable();
    let there = rows.iter().map(|row| i16::from(waiting.next_if_eq(&row).is_some())).collect();
    (&channel.values()[start..end], there)
}

fn schema(channels: &[&Channel]) -> Result<TypePtr, ParquetError> {
    let field = |name: &str, physical, repetition| {
        Type::primitive_type_builder(name, physical).with_repetition(repetition).build().map(Arc::new)
    };
    let mut fields = vec![field("time_ns", Physical::INT64, Repetition::REQUIRED)?];
    for channel in channels {
        fields.push(field(&channel.signal().column_name(), Physical::DOUBLE, Repetition::OPTIONAL)?);
    }
    Type::group_type_builder("recording").with_fields(fields).build().map(Arc::new)
}

/// What the file says of the recording and its columns.
fn about(recording: &Recording, clock: usize, channels: &[&Channel]) -> Vec<KeyValue> {
    let mut about = vec![KeyValue::new("recording".to_owned(), recording.name().to_owned())];
    about.extend(recording.clocks().get(clock).map(|clock| KeyValue::new("clock".to_owned(), clock.name.clone())));
    about.extend(described::clock_rate(recording, clock).map(|(key, value)| KeyValue::new(key.to_owned(), value)));
    for channel in channels {
        let name = channel.signal().column_name();
        let attributes = described::attributes(channel).into_iter();
        about.extend(attributes.map(|(key, value)| KeyValue::new(format!("{name}.{key}"), value)));
        about.push(KeyValue::new(format!("{name}.signal"), channel.name().to_owned()));
        about.push(KeyValue::new(format!("{name}.unit"), channel.unit().symbol().to_owned()));
        about.push(KeyValue::new(format!("{name}.source"), channel.column().to_owned()));
    }
    about
}
