//! One chunk of an MCAP file: unpacked and checked whole before any of its records counts.

use mcap::sans_io::linear_reader::{LinearReadEvent, LinearReader, LinearReaderOptions};
use zstd::stream::raw::{Decoder, Operation};

use super::framing::HEAD;
use crate::source::LARGEST_RECORD;

/// The records of a chunk.
#[derive(Default)]
pub(super) struct Chunk {
    /// The content, with room behind it that an earlier chunk took.
    bytes: Vec<u8>,
    /// Kind of each record and where its content lies.
    records: Vec<(u8, std::ops::Range<usize>)>,
    /// Bytes that the chunk's record should have, head included.
    pub(super) length: u64,
    /// The chunk carries a checksum.
    pub(super) checked: bool,
    /// Made for the first chunk that needs it.
    zstd: Option<Decoder<'static>>,
}

impl Chunk {
    /// Unpacks the record `record` (head included), replacing what was here; false when anything is wrong with it:
    /// lengths, compression, checksum.
    pub(super) fn unpack(&mut self, record: &[u8]) -> bool {
        self.records.clear();
        let Some(content) = record.get(HEAD..) else { return false };
        let Ok(mcap::records::Record::Chunk { header, data }) = mcap::parse_record(record[0], content) else {
            return false;
        };
        let limit = LARGEST_RECORD as u64;
        if header.compressed_size > limit || header.uncompressed_size > limit {
            return false;
        }
        self.length = HEAD as u64 + 40 + header.compression.len() as u64 + header.compressed_size;
        self.checked = header.uncompressed_crc != 0;
        let length = header.uncompressed_size as usize;
        let unpacked = match header.compression.as_str() {
            "" => header.compressed_size == header.uncompressed_size && self.copy(&data),
            "zstd" => self.unzstd(&data, length).is_some(),
            _ => return self.unpack_by_library(record),
        };
        if !unpacked {
            return false;
        }
        let right = !self.checked || crc32fast::hash(&self.bytes[..length]) == header.uncompressed_crc;
        right && self.split(length).is_some()
    }

    fn copy(&mut self, data: &[u8]) -> bool {
        self.bytes.clear();
        self.bytes.extend_from_slice(data);
        true
    }

    /// Unpacks the first `length` bytes, however many frames they are in; `None` when there are not as many.
    fn unzstd(&mut self, packed: &[u8], length: usize) -> Option<()> {
        if self.bytes.len() < length {
            self.bytes.resize(length, 0);
        }
        let decoder = match &mut self.zstd {
            Some(decoder) => decoder,
            none => none.insert(Decoder::new().ok()?),
        };
        decoder.reinit().ok()?;
        let (mut read, mut written) = (0, 0);
        while written < length {
            let status = decoder.run_on_buffers(&packed[read..], &mut self.bytes[written..length]).ok()?;
            if status.bytes_read == 0 && status.bytes_written == 0 {
                return None;
            }
            read += status.bytes_read;
            written += status.bytes_written;
        }
        Some(())
    }

    /// Finds the records in the first `length` bytes; `None` when they are not whole records.
    fn split(&mut self, length: usize) -> Option<()> {
        let mut at = 0;
        while at < length {
            let (head, rest) = self.bytes[at..length].split_at_checked(HEAD)?;
            let size = usize::try_from(u64::from_le_bytes(head[1..].try_into().ok()?)).ok()?;
            if size > rest.len() {
                return None;
            }
            self.records.push((head[0], at + HEAD..at + HEAD + size));
            at += HEAD + size;
        }
        Some(())
    }

    /// The same for what only the library unpacks: lz4.
    fn unpack_by_library(&mut self, record: &[u8]) -> bool {
        self.bytes.clear();
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
                    let start = self.bytes.len();
                    self.bytes.extend_from_slice(data);
                    self.records.push((opcode, start..self.bytes.len()));
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
        self.records.iter().map(|(kind, place)| (*kind, &self.bytes[place.clone()]))
    }
}
