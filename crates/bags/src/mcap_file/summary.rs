//! The summary at the end of an MCAP file: topics once more, and how many messages there are.

use mcap::records::{Record, Statistics, op};

use super::framing::{Frame, HEAD};
use super::window::Window;
use crate::source::LARGEST_RECORD;

/// Bytes of footer and end mark.
const FOOTER: usize = HEAD + 20;
const MARK: usize = mcap::MAGIC.len();

/// What a summary says.
#[derive(Default)]
pub(super) struct Summary {
    /// Content of its schema and channel records, with their kind.
    pub(super) topics: Vec<(u8, Vec<u8>)>,
    /// Its counts.
    pub(super) statistics: Option<Statistics>,
}

impl Summary {
    /// Reads the summary where there is one: `Ok(None)` without an end of the file, `Err(())` inside when it is damaged.
    pub(super) fn read(window: &mut Window<'_>) -> std::io::Result<Option<Result<Self, ()>>> {
        let length = window.at() + window.left();
        let Some(footer_at) = length.checked_sub((FOOTER + MARK) as u64) else { return Ok(None) };
        let Some(end) = window.tail(footer_at, FOOTER + MARK)? else { return Ok(None) };
        let Some((footer, mark)) = end.split_at_checked(FOOTER) else { return Ok(None) };
        let is_footer = Frame::read(footer, FOOTER as u64) == Some(Frame { kind: op::FOOTER, length: 20 });
        if mark != mcap::MAGIC || !is_footer {
            return Ok(None);
        }
        let Ok(Record::Footer(record)) = mcap::parse_record(op::FOOTER, &footer[HEAD..]) else { return Ok(None) };
        if record.summary_start == 0 {
            let nothing = record.summary_crc == 0 || record.summary_crc == crc32fast::hash(&footer[..HEAD + 16]);
            return Ok(Some(if nothing { Ok(Self::default()) } else { Err(()) }));
        }
        if record.summary_start > footer_at {
            return Ok(Some(Err(())));
        }
        // A summary too large to be held is none; the records are read as they pass.
        let Some(bytes) = window.tail(record.summary_start, LARGEST_RECORD)? else { return Ok(None) };
        let (records, rest) = bytes.split_at(bytes.len().saturating_sub(FOOTER + MARK));
        let mut crc = crc32fast::Hasher::new();
        crc.update(records);
        crc.update(rest.get(..HEAD + 16).unwrap_or_default());
        if record.summary_crc != 0 && crc.finalize() != record.summary_crc {
            return Ok(Some(Err(())));
        }
        Ok(Some(Self::of_records(records).ok_or(())))
    }

    fn of_records(mut bytes: &[u8]) -> Option<Self> {
        let mut summary = Self::default();
        while !bytes.is_empty() {
            let frame = Frame::read(bytes, bytes.len() as u64)?;
            let (record, rest) = bytes.split_at(usize::try_from(frame.whole()).ok()?);
            let content = &record[HEAD..];
            match frame.kind {
                op::SCHEMA | op::CHANNEL => summary.topics.push((frame.kind, content.to_vec())),
                op::STATISTICS => {
                    if let Ok(Record::Statistics(statistics)) = mcap::parse_record(frame.kind, content) {
                        summary.statistics = Some(statistics);
                    }
                }
                _ => {}
            }
            bytes = rest;
        }
        Some(summary)
    }
}
