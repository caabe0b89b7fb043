//! An MCAP file from start to end, damaged or not.
//!
//! The `mcap` library's readers stop at the first damage. Here records are framed one by one, so that reading goes on
//! behind it; what records and chunks hold is the library's to say. A record outside of chunks counts when something
//! that can be a record follows it, a chunk when its checksum is right.

use std::io;

use mcap::records::{Record, op};

use super::chunk::Chunk;
use super::framing::{Frame, HEAD, may_follow};
use super::records::{Records, Where};
use super::summary::Summary;
use super::window::Window;
use crate::error::FileError;
use crate::loss::{Ledger, LossKind};
use crate::place::Place;
use crate::source::{LARGEST_RECORD, ReadSeek, cannot_read};
use crate::topic::{Passed, Sink};

/// Gives every message that can be trusted to `each`.
pub(crate) fn pass<E: From<FileError>>(
    name: &str,
    source: &mut dyn ReadSeek,
    each: &mut Sink<'_, E>,
) -> Result<Passed, E> {
    let window = Window::new(source).map_err(|error| cannot_read(name, 0, &error))?;
    let ledger = Ledger::new(name, Place::Byte);
    let records = Records::default();
    let mut file = File {
        name,
        window,
        ledger,
        records,
        chunk: Chunk::default(),
        chunked: false,
        complete: false,
        unchecked: 0,
        each,
    };
    let summary = file.summary()?;
    file.pass(&summary)?;
    let File { window, ledger, records, unchecked, .. } = file;
    let at = window.at();
    let (bytes, sha256) = window.finish().map_err(|error| cannot_read(name, at, &error))?;
    Ok(Passed { topics: records.topics, losses: ledger.into_losses(), unchecked, bytes, sha256 })
}

/// What follows the current place.
enum Next {
    /// A record that counts, of this length.
    Record(Frame),
    /// A chunk that was unpacked, and whether it has the length that its record says.
    Chunk { length: u64, as_said: bool },
    /// A chunk that is to be dropped.
    BadChunk(Frame),
    /// A record above the limit.
    TooLarge(Frame),
    /// Nothing that makes sense.
    Damage,
}

struct File<'a, 's, E> {
    name: &'a str,
    window: Window<'a>,
    ledger: Ledger<'a>,
    records: Records,
    chunk: Chunk,
    /// The file keeps its messages in chunks: behind damage, only these are believed.
    chunked: bool,
    /// The end mark was met.
    complete: bool,
    /// Messages that no checksum covers.
    unchecked: u64,
    each: &'s mut Sink<'s, E>,
}

impl<E: From<FileError>> File<'_, '_, E> {
    fn io<T>(&self, result: io::Result<T>) -> Result<T, FileError> {
        result.map_err(|error| cannot_read(self.name, self.window.at(), &error))
    }

    fn lose(&mut self, kind: LossKind) {
        let at = self.window.at();
        self.ledger.add(kind, None, || Some(at));
    }

    fn summary(&mut self) -> Result<Summary, FileError> {
        let read = Summary::read(&mut self.window);
        let summary = match self.io(read)? {
            None => Summary::default(),
            Some(Ok(summary)) => summary,
            Some(Err(())) => {
                self.ledger.add(LossKind::BadSummary, None, || None);
                Summary::default()
            }
        };
        self.records = Records::new(&summary.topics);
        self.chunked = summary.statistics.as_ref().is_some_and(|statistics| statistics.chunk_count > 0);
        Ok(summary)
    }

    fn pass(&mut self, summary: &Summary) -> Result<(), E> {
        let good = self.window.load(mcap::MAGIC.len()).map(|bytes| bytes == mcap::MAGIC);
        if self.io(good)? {
            self.advance(mcap::MAGIC.len() as u64)?;
        } else {
            self.lose(LossKind::Damage);
            self.resume(0)?;
        }
        while self.window.left() > 0 && !self.complete {
            self.step()?;
        }
        if !self.complete {
            self.lose(LossKind::CutOff);
        }
        let counted = summary.statistics.as_ref().map_or(0, |statistics| statistics.message_count);
        self.ledger.add_many(LossKind::MissingMessage, counted.saturating_sub(self.records.met));
        Ok(())
    }

    /// Takes one record, or skips damage.
    fn step(&mut self) -> Result<(), E> {
        let next = self.next();
        match self.io(next)? {
            Next::Record(frame) => self.record(frame)?,
            Next::Chunk { length, as_said } => {
                self.chunked = true;
                if !as_said {
                    self.lose(LossKind::Damage);
                }
                self.take_chunk()?;
                self.advance(length)?;
            }
            Next::BadChunk(frame) => {
                self.chunked = true;
                self.lose(LossKind::BadChunk);
                self.advance(frame.whole())?;
            }
            Next::TooLarge(frame) => {
                // Attachments hold no messages.
                if !matches!(frame.kind, op::ATTACHMENT | op::METADATA) {
                    self.lose(LossKind::TooLarge);
                }
                self.advance(frame.whole())?;
            }
            Next::Damage => {
                let left = self.window.left();
                let rest = self.window.load(mcap::MAGIC.len()).map(<[u8]>::to_vec);
                let rest = self.io(rest)?;
                self.chunked |= rest.first() == Some(&op::CHUNK);
                let cut = left < HEAD as u64 && mcap::MAGIC.starts_with(&rest);
                if !cut {
                    self.lose(LossKind::Damage);
                }
                self.resume(1)?;
            }
        }
        Ok(())
    }

    /// What starts here.
    fn next(&mut self) -> io::Result<Next> {
        let left = self.window.left();
        let Some(frame) = Frame::read(self.window.load(HEAD)?, left) else { return Ok(Next::Damage) };
        let then = self.window.peek(frame.whole(), HEAD)?;
        let follows =
            if frame.kind == op::FOOTER { then == mcap::MAGIC } else { may_follow(&then, left - frame.whole()) };
        if frame.length > LARGEST_RECORD as u64 {
            return Ok(if follows { Next::TooLarge(frame) } else { Next::Damage });
        }
        if frame.kind != op::CHUNK {
            return Ok(if follows { Next::Record(frame) } else { Next::Damage });
        }
        if !self.chunk.unpack(self.window.load(frame.whole() as usize)?) {
            return Ok(if follows { Next::BadChunk(frame) } else { Next::Damage });
        }
        // The length that the content has, and something to follow, weigh more than the length that the record says.
        let (has, checked) = (self.chunk.length, self.chunk.checked);
        let then = self.window.peek(has, HEAD)?;
        let as_said = has == frame.whole();
        let length = if as_said || may_follow(&then, left - has) { has } else { frame.whole() };
        Ok(if checked || follows { Next::Chunk { length, as_said } } else { Next::Damage })
    }

    /// Moves to the first place, at least `ahead` bytes from here, from which reading can go on.
    fn resume(&mut self, ahead: u64) -> Result<(), FileError> {
        /// Bytes searched at once.
        const BLOCK: usize = 64 << 10;
        self.advance(ahead)?;
        while self.window.left() > 0 {
            let left = self.window.left();
            let block = self.window.load(BLOCK).map(|bytes| {
                let frame_at = |&at: &usize| Frame::read(&bytes[at..], left - at as u64).is_some();
                let heads = (bytes.len() + 1).saturating_sub(HEAD);
                (0..heads).find(frame_at).unwrap_or(if heads == 0 { bytes.len() } else { heads })
            });
            let skip = self.io(block)? as u64;
            self.advance(skip)?;
            if self.window.left() == 0 {
                break;
            }
            let next = self.next();
            let go_on = match self.io(next)? {
                Next::Chunk { .. } => true,
                Next::Record(frame) => {
                    let content = matches!(frame.kind, op::SCHEMA | op::CHANNEL | op::MESSAGE);
                    !(content && self.chunked) && frame.kind < 0x80 && self.next_but_one(frame)?
                }
                Next::BadChunk(_) | Next::TooLarge(_) | Next::Damage => false,
            };
            if go_on {
                return Ok(());
            }
            self.advance(1)?;
        }
        Ok(())
    }

    /// Whether what follows this record is itself followed by something.
    fn next_but_one(&mut self, frame: Frame) -> Result<bool, FileError> {
        let left = self.window.left() - frame.whole();
        let bytes = self.window.peek(frame.whole(), HEAD);
        let bytes = self.io(bytes)?;
        if left < HEAD as u64 {
            return Ok(true);
        }
        let Some(second) = Frame::read(&bytes, left) else { return Ok(false) };
        let third = self.window.peek(frame.whole() + second.whole(), HEAD);
        Ok(may_follow(&self.io(third)?, left - second.whole()))
    }

    /// Takes a record outside of chunks.
    fn record(&mut self, frame: Frame) -> Result<(), E> {
        let at = self.window.at();
        if frame.kind == op::DATA_END {
            self.check_data()?;
        }
        let content = self.window.load(frame.whole() as usize).map(|bytes| &bytes[HEAD..]);
        let content = content.map_err(|error| cannot_read(self.name, at, &error))?;
        if frame.kind >= 0x80 {
            self.ledger.add(LossKind::UnknownRecord, None, || Some(at));
        } else {
            let place = if self.chunked { Where::OutsideChunks } else { Where::Unchunked };
            self.unchecked += u64::from(frame.kind == op::MESSAGE && place == Where::Unchunked);
            self.records.take(frame.kind, content, (place, at), self.each, &mut self.ledger)?;
        }
        self.advance(frame.whole())?;
        if frame.kind == op::FOOTER && self.window.left() == mcap::MAGIC.len() as u64 {
            self.complete = true;
        }
        Ok(())
    }

    fn take_chunk(&mut self) -> Result<(), E> {
        let at = self.window.at();
        let before = self.records.met;
        for (kind, content) in self.chunk.records() {
            self.records.take(kind, content, (Where::Chunk, at), self.each, &mut self.ledger)?;
        }
        if !self.chunk.checked {
            self.unchecked += self.records.met - before;
        }
        Ok(())
    }

    /// Compares the checksum over everything before the record that is here. It tells nothing new behind damage.
    fn check_data(&mut self) -> Result<(), FileError> {
        let bytes = self.window.load(HEAD + 4).map(|bytes| bytes[HEAD..].to_vec());
        let bytes = self.io(bytes)?;
        if let Ok(Record::DataEnd(end)) = mcap::parse_record(op::DATA_END, &bytes) {
            let wrong = end.data_section_crc != 0 && end.data_section_crc != self.window.crc32();
            if end.data_section_crc != 0 {
                self.unchecked = 0;
            }
            if wrong && self.ledger.losses().iter().all(|loss| loss.kind == LossKind::BadSummary) {
                self.lose(LossKind::BadChecksum);
            }
        }
        Ok(())
    }

    fn advance(&mut self, count: u64) -> Result<(), FileError> {
        let done = self.window.advance(count);
        self.io(done)
    }
}
