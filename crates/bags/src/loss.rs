//! What could not be read: counted by kind, with the first few places named.

use std::fmt;

use crate::place::Place;

/// How many places of one kind are named one by one.
const PLACES_NAMED: usize = 5;

/// What kind of thing was lost.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum LossKind {
    /// A row with too many or too few fields was skipped.
    FieldCount,
    /// A row without a time was skipped.
    NoTime,
    /// A message whose header stamp is 0 was skipped: nobody set it, and 0 would be an instant in 1970.
    UnsetStamp,
    /// A row whose time is no number was skipped (tolerant reading).
    BadTime,
    /// A row came after later ones, by at most a second, and was sorted into its place: nothing of it is missing.
    OutOfOrder,
    /// A row whose time is more than a second before an earlier row's was skipped (tolerant reading).
    TimeBackwards,
    /// A row repeats a stamp, and with it signals that already had a sample; the first sample was kept.
    DuplicateStamp,
    /// A cell with text or a number that is not finite became a gap (tolerant reading).
    BadCell,
    /// A negative number in a column without sign became a gap (tolerant reading).
    NegativeMagnitude,
    /// A column that the mapping asks for holds no sample.
    EmptyColumn,
    /// A file that belongs to the run is not there.
    MissingFile,
    /// Damaged bytes were skipped up to the next record that is whole.
    Damage,
    /// A chunk of messages whose content or checksum is wrong was dropped whole.
    BadChunk,
    /// A record, chunk or message above the limit of what is held in memory was skipped.
    TooLarge,
    /// The file stops before its end mark.
    CutOff,
    /// The summary at the end of the file is damaged.
    BadSummary,
    /// The checksum over all messages is wrong, and no damage was found elsewhere.
    BadChecksum,
    /// The file says that it holds messages that were not found.
    MissingMessage,
    /// A record of a kind that nobody knows was skipped.
    UnknownRecord,
    /// A message outside of the chunks of a file that has chunks was skipped: no checksum covers it.
    StrayMessage,
    /// A message of a topic that the file does not describe was skipped.
    UnknownTopic,
    /// A message that does not decode by its schema was skipped.
    BadMessage,
    /// The topic that the mapping asks for holds no message.
    EmptyTopic,
}

impl LossKind {
    /// What happened, for one and for many.
    const fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::FieldCount => ("row skipped: wrong number of fields", "rows skipped: wrong number of fields"),
            Self::NoTime => ("row skipped: empty time", "rows skipped: empty time"),
            Self::UnsetStamp => (
                "message skipped: its header.stamp is 0, the driver did not set it",
                "messages skipped: their header.stamp is 0, the driver did not set it",
            ),
            Self::BadTime => ("row skipped: time is not a number", "rows skipped: time is not a number"),
            Self::OutOfOrder => ("row out of order: sorted by its stamp", "rows out of order: sorted by their stamps"),
            Self::TimeBackwards => ("row skipped: time runs backwards", "rows skipped: time runs backwards"),
            Self::DuplicateStamp => {
                ("row repeats a stamp: first sample kept", "rows repeat a stamp: first samples kept")
            }
            Self::BadCell => ("cell read as a gap: not a finite number", "cells read as gaps: not finite numbers"),
            Self::NegativeMagnitude => (
                "cell read as a gap: negative although magnitude_only",
                "cells read as gaps: negative although magnitude_only",
            ),
            Self::EmptyColumn => ("column without a sample", "columns without a sample"),
            Self::MissingFile => ("file is missing; its signals are absent", "files are missing"),
            Self::Damage => ("stretch of damaged bytes skipped", "stretches of damaged bytes skipped"),
            Self::BadChunk => ("damaged chunk of messages dropped", "damaged chunks of messages dropped"),
            Self::TooLarge => ("record above the size limit skipped", "records above the size limit skipped"),
            Self::CutOff => ("file without its end: it was cut off", "files without their end"),
            Self::BadSummary => ("damaged summary", "damaged summaries"),
            Self::BadChecksum => ("wrong checksum over the messages", "wrong checksums over the messages"),
            Self::MissingMessage => {
                ("message not found that the file counts", "messages not found that the file counts")
            }
            Self::UnknownRecord => ("record of unknown kind skipped", "records of unknown kind skipped"),
            Self::StrayMessage => {
                ("message outside of the file's chunks skipped", "messages outside of the file's chunks skipped")
            }
            Self::UnknownTopic => ("message of an undescribed topic skipped", "messages of undescribed topics skipped"),
            Self::BadMessage => ("message skipped: it does not decode", "messages skipped: they do not decode"),
            Self::EmptyTopic => ("topic without a message", "topics without a message"),
        }
    }
}

/// Something that could not be read, and how often.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Loss {
    /// What kind of thing.
    pub kind: LossKind,
    /// The file in which, or which, was lost.
    pub file: String,
    /// The column, where one cell or column is meant.
    pub column: Option<String>,
    /// What `lines` counts.
    pub place: Place,
    /// The first few places at which it happened.
    pub lines: Vec<u64>,
    /// How often it happened.
    pub count: usize,
}

impl fmt::Display for Loss {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (one, many) = self.kind.words();
        write!(f, "{}: {} {}", self.file, self.count, if self.count == 1 { one } else { many })?;
        if let Some(column) = &self.column {
            write!(f, ", column {column}")?;
        }
        for (index, line) in self.lines.iter().enumerate() {
            match (index, self.count) {
                (0, 1) => write!(f, ", {} {line}", self.place)?,
                (0, _) => write!(f, ", {}s {line}", self.place)?,
                _ => write!(f, ", {line}")?,
            }
        }
        if !self.lines.is_empty() && self.count > self.lines.len() {
            f.write_str(" and more")?;
        }
        Ok(())
    }
}

/// Collects the losses of one file, one entry per kind and column, in the order of their first appearance.
#[derive(Debug)]
pub struct Ledger<'a> {
    file: &'a str,
    place: Place,
    losses: Vec<Loss>,
}

impl<'a> Ledger<'a> {
    /// An empty ledger for a file whose places are counted in `place`.
    pub const fn new(file: &'a str, place: Place) -> Self {
        Self { file, place, losses: Vec::new() }
    }

    /// Counts one loss; `line` is asked only while places are still named.
    pub fn add(&mut self, kind: LossKind, column: Option<&str>, line: impl FnOnce() -> Option<u64>) {
        let same = |loss: &Loss| loss.kind == kind && loss.column.as_deref() == column;
        let index = self.losses.iter().position(same).unwrap_or_else(|| {
            let column = column.map(str::to_owned);
            let (file, place) = (self.file.to_owned(), self.place);
            self.losses.push(Loss { kind, file, column, place, lines: Vec::new(), count: 0 });
            self.losses.len() - 1
        });
        let loss = &mut self.losses[index];
        loss.count += 1;
        if loss.count <= PLACES_NAMED {
            loss.lines.extend(line());
        }
    }

    /// Counts losses whose places are not known.
    pub fn add_many(&mut self, kind: LossKind, count: u64) {
        let count = usize::try_from(count).unwrap_or(usize::MAX);
        if count > 0 {
            let (file, place) = (self.file.to_owned(), self.place);
            self.losses.push(Loss { kind, file, column: None, place, lines: Vec::new(), count });
        }
    }

    /// What was lost so far.
    pub fn losses(&self) -> &[Loss] {
        &self.losses
    }

    /// Everything that was lost.
    pub fn into_losses(self) -> Vec<Loss> {
        self.losses
    }
}

/// Losses in one line, for an error message.
pub fn in_words(losses: &[Loss]) -> String {
    if losses.is_empty() {
        return "every mapped cell is empty".to_owned();
    }
    losses.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn losses_are_counted_and_the_first_places_named() {
        let mut ledger = Ledger::new("a.csv", Place::Line);
        for line in 3..10 {
            ledger.add(LossKind::FieldCount, None, || Some(line));
        }
        ledger.add(LossKind::BadCell, Some("wz"), || Some(4));
        let losses = ledger.into_losses();
        assert_eq!(
            in_words(&losses),
            "a.csv: 7 rows skipped: wrong number of fields, lines 3, 4, 5, 6, 7 and more; \
             a.csv: 1 cell read as a gap: not a finite number, column wz, line 4"
        );
    }
}
