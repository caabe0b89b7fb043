//! A stretch of a file in memory that moves forward, and the checksums of all that it passed.

use std::io::{self, Read as _, SeekFrom};

use super::hashing::Hashing;
use crate::source::{LARGEST_RECORD, ReadSeek};

/// Bytes asked of the source at once.
const BLOCK: usize = 256 << 10;

/// The part of a file from `at` on that is in memory.
pub(super) struct Window<'a> {
    source: &'a mut dyn ReadSeek,
    buffer: Vec<u8>,
    /// Index in the buffer of byte `at`.
    start: usize,
    at: u64,
    length: u64,
    /// Takes the bytes before `start` when the buffer is left.
    sha256: Hashing,
    crc: crc32fast::Hasher,
}

impl<'a> Window<'a> {
    /// A window at the start of a source.
    pub(super) fn new(source: &'a mut dyn ReadSeek) -> io::Result<Self> {
        let length = source.seek(SeekFrom::End(0))?;
        source.seek(SeekFrom::Start(0))?;
        let (sha256, crc) = (Hashing::new(length), crc32fast::Hasher::new());
        Ok(Self { source, buffer: Vec::new(), start: 0, at: 0, length, sha256, crc })
    }

    /// Where the window starts in the file.
    pub(super) const fn at(&self) -> u64 {
        self.at
    }

    /// Bytes from the window's start to the file's end.
    pub(super) const fn left(&self) -> u64 {
        self.length - self.at
    }

    /// The next `count` bytes; fewer at the end of the file.
    pub(super) fn load(&mut self, count: usize) -> io::Result<&[u8]> {
        let count = usize::try_from(self.left()).map_or(count, |left| count.min(left));
        if self.buffer.len() - self.start < count {
            self.fill(count)?;
        }
        let count = count.min(self.buffer.len() - self.start);
        Ok(&self.buffer[self.start..self.start + count])
    }

    fn fill(&mut self, count: usize) -> io::Result<()> {
        self.leave();
        let missing = count - self.buffer.len();
        let want = missing.max(BLOCK) as u64;
        let got = (&mut *self.source).take(want).read_to_end(&mut self.buffer)?;
        if got < missing {
            // The source is shorter than it said.
            self.length = self.at + self.buffer.len() as u64;
        }
        Ok(())
    }

    /// Has the bytes hashed that were passed, and takes those behind into another buffer.
    fn leave(&mut self) {
        let mut next = self.sha256.free();
        next.extend_from_slice(&self.buffer[self.start..]);
        let passed = std::mem::replace(&mut self.buffer, next);
        self.sha256.take(passed, self.start);
        self.start = 0;
    }

    /// Up to `count` bytes that lie `ahead` bytes after the window's start, which may be far away.
    pub(super) fn peek(&mut self, ahead: u64, count: usize) -> io::Result<Vec<u8>> {
        if ahead > self.left() {
            return Ok(Vec::new());
        }
        if let Some(ahead) = usize::try_from(ahead).ok().filter(|&ahead| ahead <= LARGEST_RECORD + 64) {
            let bytes = self.load(ahead + count)?;
            return Ok(bytes.get(ahead..).unwrap_or_default().to_vec());
        }
        let back = self.at + (self.buffer.len() - self.start) as u64;
        self.source.seek(SeekFrom::Start(self.at + ahead))?;
        let mut bytes = Vec::new();
        (&mut *self.source).take(count as u64).read_to_end(&mut bytes)?;
        self.source.seek(SeekFrom::Start(back))?;
        Ok(bytes)
    }

    /// All bytes from `from` to the end of the file, when they are at most `limit`.
    pub(super) fn tail(&mut self, from: u64, limit: usize) -> io::Result<Option<Vec<u8>>> {
        let count = self.length.checked_sub(from).filter(|&count| count <= limit as u64);
        let Some(count) = count else { return Ok(None) };
        let back = self.at + (self.buffer.len() - self.start) as u64;
        self.source.seek(SeekFrom::Start(from))?;
        let mut bytes = Vec::new();
        (&mut *self.source).take(count).read_to_end(&mut bytes)?;
        self.source.seek(SeekFrom::Start(back))?;
        Ok(Some(bytes))
    }

    /// Moves on by `count` bytes, or to the end of the file.
    pub(super) fn advance(&mut self, count: u64) -> io::Result<()> {
        let mut count = count.min(self.left());
        while count > 0 {
            let block = usize::try_from(count).map_or(BLOCK, |count| count.min(BLOCK));
            let here = self.load(block)?.len();
            if here == 0 {
                break;
            }
            let passed = &self.buffer[self.start..self.start + here];
            self.crc.update(passed);
            self.start += here;
            self.at += here as u64;
            count = (count - here as u64).min(self.left());
        }
        Ok(())
    }

    /// CRC-32 of all bytes before the window.
    pub(super) fn crc32(&self) -> u32 {
        self.crc.clone().finalize()
    }

    /// Moves to the end; length and SHA-256 of the file.
    pub(super) fn finish(mut self) -> io::Result<(u64, String)> {
        self.advance(u64::MAX)?;
        self.leave();
        // A source may have grown since its length was asked for; that is not read.
        Ok((self.at, self.sha256.finish()))
    }
}
