//! Records of an MCAP file become topics and messages.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::sync::Arc;

use mcap::records::{Channel, Record, SchemaHeader, op};

use crate::loss::{Ledger, LossKind};
use crate::source::LARGEST_RECORD;
use crate::topic::{Message, Sink, Topic};

/// What schema and channel records have told so far.
#[derive(Default)]
struct Described {
    schemas: HashMap<u16, (SchemaHeader, Arc<[u8]>)>,
    channels: HashMap<u16, Channel>,
    /// Bytes of all records taken.
    bytes: usize,
}

impl Described {
    /// Takes a schema or channel record, the first of each number; false when it does not parse, or when there is more
    /// of them than is held in memory.
    fn take(&mut self, kind: u8, content: &[u8]) -> bool {
        if self.bytes + content.len() > LARGEST_RECORD {
            return false;
        }
        match mcap::parse_record(kind, content) {
            Ok(Record::Schema { header, data }) => {
                if let Entry::Vacant(new) = self.schemas.entry(header.id) {
                    self.bytes += content.len();
                    new.insert((header, data.as_ref().into()));
                }
            }
            Ok(Record::Channel(channel)) => {
                if let Entry::Vacant(new) = self.channels.entry(channel.id) {
                    self.bytes += content.len();
                    new.insert(channel);
                }
            }
            _ => return false,
        }
        true
    }
}

/// A message record, of which there are too many to have the library read them.
struct MessageRecord<'a> {
    channel: u16,
    log_time: u64,
    data: &'a [u8],
}

impl<'a> MessageRecord<'a> {
    /// Channel, sequence, log time and publish time, then the message; `None` when the content is too short.
    fn of(content: &'a [u8]) -> Option<Self> {
        let (channel, rest) = content.split_first_chunk()?;
        let (_sequence, rest) = rest.split_first_chunk::<4>()?;
        let (log_time, rest) = rest.split_first_chunk()?;
        let (_publish_time, data) = rest.split_first_chunk::<8>()?;
        Some(Self { channel: u16::from_le_bytes(*channel), log_time: u64::from_le_bytes(*log_time), data })
    }
}

/// Where a record stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Where {
    /// In a chunk, whose checksum was right.
    Chunk,
    /// Outside, in a file that keeps its messages in chunks.
    OutsideChunks,
    /// In a file without chunks.
    Unchunked,
}

/// The records of a file as they pass.
#[derive(Default)]
pub(super) struct Records {
    /// What chunks said, what the summary says, and what stands outside of both: in the order of trust.
    described: [Described; 3],
    pub(super) topics: Vec<Topic>,
    /// Topic of each channel that was met, by the channel's number.
    topic_of: Vec<Option<usize>>,
    /// Messages met, those given on and those that could not be.
    pub(super) met: u64,
}

impl Records {
    /// No record yet; the summary's descriptions serve where the data's are lost.
    pub(super) fn new(summary: &[(u8, Vec<u8>)]) -> Self {
        let mut records = Self::default();
        for (kind, content) in summary {
            records.described[1].take(*kind, content);
        }
        records
    }

    /// Takes a schema, channel or message record that starts at `byte`; others do not matter here.
    pub(super) fn take<E>(
        &mut self,
        kind: u8,
        content: &[u8],
        (place, byte): (Where, u64),
        each: &mut Sink<'_, E>,
        ledger: &mut Ledger<'_>,
    ) -> Result<(), E> {
        match kind {
            op::SCHEMA | op::CHANNEL => {
                let trust = if place == Where::Chunk { 0 } else { 2 };
                if !self.described[trust].take(kind, content) {
                    ledger.add(LossKind::Damage, None, || Some(byte));
                }
                Ok(())
            }
            // No checksum covers it, and no writer mixes: a record whose kind is damaged looks like this.
            op::MESSAGE if place == Where::OutsideChunks => {
                ledger.add(LossKind::StrayMessage, None, || Some(byte));
                Ok(())
            }
            op::MESSAGE => self.message(content, byte, each, ledger),
            _ => Ok(()),
        }
    }

    fn message<E>(
        &mut self,
        content: &[u8],
        byte: u64,
        each: &mut Sink<'_, E>,
        ledger: &mut Ledger<'_>,
    ) -> Result<(), E> {
        let Some(MessageRecord { channel, log_time, data }) = MessageRecord::of(content) else {
            ledger.add(LossKind::Damage, None, || Some(byte));
            return Ok(());
        };
        self.met += 1;
        let Some(topic_index) = self.index_of(channel) else {
            ledger.add(LossKind::UnknownTopic, None, || Some(byte));
            return Ok(());
        };
        let Ok(log_time_ns) = i64::try_from(log_time) else {
            ledger.add(LossKind::BadMessage, None, || Some(byte));
            return Ok(());
        };
        each(Message { topic_index, topic: &self.topics[topic_index], log_time_ns, bytes: data })
    }

    fn index_of(&mut self, channel: u16) -> Option<usize> {
        let place = usize::from(channel);
        if let Some(&Some(index)) = self.topic_of.get(place) {
            return Some(index);
        }
        let topic = self.topic(channel)?;
        // Two channels may carry one topic.
        let index = self.topics.iter().position(|other| other.is_same(&topic)).unwrap_or_else(|| {
            self.topics.push(topic);
            self.topics.len() - 1
        });
        if self.topic_of.len() <= place {
            self.topic_of.resize(place + 1, None);
        }
        self.topic_of[place] = Some(index);
        Some(index)
    }

    fn topic(&self, id: u16) -> Option<Topic> {
        let channel = self.described.iter().find_map(|described| described.channels.get(&id))?;
        let schema = self.described.iter().find_map(|described| described.schemas.get(&channel.schema_id));
        let schema = schema.filter(|_| channel.schema_id != 0);
        if schema.is_none() && channel.schema_id != 0 {
            return None;
        }
        let (message_type, schema_encoding) =
            schema.map(|(header, _)| (header.name.clone(), header.encoding.clone())).unwrap_or_default();
        Some(Topic {
            name: channel.topic.clone(),
            message_type,
            encoding: channel.message_encoding.clone(),
            schema_encoding,
            schema: schema.map(|(_, data)| Arc::clone(data)).unwrap_or_default(),
            metadata: channel.metadata.clone(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_record_is_what_the_library_reads() {
        let content: Vec<u8> = (1..40).collect();
        for length in 0..content.len() {
            let content = &content[..length];
            let ours = MessageRecord::of(content).map(|m| (m.channel, m.log_time, m.data.to_vec()));
            let theirs = match mcap::parse_record(op::MESSAGE, content) {
                Ok(Record::Message { header, data }) => Some((header.channel_id, header.log_time, data.into_owned())),
                _ => None,
            };
            assert_eq!(ours, theirs, "{length}");
        }
    }
}
