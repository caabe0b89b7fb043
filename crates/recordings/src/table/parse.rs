//! The lines of a block as numbers: everything about a CSV file that can be done block by block.

use super::blocks::Block;
use crate::cell::{self, CellError};
use crate::header::Header;
use crate::row::{Row, shown};

/// A number that stands for an empty cell: a NaN, which no cell gives.
const GAP: f64 = f64::from_bits(0x7ff8_0000_0000_0001);
/// A number that stands for a cell that must be looked at again.
const LOOK: f64 = f64::from_bits(0x7ff8_0000_0000_0002);
/// An instant that stands for an empty cell.
const NO_TIME: i64 = i64::MIN;
/// An instant that stands for a cell that must be looked at again.
const LOOK_AT_TIME: i64 = i64::MIN + 1;

/// Where the numbers of a line are.
pub(super) struct Layout {
    pub(super) delimiter: u8,
    /// Numbers are written with a decimal comma.
    pub(super) comma: bool,
    /// Fields of a line.
    pub(super) width: usize,
    /// Position of the time, and the nanoseconds in its unit.
    pub(super) time: Option<(usize, i64)>,
    /// Of each position, which of the kept numbers it is.
    slot: Vec<Option<usize>>,
    /// Numbers that are kept of a line.
    slots: usize,
}

impl Layout {
    pub(super) fn new(header: &Header<'_>, delimiter: u8, comma: bool, ns_per_unit: i64) -> Self {
        let mut slot = vec![None; header.width];
        let mut slots = 0;
        for found in &header.columns {
            slot[found.position].get_or_insert_with(|| {
                slots += 1;
                slots - 1
            });
        }
        let time = header.time.map(|position| (position, ns_per_unit));
        Self { delimiter, comma, width: header.width, time, slot, slots }
    }

    /// The number in a cell.
    fn number(&self, cell: &[u8]) -> Result<Option<f64>, CellError> {
        cell::number(&cell::with_point(cell, self.comma)?)
    }

    /// The instant in a cell.
    fn instant(&self, cell: &[u8], ns_per_unit: i64) -> Result<Option<i64>, CellError> {
        cell::instant_ns(&cell::with_point(cell, self.comma)?, ns_per_unit)
    }
}

/// A line of a block.
pub(super) struct LineAt {
    /// Its first and one past its last byte.
    bytes: (usize, usize),
    /// Fields that it has.
    pub(super) fields: usize,
}

/// The lines of a block.
pub(super) struct Parsed {
    pub(super) lines: Vec<LineAt>,
    /// Time of each line, ns.
    instants: Vec<i64>,
    /// Kept numbers, line after line.
    numbers: Vec<f64>,
    /// Ends of lines in the block.
    pub(super) line_ends: u64,
}

impl Parsed {
    /// Parses the lines of a block.
    pub(super) fn new(block: &Block, layout: &Layout) -> Self {
        let bytes = &block.bytes[block.from..];
        let about = bytes.len() / (4 * layout.width).max(16);
        let mut out = Self {
            lines: Vec::with_capacity(about),
            instants: Vec::with_capacity(about),
            numbers: Vec::with_capacity(about * layout.slots),
            line_ends: 0,
        };
        let mut at = 0;
        while at < bytes.len() {
            let end = memchr::memchr2(b'\n', b'\r', &bytes[at..]).map_or(bytes.len(), |length| at + length);
            if end > at {
                out.line(bytes, (at, end), layout);
            }
            out.line_ends += u64::from(end < bytes.len());
            at = end + if bytes[end..].starts_with(b"\r\n") { 2 } else { 1 };
        }
        out
    }

    fn line(&mut self, bytes: &[u8], (start, end): (usize, usize), layout: &Layout) {
        let before = self.numbers.len();
        self.numbers.resize(before + layout.slots, GAP);
        let (mut instant, mut fields, mut from) = (NO_TIME, 0, start);
        for to in memchr::memchr_iter(layout.delimiter, &bytes[start..end]).map(|at| start + at).chain([end]) {
            let cell = &bytes[from..to];
            if let Some((_, ns_per_unit)) = layout.time.filter(|time| time.0 == fields) {
                instant = match layout.instant(cell, ns_per_unit) {
                    Ok(None) => NO_TIME,
                    Ok(Some(ns)) if ns > LOOK_AT_TIME => ns,
                    Ok(Some(_)) | Err(_) => LOOK_AT_TIME,
                };
            }
            if let Some(slot) = layout.slot.get(fields).copied().flatten() {
                self.numbers[before + slot] = match layout.number(cell) {
                    Ok(None) => GAP,
                    Ok(Some(number)) => number,
                    Err(_) => LOOK,
                };
            }
            fields += 1;
            from = to + 1;
        }
        self.lines.push(LineAt { bytes: (start, end), fields });
        self.instants.push(instant);
    }
}

/// A line that has been parsed.
pub(super) struct Line<'a> {
    pub(super) layout: &'a Layout,
    pub(super) block: &'a Block,
    pub(super) parsed: &'a Parsed,
    /// Which of the block's lines.
    pub(super) index: usize,
    /// Number, in the file, of the line with which the block begins.
    pub(super) begins: u64,
}

impl<'a> Line<'a> {
    /// A cell as it was written.
    fn cell(&self, position: usize) -> &'a [u8] {
        let (start, end) = self.parsed.lines[self.index].bytes;
        let line = &self.block.bytes[self.block.from..][start..end];
        line.split(|&byte| byte == self.layout.delimiter).nth(position).unwrap_or_default()
    }
}

impl Row for Line<'_> {
    #[inline]
    fn number(&self, position: usize) -> Result<Option<f64>, CellError> {
        let Some(slot) = self.layout.slot.get(position).copied().flatten() else {
            return self.layout.number(self.cell(position));
        };
        let number = self.parsed.numbers[self.index * self.layout.slots + slot];
        if !number.is_nan() {
            Ok(Some(number))
        } else if number.to_bits() == GAP.to_bits() {
            Ok(None)
        } else {
            self.layout.number(self.cell(position))
        }
    }

    #[inline]
    fn instant_ns(&self, position: usize, ns_per_unit: i64) -> Result<Option<i64>, CellError> {
        match self.parsed.instants[self.index] {
            NO_TIME => Ok(None),
            LOOK_AT_TIME => self.layout.instant(self.cell(position), ns_per_unit),
            ns => Ok(Some(ns)),
        }
    }

    fn text(&self, position: usize) -> String {
        shown(&String::from_utf8_lossy(cell::bare(self.cell(position))))
    }

    fn place(&self) -> u64 {
        let before = &self.block.bytes[self.block.from..][..self.parsed.lines[self.index].bytes.0];
        self.begins + crate::header::line_ends(before)
    }
}
