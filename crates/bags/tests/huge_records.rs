//! Records larger than what is held in memory, in a source that makes their bytes as they are asked for.

mod common;

use std::io::{self, Read, Seek, SeekFrom};

use bags::{FileError, LARGEST_RECORD, Loss, LossKind};
use common::{Bag, Kept, keep, messages};
use mcap::records::op;

/// Bytes, then zeros, then bytes.
struct Holed {
    before: Vec<u8>,
    zeros: u64,
    after: Vec<u8>,
    at: u64,
    /// Most bytes asked for at once.
    most: usize,
}

impl Holed {
    fn length(&self) -> u64 {
        self.before.len() as u64 + self.zeros + self.after.len() as u64
    }
}

impl Read for Holed {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        self.most = self.most.max(into.len());
        let (first, second) = (self.before.len() as u64, self.before.len() as u64 + self.zeros);
        let count = if self.at < first {
            (&self.before[self.at as usize..]).read(into)?
        } else if self.at < second {
            let count = into.len().min((second - self.at) as usize);
            into[..count].fill(0);
            count
        } else {
            (&self.after[(self.at - second) as usize..]).read(into)?
        };
        self.at += count as u64;
        Ok(count)
    }
}

impl Seek for Holed {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.at = match to {
            SeekFrom::Start(at) => at,
            SeekFrom::End(by) => self.length().saturating_add_signed(by),
            SeekFrom::Current(by) => self.at.saturating_add_signed(by),
        };
        Ok(self.at)
    }
}

/// A bag with a record of this kind and length, all zeros, before its messages.
fn read_with(kind: u8, length: u64) -> (Vec<Kept>, Vec<Loss>) {
    let bag = Bag { summary: false, checksums: false, ..Bag::default() }.write(&messages(20));
    let header = mcap::MAGIC.len() + 9 + usize::from(bag[9]);
    let mut before = bag[..header].to_vec();
    before.push(kind);
    before.extend(length.to_le_bytes());
    let mut source = Holed { before, zeros: length, after: bag[header..].to_vec(), at: 0, most: 0 };
    let mut kept = Vec::new();
    let passed = bags::messages("a.mcap", &mut source, &mut |message| {
        kept.push(keep(&message));
        Ok::<(), FileError>(())
    });
    assert!(source.most <= LARGEST_RECORD + 1024, "{} bytes asked for at once", source.most);
    (kept, passed.unwrap().losses)
}

#[test]
fn a_large_attachment_is_passed_over_without_being_held() {
    assert_eq!(read_with(op::ATTACHMENT, LARGEST_RECORD as u64 + 1), (messages(20), vec![]));
}

#[test]
fn a_chunk_above_the_limit_is_skipped_and_told() {
    let (kept, losses) = read_with(op::CHUNK, LARGEST_RECORD as u64 + 1);
    assert_eq!(kept, messages(20));
    assert_eq!((losses.len(), losses[0].kind, losses[0].count), (1, LossKind::TooLarge, 1));
}

#[test]
fn bytes_in_a_chunk_that_its_content_does_not_need_are_reported() {
    let (kept, losses) = read_with(op::CHUNK, 10 << 20);
    assert_eq!(kept, messages(20));
    assert_eq!((losses.len(), losses[0].kind), (1, LossKind::Damage));
}
