//! A recording as MCAP with JSON messages, as Foxglove and rerun open it.

use std::collections::BTreeMap;
use std::io::{self, Write};

use mcap::records::{MessageHeader, Metadata};
use mcap::write::NoSeek;
use mcap::{Compression, McapError, WriteOptions, Writer};

use crate::channel::Channel;
use crate::described;
use crate::recording::Recording;

/// Name of the one message type.
pub(crate) const SCHEMA_NAME: &str = "recordings.Sample";

/// The message type: instant, value, unit. Seconds and nanoseconds are how Foxglove writes an instant.
const SCHEMA: &str = r#"{
  "$schema": "https://json-schema.org/draft/2020-12/schema",
  "title": "recordings.Sample",
  "description": "One sample of one signal in SI units",
  "type": "object",
  "properties": {
    "timestamp": {
      "title": "time",
      "type": "object",
      "properties": {
        "sec": { "type": "integer", "minimum": 0 },
        "nsec": { "type": "integer", "minimum": 0, "maximum": 999999999 }
      }
    },
    "value": { "type": "number" },
    "unit": { "type": "string" }
  },
  "required": ["timestamp", "value", "unit"]
}
"#;

/// Writes all channels of a recording as MCAP: one topic per signal, such as `/gyro_z`, in chunks compressed with zstd,
/// with indexes and checksums.
///
/// A message is `{"timestamp":{"sec":1,"nsec":500000000},"value":0.25,"unit":"rad/s"}`. Its log time is the sample's
/// stamp, exactly; a value reads back to the same bits; a gap is no message. Messages of all channels are in the order
/// of their stamps. Channels of several clocks share the one time axis of the file, each with its own stamps: the
/// channel's metadata says which clock (`clock`, `clock_name`, `clock_rate_hz`), and `signal`, `unit`, `column`,
/// `set_point`, `magnitude_only`, `dead_band`. The built-in mapping `lacuna` reads all of it back.
///
/// # Errors
/// Those of the sink; [`io::ErrorKind::InvalidInput`] for a stamp before zero, which MCAP cannot hold.
///
/// ```
/// use recordings::{Channel, Clock, Recording, Signal, write_mcap};
/// let gyro = Channel::new(Signal::GyroZ, 0, vec![0, 10_000_000], vec![0.5, -0.25])?;
/// let clock = Clock { name: "imu".to_owned(), nominal_rate_hz: None };
/// let mut bytes = Vec::new();
/// write_mcap(&Recording::new("run", vec![clock], vec![gyro])?, &mut bytes)?;
/// assert!(bytes.starts_with(b"\x89MCAP0\r\n"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_mcap(recording: &Recording, sink: &mut dyn Write) -> io::Result<()> {
    for channel in recording.channels() {
        if let Some((first, _)) = channel.span_ns().filter(|&(first, _)| first < 0) {
            let seconds = first as f64 * 1e-9;
            return Err(io::Error::new(
                io::ErrorKind::InvalidInput,
                format!(
                    "channel {channel}: starts at {seconds} s; MCAP has no stamps before 0: write CSV or Parquet, \
                         or move the recording's time",
                    channel = channel.name()
                ),
            ));
        }
    }
    write(recording, sink).map_err(|error| match error {
        McapError::Io(error) => error,
        other => io::Error::other(other),
    })
}

fn write(recording: &Recording, sink: &mut dyn Write) -> Result<(), McapError> {
    let mut writer = WriteOptions::new()
        .compression(Some(Compression::Zstd))
        .library("recordings")
        .disable_seeking(true)
        .create(NoSeek::new(sink))?;
    let schema = writer.add_schema(SCHEMA_NAME, "jsonschema", SCHEMA.as_bytes())?;
    let mut queues = Vec::with_capacity(recording.channels().len());
    for channel in recording.channels() {
        let id = writer.add_channel(schema, &format!("/{}", channel.name()), "json", &about(recording, channel))?;
        queues.push(Queue { id, channel, next: 0 });
    }
    write_samples(&mut writer, &mut queues)?;
    let metadata = BTreeMap::from([("name".to_owned(), recording.name().to_owned())]);
    writer.write_metadata(&Metadata { name: "recording".to_owned(), metadata })?;
    writer.finish()?;
    Ok(())
}

/// The samples of a channel that are still to be written.
struct Queue<'a> {
    id: u16,
    channel: &'a Channel,
    next: usize,
}

impl Queue<'_> {
    fn stamp(&self) -> Option<i64> {
        self.channel.t_ns().get(self.next).copied()
    }
}

/// Writes the samples of all channels in the order of their stamps.
fn write_samples<W: Write + io::Seek>(writer: &mut Writer<W>, queues: &mut [Queue<'_>]) -> Result<(), McapError> {
    let mut text = Vec::new();
    loop {
        let waiting = queues.iter_mut().filter_map(|queue| queue.stamp().map(|t_ns| (t_ns, queue)));
        let Some((t_ns, queue)) = waiting.min_by_key(|&(t_ns, _)| t_ns) else { return Ok(()) };
        let log_time = t_ns.unsigned_abs();
        let (seconds, ns) = (log_time / 1_000_000_000, log_time % 1_000_000_000);
        let (value, unit) = (queue.channel.values()[queue.next], queue.channel.unit());
        text.clear();
        write!(text, r#"{{"timestamp":{{"sec":{seconds},"nsec":{ns}}},"value":{value:?},"unit":"{unit}"}}"#)?;
        let sequence = queue.next as u32;
        let header = MessageHeader { channel_id: queue.id, sequence, log_time, publish_time: log_time };
        writer.write_to_known_channel(&header, &text)?;
        queue.next += 1;
    }
}

/// What the file says of a channel beyond its samples.
fn about(recording: &Recording, channel: &Channel) -> BTreeMap<String, String> {
    let mut about = vec![
        ("signal", channel.name().to_owned()),
        ("unit", channel.unit().symbol().to_owned()),
        ("column", channel.column().to_owned()),
        ("clock", channel.clock().to_string()),
    ];
    about.extend(recording.clocks().get(channel.clock()).map(|clock| ("clock_name", clock.name.clone())));
    about.extend(described::clock_rate(recording, channel.clock()));
    about.extend(described::attributes(channel));
    about.into_iter().map(|(key, value)| (key.to_owned(), value)).collect()
}
