//! What is inside a bag, before anybody has said what it means.

use std::io::{Read, Seek, SeekFrom};

use crate::error::FileError;
use crate::fields::{Field, Survey};
use crate::header_stamps::{HeaderStamps, StampMeter};
use crate::loss::Loss;
use crate::messages::messages;
use crate::source::ReadSeek;
use crate::topic::{Message, Passed, Topic};

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
struct TopicSurvey {
    survey: Survey,
    count: u64,
    log_time_ns: (i64, i64),
    stamps: StampMeter,
}

impl TopicSurvey {
    fn new(topic: &Topic, now_ns: i64) -> Self {
        let (survey, stamps) = (Survey::new(topic), StampMeter::new(topic));
        Self { survey, count: 0, log_time_ns: (now_ns, now_ns), stamps }
    }
}

/// What the messages of a bag that passed so far showed: [`contents`] for who passes over the bag anyway.
#[derive(Default)]
pub struct Inside(Vec<TopicSurvey>);

impl Inside {
    /// Looks at a message.
    pub fn look(&mut self, message: &Message<'_>) {
        let now = message.log_time_ns;
        // sqlite knows topics without messages, so that an index may lie beyond the next one.
        while self.0.len() <= message.topic_index {
            self.0.push(TopicSurvey::new(message.topic, now));
        }
        let topic = &mut self.0[message.topic_index];
        if topic.count == 0 {
            *topic = TopicSurvey::new(message.topic, now);
        }
        topic.count += 1;
        topic.log_time_ns = (topic.log_time_ns.0.min(now), topic.log_time_ns.1.max(now));
        let stamp = topic.survey.look(message.bytes);
        topic.stamps.look(message, stamp);
    }

    /// What is inside the bag that passed.
    pub fn finish(self, passed: &Passed) -> Contents {
        let topics = passed.topics.iter().zip(self.0).filter(|(_, seen)| seen.count > 0);
        let topics = topics.map(|(topic, seen)| TopicContents {
            name: topic.name.clone(),
            message_type: topic.message_type.clone(),
            encoding: topic.encoding.clone(),
            count: seen.count,
            undecodable: seen.survey.undecodable,
            log_time_ns: seen.log_time_ns,
            stamps: seen.stamps.finish(),
            fields: seen.survey.finish(),
        });
        Contents {
            topics: topics.collect(),
            losses: passed.losses.clone(),
            unchecked: passed.unchecked,
            bytes: passed.bytes,
            sha256: passed.sha256.clone(),
        }
    }
}

/// Passes over a bag and tells what is inside: topics, times and the fields that a mapping can name.
///
/// # Errors
/// When the source fails, and when the file is no bag or too large for a format that is read whole.
pub fn contents(name: &str, source: &mut dyn ReadSeek) -> Result<Contents, FileError> {
    let mut inside = Inside::default();
    let passed = messages(name, source, &mut |message| {
        inside.look(&message);
        Ok::<(), FileError>(())
    })?;
    Ok(inside.finish(&passed))
}

/// As [`contents`], of a file that ends after `most` bytes: enough to guess what the rest holds. Of a longer file, losses,
/// counts, length and checksum are those of its beginning, which was cut off.
///
/// # Errors
/// As [`contents`]; a longer file need not be damaged where its beginning cannot be read alone.
pub fn contents_of_beginning(name: &str, source: &mut dyn ReadSeek, most: u64) -> Result<Contents, FileError> {
    contents(name, &mut Beginning { source, most, at: 0 })
}

/// The first bytes of a source, as if there were no more.
struct Beginning<'a> {
    source: &'a mut dyn ReadSeek,
    most: u64,
    at: u64,
}

impl Read for Beginning<'_> {
    fn read(&mut self, into: &mut [u8]) -> std::io::Result<usize> {
        let got = (&mut *self.source).take(self.most.saturating_sub(self.at)).read(into)?;
        self.at += got as u64;
        Ok(got)
    }
}

impl Seek for Beginning<'_> {
    fn seek(&mut self, to: SeekFrom) -> std::io::Result<u64> {
        let to = if let SeekFrom::End(by) = to {
            let end = self.source.seek(SeekFrom::End(0))?.min(self.most);
            SeekFrom::Start(end.checked_add_signed(by).ok_or(std::io::ErrorKind::InvalidInput)?)
        } else {
            to
        };
        self.at = self.source.seek(to)?;
        Ok(self.at)
    }
}
