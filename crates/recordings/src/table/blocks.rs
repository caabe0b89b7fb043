//! A text file in blocks of whole lines: parsed beside each other, taken in order, hashed on the way.

use std::collections::VecDeque;
use std::io::Read;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;

use bags::{LARGEST_RECORD, ReadSeek, cannot_read};
use memchr::memrchr;
use sha2::{Digest, Sha256};

use crate::error::RecordingError;

/// Bytes of a block, about: long enough to be worth handing to a thread, short enough that a dozen of them are little.
const BLOCK: usize = 1 << 20;
/// Blocks on their way at most.
const ON_THEIR_WAY: usize = 8;
/// Threads that parse at most.
const MOST_THREADS: usize = 8;

/// Whole lines of a file; the last block may end without the end of a line.
#[derive(Clone)]
pub(super) struct Block {
    pub(super) bytes: Arc<Vec<u8>>,
    /// Byte at which the lines begin: in the first block, below the header.
    pub(super) from: usize,
}

/// A file of which blocks are read.
pub(super) struct Blocks<'s> {
    name: &'s str,
    source: &'s mut dyn ReadSeek,
    /// The beginning of a line whose end was not read yet.
    carry: Vec<u8>,
    /// Bytes read so far.
    read: u64,
    ended: bool,
}

/// A file whose blocks were all taken.
pub(super) struct Passed {
    pub(super) bytes: u64,
    pub(super) sha256: String,
}

impl<'s> Blocks<'s> {
    pub(super) fn new(name: &'s str, source: &'s mut dyn ReadSeek) -> Self {
        Self { name, source, carry: Vec::new(), read: 0, ended: false }
    }

    /// The first block: it holds a line that is not blank, if there is one.
    pub(super) fn first(&mut self) -> Result<Vec<u8>, RecordingError> {
        let mut first = self.next()?.unwrap_or_default();
        while first.iter().all(u8::is_ascii_whitespace) {
            let Some(more) = self.next()? else { break };
            first.extend(more);
        }
        Ok(first)
    }

    /// The next whole lines; `None` after the last.
    fn next(&mut self) -> Result<Option<Vec<u8>>, RecordingError> {
        let mut block = std::mem::take(&mut self.carry);
        while !self.ended {
            let have = block.len();
            let wanted = BLOCK.max(have + BLOCK / 4) - have;
            let count = (&mut *self.source)
                .take(wanted as u64)
                .read_to_end(&mut block)
                .map_err(|error| cannot_read(self.name, self.read, &error))?;
            self.read += count as u64;
            self.ended = count < wanted;
            if self.ended {
                break;
            }
            // What was there before holds no end of a line, unless its last byte is one.
            let new = have.saturating_sub(1);
            if let Some(end) = last_line_end(&block[new..]).map(|end| new + end) {
                self.carry = block.split_off(end);
                return Ok(Some(block));
            }
            if block.len() > LARGEST_RECORD {
                let message = format!("a line is longer than {LARGEST_RECORD} bytes: this is no table");
                return Err(cannot_read(self.name, self.read, &std::io::Error::other(message)).into());
            }
        }
        Ok(Some(block).filter(|block| !block.is_empty()))
    }

    /// Parses the lines from `from` in `first` on, and those of all further blocks, and gives them to `take` in order.
    pub(super) fn pass<T: Send>(
        mut self,
        first: Block,
        parse: &(impl Fn(&Block) -> T + Sync),
        take: &mut dyn FnMut(&Block, T) -> Result<(), RecordingError>,
    ) -> Result<Passed, RecordingError> {
        if self.ended {
            take(&first, parse(&first))?;
            return Ok(Passed { bytes: self.read, sha256: hex::encode(Sha256::digest(first.bytes.as_slice())) });
        }
        let (hash, hashed) = sync_channel::<Block>(ON_THEIR_WAY);
        let (ask, asked) = sync_channel::<(Block, SyncSender<T>)>(ON_THEIR_WAY);
        let asked = Mutex::new(asked);
        thread::scope(|scope| {
            // Dropped with this closure, which ends the threads whatever happens.
            let (hash, ask) = (hash, ask);
            let sum = scope.spawn(move || hash_all(&hashed));
            for _ in 0..thread::available_parallelism().map_or(1, usize::from).min(MOST_THREADS) {
                scope.spawn(|| serve(&asked, parse));
            }
            let mut on_their_way = VecDeque::new();
            let mut next = Some(first);
            loop {
                if let Some(block) = next.take() {
                    let (give, given) = sync_channel(1);
                    // Threads wait as long as there is a sender; without any, the block is parsed below.
                    let _ = hash.send(block.clone());
                    let _ = ask.send((block.clone(), give));
                    on_their_way.push_back((block, given));
                }
                if on_their_way.len() < ON_THEIR_WAY {
                    next = self.next()?.map(|bytes| Block { bytes: Arc::new(bytes), from: 0 });
                    if next.is_some() {
                        continue;
                    }
                }
                let Some((block, given)) = on_their_way.pop_front() else { break };
                let parsed = given.recv().unwrap_or_else(|_| parse(&block));
                take(&block, parsed)?;
            }
            drop(hash);
            let sha256 = sum.join().unwrap_or_default();
            Ok(Passed { bytes: self.read, sha256 })
        })
    }
}

fn hash_all(blocks: &Receiver<Block>) -> String {
    let mut sum = Sha256::new();
    for block in blocks {
        sum.update(block.bytes.as_slice());
    }
    hex::encode(sum.finalize())
}

/// Parses until nobody can ask any more.
fn serve<T>(asked: &Mutex<Receiver<(Block, SyncSender<T>)>>, parse: &impl Fn(&Block) -> T) {
    loop {
        let next = asked.lock().unwrap_or_else(PoisonError::into_inner).recv();
        let Ok((block, give)) = next else { return };
        // Who asked may have given up.
        let _ = give.send(parse(&block));
    }
}

/// Where the last whole line ends; a `\r` at the very end may be half of `\r\n`.
fn last_line_end(bytes: &[u8]) -> Option<usize> {
    let last = |end: u8, bytes: &[u8]| memrchr(end, bytes).map(|at| at + 1);
    last(b'\n', bytes).or_else(|| last(b'\r', &bytes[..bytes.len() - 1]))
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::*;

    /// Lines as they are taken, and what was told of the file.
    fn passed(text: &[u8]) -> (Vec<u8>, Passed) {
        let mut source = Cursor::new(text.to_vec());
        let mut blocks = Blocks::new("a.csv", &mut source);
        let first = Block { bytes: Arc::new(blocks.first().expect("reads")), from: 0 };
        let mut taken = Vec::new();
        let told = blocks.pass(first, &|block: &Block| block.bytes.len(), &mut |block, length| {
            assert_eq!(block.bytes.len(), length);
            taken.extend_from_slice(&block.bytes);
            Ok(())
        });
        (taken, told.expect("passes"))
    }

    #[test]
    fn blocks_hold_whole_lines_in_order_and_all_bytes_are_hashed() {
        for end in ["\n", "\r\n", "\r"] {
            let lines: Vec<String> = (0..900_000).map(|i| i.to_string()).collect();
            let text = lines.join(&format!(",{end}"));
            let (taken, told) = passed(text.as_bytes());
            assert!(taken == text.as_bytes());
            assert_eq!((told.bytes, told.sha256), (text.len() as u64, hex::encode(Sha256::digest(text.as_bytes()))));
        }
        let (taken, told) = passed(b"");
        assert_eq!((taken.len(), told.bytes), (0, 0));
    }

    #[test]
    fn leading_blank_lines_do_not_hide_the_header() {
        let mut text = vec![b'\n'; 3 * BLOCK];
        text.extend(b"a,b\n1,2\n");
        let mut source = Cursor::new(text);
        let first = Blocks::new("a.csv", &mut source).first().expect("reads");
        assert!(first.ends_with(b"a,b\n1,2\n"));
    }

    #[test]
    fn a_line_without_end_is_refused() {
        let mut source = Cursor::new(vec![b'7'; 2 * LARGEST_RECORD]);
        let error = Blocks::new("a.csv", &mut source).first().expect_err("no table");
        assert!(error.to_string().contains("a line is longer than"), "{error}");
    }

    #[test]
    fn an_error_ends_the_threads() {
        let text = b"1,2\n".repeat(BLOCK);
        let mut source = Cursor::new(text);
        let mut blocks = Blocks::new("a.csv", &mut source);
        let first = Block { bytes: Arc::new(blocks.first().expect("reads")), from: 0 };
        let stop = RecordingError::EmptyFile { file: "a.csv".to_owned() };
        let told = blocks.pass(first, &|_: &Block| (), &mut |_, ()| Err(stop.clone()));
        assert!(told.is_err());
    }
}
