//! What is inside a bag, before anybody has said what it means.

use crate::bag::{Passed, ReadSeek, Topic, messages};
use crate::error::RecordingError;
use crate::fields::{Field, Survey};
use crate::header_stamps::{HeaderStamps, StampMeter};
use crate::loss::Loss;

/// What is inside a bag.
#[derive(Debug, Clone, PartialEq)]
pub struct Contents {
    /// Its topics that hold messages, in the order in which they were first met.
    pub topics: Vec<TopicContents>,
    /// What could not be read.
    pub losses: Vec<Loss>,
    /// Messages that no checksum of the file covers: changed bytes in them would not show.
    pub unchecked: u64,
    /// Length of the file in bytes.
    pub bytes: u64,
    /// SHA-256 of the file, 64 hexadecimal digits.
    pub sha256: String,
}

/// What is inside a topic.
#[derive(Debug, Clone, PartialEq)]
pub struct TopicContents {
    /// Its name.
    pub name: String,
    /// The type of its messages.
    pub message_type: String,
    /// How messages are encoded.
    pub encoding: String,
    /// How many there are.
    pub count: u64,
    /// How many of them do not decode by their schema.
    pub undecodable: u64,
    /// Earliest and latest log time in ns.
    pub log_time_ns: (i64, i64),
    /// Its header stamps against the log times; `None` where messages have none.
    pub stamps: Option<HeaderStamps>,
    /// The numeric fields, or why messages cannot be decoded.
    pub fields: Result<Vec<Field>, String>,
}

/// What a topic showed so far.
struct Seen {
    survey: Survey,
    count: u64,
    log_time_ns: (i64, i64),
    stamps: StampMeter,
}

impl Seen {
    fn new(topic: &Topic, now_ns: i64) -> Self {
        let (survey, stamps) = (Survey::new(topic), StampMeter::new(topic));
        Self { survey, count: 0, log_time_ns: (now_ns, now_ns), stamps }
    }
}

/// Passes over a bag and tells what is inside: topics, times and the fields that a mapping can name.
///
/// # Errors
/// When the source fails, and when the file is no bag or too large for a format that is read whole.
pub fn contents(name: &str, source: &mut dyn ReadSeek) -> Result<Contents, RecordingError> {
    let mut seen: Vec<Seen> = Vec::new();
    let Passed { topics, losses, unchecked, bytes, sha256 } = messages(name, source, &mut |message| {
        let now = message.log_time_ns;
        // sqlite knows topics without messages, so that an index may lie beyond the next one.
        while seen.len() <= message.topic_index {
            seen.push(Seen::new(message.topic, now));
        }
        let topic = &mut seen[message.topic_index];
        if topic.count == 0 {
            *topic = Seen::new(message.topic, now);
        }
        topic.count += 1;
        topic.log_time_ns = (topic.log_time_ns.0.min(now), topic.log_time_ns.1.max(now));
        topic.survey.look(message.bytes);
        topic.stamps.look(&message);
        Ok(())
    })?;
    let topics = topics.into_iter().zip(seen).filter(|(_, seen)| seen.count > 0).map(|(topic, seen)| TopicContents {
        name: topic.name,
        message_type: topic.message_type,
        encoding: topic.encoding,
        count: seen.count,
        undecodable: seen.survey.undecodable,
        log_time_ns: seen.log_time_ns,
        stamps: seen.stamps.finish(),
        fields: seen.survey.finish(),
    });
    Ok(Contents { topics: topics.collect(), losses, unchecked, bytes, sha256 })
}
