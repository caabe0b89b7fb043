//! The bags of one run against the entries of a mapping that name topics: messages become samples.

use std::collections::BTreeMap;

use bags::{
    Cell, Contents, FieldError, FieldReader, Inside, LOG_TIME, Loss, LossKind, Message, Passed, Place, Topic, in_words,
    messages, suggest,
};

use crate::cell::CellError;
use crate::column::{Column, Keep};
use crate::described::Described;
use crate::error::RecordingError;
use crate::input::{Opened, Policy};
use crate::mapping::FileMapping;
use crate::row::{self, Row};
use crate::samples::{PlacedColumn, Samples};

/// One topic that is wanted.
struct Wanted<'a, K> {
    file: &'a FileMapping,
    topic: &'a str,
    samples: Option<Samples<'a, K>>,
    /// What each topic of the current bag is to this one, by its index.
    topics: Vec<Met>,
    /// The fields of the last message.
    cells: Vec<Cell>,
    /// The fields that the messages have: all but optional ones.
    kept: Vec<&'a str>,
    /// Messages met, over all parts.
    met: u64,
    /// What the topic says of itself.
    about: BTreeMap<String, String>,
}

/// What a topic of a bag is to a wanted one.
enum Met {
    NotYet,
    Another,
    Wanted(TopicReader),
}

/// Reads the wanted fields of one topic of one bag.
struct TopicReader {
    reader: FieldReader,
    /// The time is the log's, put behind the fields.
    log_time: bool,
}

/// What the bags of a run hold.
pub(crate) struct Bags<K> {
    /// The columns of each entry, with what the file says of them where the mapping asks for it.
    pub(crate) columns: Vec<Vec<(Column<K>, Option<Described>)>>,
    /// What each part is, in their order.
    pub(crate) parts: Vec<Passed>,
    /// What is inside each part, where that was asked for.
    pub(crate) contents: Vec<Contents>,
    /// What could not be read of messages.
    pub(crate) losses: Vec<Loss>,
}

/// Reads the parts of a bag, in their order, against entries that name topics; columns of entry `i` are on clock
/// `clocks[i]`. With `look_inside` the same pass tells what is inside.
pub(crate) fn read_bags<'a, 'n: 'a, K: Keep>(
    (keep, look_inside): (&K, bool),
    mapping: &str,
    parts: &mut [&mut Opened<'n>],
    entries: &[&'a FileMapping],
    clocks: &[usize],
    policy: Policy,
) -> Result<Bags<K::Kept>, RecordingError> {
    let mut wanted: Vec<Wanted<'a, K>> = entries
        .iter()
        .filter_map(|file| {
            let topic = file.topic.as_deref()?;
            let (topics, cells, kept, about) = (Vec::new(), Vec::new(), Vec::new(), BTreeMap::new());
            Some(Wanted { file, topic, samples: None, topics, cells, kept, met: 0, about })
        })
        .collect();
    let (mut passed, mut contents) = (Vec::new(), Vec::new());
    for part in parts.iter_mut() {
        let name = part.name;
        for wanted in &mut wanted {
            wanted.topics.clear();
        }
        let mut inside = look_inside.then(Inside::default);
        let pass = messages(name, &mut *part.source, &mut |message| {
            if let Some(inside) = &mut inside {
                inside.look(&message);
            }
            wanted.iter_mut().try_for_each(|wanted| wanted.take(keep, name, &message, policy))
        })?;
        contents.extend(inside.map(|inside| inside.finish(&pass)));
        if policy == Policy::Strict && !pass.losses.is_empty() {
            return Err(RecordingError::Lost(in_words(&pass.losses)));
        }
        passed.push(pass);
    }
    let name = parts.first().map_or("", |part| part.name);
    // A bag that has others of the topics is the right one, and one of them was not recorded: a loss, as a missing file is.
    let rest_is_there = policy != Policy::Strict && wanted.iter().any(|wanted| wanted.samples.is_some());
    let (mut columns, mut losses) = (Vec::new(), Vec::new());
    for (wanted, &clock) in wanted.into_iter().zip(clocks) {
        columns.push(if let Some(samples) = wanted.samples {
            let (describing, about) = (wanted.file.self_describing, wanted.about);
            let describe = |column: Column<K::Kept>| {
                let say = |key: &str| about.get(key).filter(|_| describing).map(String::as_str);
                let said = Described::read(column.signal.name(), say);
                (column, said)
            };
            samples.finish(clock, &mut losses)?.into_iter().map(describe).collect()
        } else {
            losses.extend(missing(name, wanted.file, wanted.topic, mapping, &passed, rest_is_there)?);
            Vec::new()
        });
    }
    if columns.iter().all(Vec::is_empty) {
        let losses: Vec<String> = passed.iter().flat_map(|pass| &pass.losses).map(ToString::to_string).collect();
        let losses =
            if losses.is_empty() { "none of the mapped topics is there".to_owned() } else { losses.join("; ") };
        return Err(RecordingError::NoSamples { file: name.to_owned(), losses });
    }
    Ok(Bags { columns, parts: passed, contents, losses })
}

/// What to say of a topic without a message: nothing where it may be missing, a loss where the bag is damaged, or where
/// it holds others of the topics and none with a similar name; else an error.
fn missing(
    file: &str,
    entry: &FileMapping,
    topic: &str,
    mapping: &str,
    passed: &[Passed],
    rest_is_there: bool,
) -> Result<Option<Loss>, RecordingError> {
    if entry.columns.iter().all(|column| column.optional) {
        return Ok(None);
    }
    let mut known: Vec<&str> = passed.iter().flat_map(|pass| &pass.topics).map(|topic| topic.name.as_str()).collect();
    known.sort_unstable();
    known.dedup();
    // A name that is nearly there is a slip of the pen in the mapping, not a topic that was not recorded.
    let not_recorded = rest_is_there && suggest::nearest(topic, known.iter().copied()).is_none();
    if not_recorded || passed.iter().any(|pass| !pass.losses.is_empty()) {
        let (kind, file, column) = (LossKind::EmptyTopic, file.to_owned(), Some(topic.to_owned()));
        return Ok(Some(Loss { kind, file, column, place: Place::Message, lines: Vec::new(), count: 1 }));
    }
    let hint = suggest::hint(topic, &known).replacen("known are:", "topics with messages are:", 1);
    let (file, topic, mapping) = (file.to_owned(), topic.to_owned(), mapping.to_owned());
    Err(RecordingError::MissingTopic { file, topic, mapping, hint })
}

/// True for a topic that this crate wrote; others may have the name of a signal, and any unit.
fn describes(topic: &Topic) -> bool {
    topic.metadata.contains_key("signal") && topic.message_type == crate::write_mcap::SCHEMA_NAME
}

impl<'a, K: Keep> Wanted<'a, K> {
    fn take(&mut self, keep: &K, name: &'a str, message: &Message<'_>, policy: Policy) -> Result<(), RecordingError> {
        if self.topics.len() <= message.topic_index {
            self.topics.resize_with(message.topic_index + 1, || Met::NotYet);
        }
        if matches!(self.topics[message.topic_index], Met::NotYet) {
            let wanted = message.topic.name == self.topic && (!self.file.self_describing || describes(message.topic));
            self.topics[message.topic_index] =
                if wanted { Met::Wanted(self.reader(keep, name, message, policy)?) } else { Met::Another };
        }
        let (Met::Wanted(reader), Some(samples)) = (&self.topics[message.topic_index], &mut self.samples) else {
            return Ok(());
        };
        self.met += 1;
        let number = self.met;
        if reader.reader.read_into(message.bytes, &mut self.cells).is_none() {
            let error = || {
                let topic = self.topic;
                RecordingError::Lost(format!("{name}: message {number} of `{topic}` does not decode by its schema"))
            };
            return samples.lose_row(LossKind::BadMessage, || number, error);
        }
        if reader.log_time {
            self.cells.push(Cell::Whole(message.log_time_ns.into()));
        }
        samples.take(&MessageRow { cells: &self.cells, number }, number - 1)
    }

    /// The reader of the topic of this message: the mapped fields, then the time.
    fn reader(
        &mut self,
        keep: &K,
        name: &'a str,
        message: &Message<'_>,
        policy: Policy,
    ) -> Result<TopicReader, RecordingError> {
        let time = self.file.time.column.as_deref().unwrap_or(LOG_TIME);
        let log_time = time == LOG_TIME;
        let mut columns: Vec<_> = self.file.columns.iter().collect();
        let reader = loop {
            let mut fields: Vec<&str> = columns.iter().map(|column| column.column.as_str()).collect();
            fields.extend((!log_time).then_some(time));
            match FieldReader::new(message.topic, &fields) {
                Ok(reader) => break reader,
                Err(FieldError::Field { index, .. }) if columns.get(index).is_some_and(|column| column.optional) => {
                    columns.remove(index);
                }
                Err(FieldError::Field { field, message, .. }) => {
                    let topic = self.topic.to_owned();
                    return Err(RecordingError::BadField { file: name.to_owned(), topic, field, message });
                }
                Err(trouble) => {
                    let (topic, message_type) = (self.topic.to_owned(), message.topic.message_type.clone());
                    let message = trouble.to_string();
                    return Err(RecordingError::BadTopic { file: name.to_owned(), topic, message_type, message });
                }
            }
        };
        let time_at = columns.len();
        let kept: Vec<&str> = columns.iter().map(|column| column.column.as_str()).collect();
        if self.samples.is_some() && self.kept != kept {
            let what = "messages of another type, without some of the fields, follow on this topic".to_owned();
            let (topic, message_type) = (self.topic.to_owned(), message.topic.message_type.clone());
            return Err(RecordingError::BadTopic { file: name.to_owned(), topic, message_type, message: what });
        }
        self.kept = kept;
        let found = columns.iter().enumerate().map(|(position, mapped)| PlacedColumn { position, mapped }).collect();
        if self.samples.is_none() {
            self.about.clone_from(&message.topic.metadata);
            let time = (&self.file.time, Some(time_at));
            let samples = Samples::new(keep, name, Place::Message, policy, time, found);
            self.samples = Some(samples.of_topic(self.topic));
        }
        Ok(TopicReader { reader, log_time })
    }
}

/// One message as a row: its fields in the order in which they were asked for.
struct MessageRow<'a> {
    cells: &'a [Cell],
    /// Number of the message in its topic, from 1.
    number: u64,
}

impl Row for MessageRow<'_> {
    fn number(&self, position: usize) -> Result<Option<f64>, CellError> {
        row::number(self.cells[position])
    }

    fn instant_ns(&self, position: usize, ns_per_unit: i64) -> Result<Option<i64>, CellError> {
        row::instant_ns(self.cells[position], ns_per_unit)
    }

    fn text(&self, position: usize) -> String {
        match self.cells[position] {
            Cell::Gap => String::new(),
            Cell::Real(value) => value.to_string(),
            Cell::Whole(value) => value.to_string(),
        }
    }

    fn place(&self) -> u64 {
        self.number
    }
}
