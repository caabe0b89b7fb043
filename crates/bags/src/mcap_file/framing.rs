//! Where records of an MCAP file start and end: one byte of kind, eight of length.

use crate::source::LARGEST_RECORD;
use mcap::records::op;

/// Bytes before a record's content.
pub(super) const HEAD: usize = 9;

/// Kind and length of a record.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Frame {
    pub(super) kind: u8,
    pub(super) length: u64,
}

impl Frame {
    /// The frame that starts here, when nothing speaks against one: a kind that exists, long enough for it, and not
    /// beyond the `left` bytes of the file (this frame's head among them).
    pub(super) fn read(bytes: &[u8], left: u64) -> Option<Self> {
        let (kind, length) = (*bytes.first()?, u64::from_le_bytes(bytes.get(1..HEAD)?.try_into().ok()?));
        let fits = length <= left.checked_sub(HEAD as u64)?;
        (fits && length >= least(kind)?).then_some(Self { kind, length })
    }

    /// Bytes of head and content.
    pub(super) const fn whole(self) -> u64 {
        HEAD as u64 + self.length
    }
}

/// Whether these bytes can follow a record: another frame, the end mark, a head that the file's end cuts, or nothing.
pub(super) fn may_follow(bytes: &[u8], left: u64) -> bool {
    if left < HEAD as u64 {
        return bytes.first().is_none_or(|&kind| least(kind).is_some()) || mcap::MAGIC.starts_with(bytes);
    }
    // A record that the end of the file cuts is none, but it may follow one.
    Frame::read(bytes, left).is_some()
        || Frame::read(bytes, u64::MAX).is_some_and(|f| f.length <= LARGEST_RECORD as u64)
}

/// Fewest bytes of content that a record of this kind has; `None` for kinds that the format reserves.
const fn least(kind: u8) -> Option<u64> {
    Some(match kind {
        op::HEADER | op::METADATA => 8,
        op::FOOTER | op::METADATA_INDEX => 20,
        op::SCHEMA => 14,
        op::CHANNEL => 16,
        op::MESSAGE => 22,
        op::CHUNK => 40,
        op::MESSAGE_INDEX => 6,
        op::CHUNK_INDEX => 60,
        op::ATTACHMENT => 36,
        op::ATTACHMENT_INDEX => 48,
        op::STATISTICS => 46,
        op::SUMMARY_OFFSET => 17,
        op::DATA_END => 4,
        // Application extensions.
        0x80.. => 0,
        _ => return None,
    })
}
