//! Signals of a robot file's columns from the messages of a bag: `/joint_states.position[left_wheel]` is a field of a topic.

use std::collections::BTreeMap;
use std::fs::File;

use anyhow::{Context, Result, bail, ensure};
use nalgebra::{Quaternion, UnitQuaternion};
use odometry::file::{Series, Signals};
use recordings::{Cell, FieldError, FieldReader, HEADER_STAMP, LOG_TIME, Message, messages};

use crate::envelope::SourceFile;

/// Columns of a robot file that name fields of topics.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Wanted<'a> {
    /// The robot, for messages.
    pub(crate) robot: &'a str,
    /// What the file calls the time: `header.stamp` or `log_time`.
    pub(crate) time: &'a str,
    /// The columns.
    pub(crate) columns: &'a [&'a str],
    /// The one whose field may be a quaternion, whose turn about the vertical is meant.
    pub(crate) yaw: Option<&'a str>,
}

/// What a bag holds of them.
#[derive(Debug, Default)]
pub(crate) struct Found {
    /// Signals by column, s since the first message; a topic that was not recorded gives none.
    pub(crate) signals: Signals,
    /// What was done or lost, in sentences.
    pub(crate) told: Vec<String>,
    /// Files of the bag.
    pub(crate) files: Vec<SourceFile>,
}

impl Found {
    /// Why these signals make no drive, with what was lost of them.
    pub(crate) fn explained(&self, error: anyhow::Error) -> anyhow::Error {
        if self.told.is_empty() { error } else { error.context(self.told.join("; ")) }
    }
}

/// Topic and field of a column, where it names them: topics begin with a slash and have no dot.
pub(crate) fn topic_and_field(column: &str) -> Option<(&str, &str)> {
    column.split_once('.').filter(|(topic, field)| topic.starts_with('/') && !field.is_empty())
}

/// The columns of a bag, whose parts follow each other.
///
/// # Errors
/// Columns that name no fields, a file that cannot be read, fields that messages do not have, and a bag with none of the topics.
pub(crate) fn signals((name, bag): (&str, &[String]), wanted: &Wanted<'_>) -> Result<Found> {
    let Wanted { robot, time, columns, .. } = *wanted;
    let command = format!("lacuna check {} --robot {robot}", bag.first().map_or("", String::as_str));
    let advice =
        format!("`{command} --write-mapping FILE` proposes them, and `{command} --fields` lists what there is");
    if let Some(column) = columns.iter().find(|column| topic_and_field(column).is_none()) {
        bail!(
            "recording '{name}' is a bag, and robot '{robot}' names '{column}', which is a column of a table; name fields of topics, \
             such as /joint_states.position[left_wheel]: {advice}"
        );
    }
    ensure!(
        [HEADER_STAMP, LOG_TIME].contains(&time),
        "recording '{name}' is a bag, and robot '{robot}' takes the time from '{time}'; write time = \"{HEADER_STAMP}\" or \
         time = \"{LOG_TIME}\" under [columns]"
    );

    let mut topics: BTreeMap<&str, Topic<'_>> = BTreeMap::new();
    for column in columns {
        if let Some((topic, field)) = topic_and_field(column) {
            topics.entry(topic).or_default().fields.push((column, field, wanted.yaw == Some(column)));
        }
    }
    let mut found = Found::default();
    let mut known: Vec<String> = Vec::new();
    for file in bag {
        let mut source = File::open(file).with_context(|| format!("cannot read '{file}'"))?;
        for topic in topics.values_mut() {
            topic.reader = None;
        }
        let passed = messages(file, &mut source, &mut |message| -> Result<()> {
            match topics.get_mut(message.topic.name.as_str()) {
                Some(topic) => {
                    topic.take(&message, time).with_context(|| format!("recording '{name}', robot '{robot}'"))
                }
                None => Ok(()),
            }
        })?;
        known.extend(passed.topics.into_iter().map(|topic| topic.name));
        found.told.extend(passed.losses.iter().map(ToString::to_string));
        found.files.push(SourceFile { name: file.clone(), bytes: passed.bytes as usize, sha256: passed.sha256 });
    }
    known.sort();
    known.dedup();
    ensure!(
        topics.values().any(Topic::is_there),
        "recording '{name}' has none of the topics that robot '{robot}' names ({}); topics with messages are: {}; {advice}",
        topics.keys().copied().collect::<Vec<_>>().join(", "),
        known.join(", ")
    );

    let start = topics.values().filter_map(|topic| topic.rows.first()).map(|row| row.0).min().unwrap_or_default();
    for (topic, read) in topics {
        read.tell(name, topic, &mut found.told);
        read.finish(start, &mut found.signals);
    }
    Ok(found)
}

/// A topic of which fields are wanted.
#[derive(Default)]
struct Topic<'a> {
    /// Column, field, and whether the field is a heading.
    fields: Vec<(&'a str, &'a str, bool)>,
    reader: Option<Reader>,
    /// Time, ns, and the fields of each message.
    rows: Vec<(i128, Vec<f64>)>,
    cells: Vec<Cell>,
    unstamped: bool,
    bad: usize,
    backwards: usize,
    zero: usize,
}

/// How the messages of a topic are read.
struct Reader {
    fields: FieldReader,
    /// Which fields are quaternions.
    turned: Vec<bool>,
    stamped: bool,
}

impl Topic<'_> {
    /// Whether a message was met, of use or not.
    fn is_there(&self) -> bool {
        !self.rows.is_empty() || self.zero + self.bad > 0
    }

    fn take(&mut self, message: &Message<'_>, time: &str) -> Result<()> {
        if self.reader.is_none() {
            self.reader = Some(self.reader_of(message, time)?);
        }
        let Some(reader) = &self.reader else { return Ok(()) };
        if reader.fields.read_into(message.bytes, &mut self.cells).is_none() {
            self.bad += 1;
            return Ok(());
        }
        let stamp = match self.cells.first() {
            Some(Cell::Whole(stamp)) if reader.stamped => *stamp,
            _ => message.log_time_ns.into(),
        };
        if stamp == 0 {
            self.zero += 1;
            return Ok(());
        }
        let mut cells =
            self.cells.iter().skip(usize::from(reader.stamped)).map(|cell| cell.number().unwrap_or(f64::NAN));
        let mut next = || cells.next().unwrap_or(f64::NAN);
        let values: Vec<f64> = { reader.turned.iter() }
            .map(|turned| {
                let first = next();
                if *turned { heading([first, next(), next(), next()]) } else { first }
            })
            .collect();
        if values.iter().any(|value| !value.is_finite()) {
            self.bad += 1;
        } else if self.rows.last().is_some_and(|(last, _)| stamp <= *last) {
            self.backwards += 1;
        } else {
            self.rows.push((stamp, values));
        }
        Ok(())
    }

    /// A reader of the wanted fields, with the stamp before them.
    fn reader_of(&mut self, message: &Message<'_>, time: &str) -> Result<Reader> {
        let stamped = time == HEADER_STAMP && FieldReader::new(message.topic, &[HEADER_STAMP]).is_ok();
        self.unstamped = time == HEADER_STAMP && !stamped;
        let parts = |field: &str| ["x", "y", "z", "w"].map(|part| format!("{field}.{part}"));
        let is_turned = |field: &str| {
            let parts = parts(field);
            FieldReader::new(message.topic, &parts.each_ref().map(String::as_str)).is_ok()
        };
        let turned: Vec<bool> = self.fields.iter().map(|(_, field, yaw)| *yaw && is_turned(field)).collect();
        let mut paths: Vec<String> = if stamped { vec![HEADER_STAMP.to_owned()] } else { Vec::new() };
        for ((_, field, _), turned) in self.fields.iter().zip(&turned) {
            if *turned { paths.extend(parts(field)) } else { paths.push((*field).to_owned()) }
        }
        let paths: Vec<&str> = paths.iter().map(String::as_str).collect();
        let topic = &message.topic.name;
        match FieldReader::new(message.topic, &paths) {
            Ok(fields) => Ok(Reader { fields, turned, stamped }),
            Err(FieldError::Field { field, message, .. }) => {
                bail!("topic `{topic}`, field `{field}`: {message}; correct [columns] of the robot file")
            }
            Err(other) => bail!("topic `{topic}`: {other}"),
        }
    }

    fn tell(&self, name: &str, topic: &str, told: &mut Vec<String>) {
        let mut tell = |what: String| told.push(format!("recording '{name}', topic {topic}: {what}"));
        if self.unstamped && !self.rows.is_empty() {
            tell("its messages have no header; the times at which they were logged were taken".to_owned());
        }
        if !self.is_there() {
            tell("no message of it is there".to_owned());
        }
        for (count, what) in [
            (self.zero, "have a header.stamp of 0, which the driver does not set; take time = \"log_time\""),
            (self.backwards, "are not later than the one before them"),
            (self.bad, "do not decode, or lack a value"),
        ] {
            if count > 0 {
                tell(format!("{count} messages {what}; they were left out"));
            }
        }
    }

    fn finish(self, start: i128, signals: &mut Signals) {
        /// Seconds in a nanosecond.
        const NANO: f64 = 1e-9;
        if self.rows.is_empty() {
            return;
        }
        let time: Vec<f64> = self.rows.iter().map(|row| (row.0 - start) as f64 * NANO).collect();
        for (k, (column, _, _)) in self.fields.iter().enumerate() {
            let value = self.rows.iter().map(|row| row.1[k]).collect();
            signals.insert((*column).to_owned(), Series { time: time.clone(), value });
        }
    }
}

/// Turn about the vertical of a quaternion x, y, z, w, rad; NaN of one that is none.
fn heading([x, y, z, w]: [f64; 4]) -> f64 {
    let quaternion = Quaternion::new(w, x, y, z);
    match UnitQuaternion::try_new(quaternion, f64::EPSILON) {
        Some(turn) => turn.euler_angles().2,
        None => f64::NAN,
    }
}
