//! rosbag2's sqlite3 files. The whole file is in memory: sqlite reads files or memory, and files are not opened here.

use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

use rusqlite::{Connection, Row};

use crate::error::FileError;
use crate::loss::{Ledger, LossKind};
use crate::place::Place;
use crate::topic::{Message, Passed, Sink, Topic};

/// Bytes 18 and 19 of the header: 2 for a write-ahead log, which memory has not; 1 for none.
const VERSIONS: std::ops::Range<usize> = 18..20;
/// The header's number of pages.
const PAGES: std::ops::Range<usize> = 28..32;

/// Gives every message that sqlite can read to `each`, in the order in which they were recorded.
pub(crate) fn pass<E: From<FileError>>(name: &str, bytes: Vec<u8>, each: &mut Sink<'_, E>) -> Result<Passed, E> {
    let refuse = |error: rusqlite::Error| {
        let message = format!("{error}; if the recorder was killed, open and close the bag with sqlite3 first");
        FileError::NotReadable { file: name.to_owned(), format: "rosbag2 sqlite3", message }
    };
    let (length, cut) = (bytes.len() as u64, is_cut(&bytes));
    let connection = open(bytes).map_err(refuse)?;
    let (index, topics) = topics(&connection).map_err(refuse)?;
    let ledger = Ledger::new(name, Place::Message);
    let mut bag = Bag { connection: &connection, index, topics: &topics, ledger, given: 0, each };
    if cut {
        bag.ledger.add(LossKind::CutOff, None, || None);
    }
    bag.pass()?;
    let (losses, unchecked) = (bag.ledger.into_losses(), bag.given);
    Ok(Passed { topics, losses, unchecked, bytes: length, sha256: String::new() })
}

fn open(mut bytes: Vec<u8>) -> rusqlite::Result<Connection> {
    // Of a page that is cut, sqlite would take the missing part for zeros.
    bytes.truncate(bytes.len() - bytes.len() % page_size(&bytes));
    if let Some(versions) = bytes.get_mut(VERSIONS) {
        versions.fill(1);
    }
    // sqlite refuses a file with fewer pages than it says; what it can reach of a shorter one is worth having.
    let there = u32::try_from(bytes.len() / page_size(&bytes)).unwrap_or(u32::MAX);
    if let Some(said) = bytes.get_mut(PAGES).filter(|said| number(said) > u64::from(there)) {
        said.copy_from_slice(&there.to_be_bytes());
    }
    let mut connection = Connection::open_in_memory()?;
    connection.deserialize_read_exact("main", bytes.as_slice(), bytes.len(), true)?;
    Ok(connection)
}

/// Whether the file is shorter than its header says: sqlite does not mind as long as it meets no missing page.
fn is_cut(bytes: &[u8]) -> bool {
    let page = page_size(bytes);
    let said = bytes.get(PAGES).map_or(u64::MAX, number);
    let there = (bytes.len() / page) as u64;
    there < said || !bytes.len().is_multiple_of(page)
}

/// Bytes of a page, as the header says.
fn page_size(bytes: &[u8]) -> usize {
    match bytes.get(16..18).map_or(0, number) {
        // What 16 bits cannot hold.
        1 => 65_536,
        size => size.max(512) as usize,
    }
}

fn number(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0, |sum, &byte| sum * 256 + u64::from(byte))
}

/// Topics by their row id, and in order.
fn topics(connection: &Connection) -> rusqlite::Result<(HashMap<i64, usize>, Vec<Topic>)> {
    let schemas = schemas(connection).unwrap_or_default();
    let mut statement = connection.prepare("SELECT id, name, type, serialization_format FROM topics ORDER BY id")?;
    let (mut index, mut topics) = (HashMap::new(), Vec::new());
    let mut rows = statement.query([])?;
    while let Some(row) = rows.next()? {
        let (id, name, message_type): (i64, String, String) = (row.get(0)?, row.get(1)?, row.get(2)?);
        let (schema_encoding, schema) = schemas.get(&message_type).cloned().unwrap_or_default();
        index.insert(id, topics.len());
        let (encoding, metadata) = (row.get(3)?, BTreeMap::new());
        topics.push(Topic { name, message_type, encoding, schema_encoding, schema, metadata });
    }
    Ok((index, topics))
}

/// Encoding and text of each type's definition.
type Schemas = HashMap<String, (String, Arc<[u8]>)>;

/// The definitions, which bags have since ROS 2 Iron.
fn schemas(connection: &Connection) -> rusqlite::Result<Schemas> {
    let query = "SELECT topic_type, encoding, encoded_message_definition FROM message_definitions";
    let mut statement = connection.prepare(query)?;
    let rows = statement.query_map([], |row| {
        let text: String = row.get(2)?;
        Ok((row.get(0)?, (row.get(1)?, text.into_bytes().into())))
    })?;
    rows.collect()
}

struct Bag<'a, 's, E> {
    connection: &'a Connection,
    index: HashMap<i64, usize>,
    topics: &'a [Topic],
    ledger: Ledger<'a>,
    /// Messages given on.
    given: u64,
    each: &'s mut Sink<'s, E>,
}

/// Where a scan of the messages ended.
enum End {
    /// After the last one.
    Whole,
    /// sqlite could not go on behind this id.
    Broken(i64),
}

impl<E> Bag<'_, '_, E> {
    fn pass(&mut self) -> Result<(), E> {
        if let End::Broken(last) = self.scan(i64::MIN)? {
            let broken_at = |id: i64| u64::try_from(id).ok().map(|id| id.saturating_add(1));
            self.ledger.add(LossKind::Damage, None, || broken_at(last));
            // The far side of the damage, found from the other end.
            if let Some(first) = self.first_after(last) {
                let missing = u64::try_from(first.saturating_sub(last).saturating_sub(1)).unwrap_or(0);
                if let End::Broken(again) = self.scan(first)? {
                    self.ledger.add(LossKind::Damage, None, || broken_at(again));
                }
                self.ledger.add_many(LossKind::MissingMessage, missing);
            }
        } else if !self.is_sound() {
            self.ledger.add(LossKind::Damage, None, || None);
        }
        Ok(())
    }

    /// Gives the messages from id `first` on to `each`.
    fn scan(&mut self, first: i64) -> Result<End, E> {
        let mut last = first.max(0);
        let query = "SELECT id, topic_id, timestamp, data FROM messages WHERE id >= ? ORDER BY id";
        let Ok(mut statement) = self.connection.prepare(query) else { return Ok(End::Broken(last)) };
        let Ok(mut rows) = statement.query([first]) else { return Ok(End::Broken(last)) };
        loop {
            let row = match rows.next() {
                Ok(Some(row)) => row,
                Ok(None) => return Ok(End::Whole),
                Err(_) => return Ok(End::Broken(last)),
            };
            match fields(row) {
                Ok((id, topic, log_time_ns, bytes)) => {
                    last = id;
                    let Some(&topic_index) = self.index.get(&topic) else {
                        self.ledger.add(LossKind::UnknownTopic, None, || u64::try_from(id).ok());
                        continue;
                    };
                    let topic = &self.topics[topic_index];
                    self.given += 1;
                    (self.each)(Message { topic_index, topic, log_time_ns, bytes })?;
                }
                Err(_) => self.ledger.add(LossKind::BadMessage, None, || u64::try_from(last.saturating_add(1)).ok()),
            }
        }
    }

    /// The smallest id behind `last` that can be reached from the end.
    fn first_after(&self, last: i64) -> Option<i64> {
        let mut statement =
            self.connection.prepare("SELECT id, length(data) FROM messages WHERE id > ? ORDER BY id DESC").ok()?;
        let mut rows = statement.query([last]).ok()?;
        let mut first = None;
        while let Ok(Some(row)) = rows.next() {
            first = row.get(0).ok().or(first);
        }
        first
    }

    /// Whether sqlite finds its own structure in order.
    fn is_sound(&self) -> bool {
        self.connection
            .query_row("PRAGMA quick_check(1)", [], |row| row.get::<_, String>(0))
            .is_ok_and(|answer| answer == "ok")
    }
}

fn fields<'r>(row: &'r Row<'_>) -> rusqlite::Result<(i64, i64, i64, &'r [u8])> {
    let bytes = row.get_ref(3)?.as_blob().map_err(|_| rusqlite::Error::InvalidQuery)?;
    Ok((row.get(0)?, row.get(1)?, row.get(2)?, bytes))
}
