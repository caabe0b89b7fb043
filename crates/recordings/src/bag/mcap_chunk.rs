//! One chunk of an MCAP file: unpacked and checked whole before any of its records counts.

use mcap::sans_io::linear_reader::{LinearReadEvent, LinearReader, LinearReaderOptions};

use super::LARGEST_RECORD;
use super::framing::HEAD;

/// The records of a chunk.
#[derive(Default)]
pub(super) struct Chunk {
    bytes: Vec<u8>,
    /// Kind of each record and where its content ends.
    records: Vec<(u8, usize)>,
    /// Bytes that the chunk's record should have, head included.
    pub(super) length: u64,
    /// The chunk carries a checksum.
    pub(super) checked: bool,
}

impl Chunk {
    /// Unpacks the record `record` (head included), replacing what was here; false when anything is wrong with it:
    /// lengths, compression, checksum.
    pub(super) fn unpack(&mut self, record: &[u8]) -> bool {
        self.bytes.clear();
        self.records.clear();
        let Some(content) = record.get(HEAD..) else { return false };
        let Ok(mcap::records::Record::Chunk { header, .. }) = mcap::parse_record(record[0], content) else {
            return false;
        };
        let limit = LARGEST_RECORD as u64;
        if header.compressed_size > limit || header.uncompressed_size > limit {
            return false;
        }
        self.length = HEAD as u64 + 40 + header.compression.len() as u64 + header.compressed_size;
        self.checked = header.uncompressed_crc != 0;
        if header.compression.is_empty() && header.compressed_size != header.uncompressed_size {
            return false;
        }
        let options = LinearReaderOptions::default()
            .with_skip_start_magic(true)
            .with_skip_end_magic(true)
            .with_prevalidate_chunk_crcs(true)
            .with_record_length_limit(LARGEST_RECORD);
        let mut reader = LinearReader::new_with_options(options);
        let mut given = 0;
        loop {
            let ask = match reader.next_event() {
                None => return true,
                Some(Err(_)) => return false,
                Some(Ok(LinearReadEvent::Record { opcode, data })) => {
                    self.bytes.extend_from_slice(data);
                    self.records.push((opcode, self.bytes.len()));
                    continue;
                }
                Some(Ok(LinearReadEvent::ReadRequest(ask))) => ask.min(record.len() - given),
            };
            if ask > 0 {
                reader.insert(ask).copy_from_slice(&record[given..given + ask]);
            }
            reader.notify_read(ask);
            given += ask;
        }
    }

    /// Kind and content of each record.
    pub(super) fn records(&self) -> impl Iterator<Item = (u8, &[u8])> {
        let mut start = 0;
        self.records.iter().map(move |&(kind, end)| {
            let content = &self.bytes[start..end];
            start = end;
            (kind, content)
        })
    }
}
