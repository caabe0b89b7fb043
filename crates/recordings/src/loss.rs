//! What could not be read: counted by kind, with the first few places named.

use std::fmt;

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
    /// A row whose time is no number was skipped (tolerant reading).
    BadTime,
    /// A row whose time is before an earlier row's was skipped (tolerant reading).
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
}

impl LossKind {
    /// What happened, for one and for many.
    const fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::FieldCount => ("row skipped: wrong number of fields", "rows skipped: wrong number of fields"),
            Self::NoTime => ("row skipped: empty time", "rows skipped: empty time"),
            Self::BadTime => ("row skipped: time is not a number", "rows skipped: time is not a number"),
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
    /// The first few lines (from 1) at which it happened.
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
            let lead = match (index, self.count) {
                (0, 1) => ", line",
                (0, _) => ", lines",
                _ => ",",
            };
            write!(f, "{lead} {line}")?;
        }
        if !self.lines.is_empty() && self.count > self.lines.len() {
            f.write_str(" and more")?;
        }
        Ok(())
    }
}

/// Collects the losses of one file, one entry per kind and column, in the order of their first appearance.
#[derive(Debug)]
pub(crate) struct Ledger<'a> {
    file: &'a str,
    losses: Vec<Loss>,
}

impl<'a> Ledger<'a> {
    /// An empty ledger for a file.
    pub(crate) const fn new(file: &'a str) -> Self {
        Self { file, losses: Vec::new() }
    }

    /// Counts one loss; `line` is asked only while places are still named.
    pub(crate) fn add(&mut self, kind: LossKind, column: Option<&str>, line: impl FnOnce() -> Option<u64>) {
        let same = |loss: &Loss| loss.kind == kind && loss.column.as_deref() == column;
        let index = self.losses.iter().position(same).unwrap_or_else(|| {
            let column = column.map(str::to_owned);
            self.losses.push(Loss { kind, file: self.file.to_owned(), column, lines: Vec::new(), count: 0 });
            self.losses.len() - 1
        });
        let loss = &mut self.losses[index];
        loss.count += 1;
        if loss.count <= PLACES_NAMED {
            loss.lines.extend(line());
        }
    }

    /// What was lost so far.
    pub(crate) fn losses(&self) -> &[Loss] {
        &self.losses
    }

    /// Everything that was lost.
    pub(crate) fn into_losses(self) -> Vec<Loss> {
        self.losses
    }
}

/// Losses in one line, for an error message.
pub(crate) fn in_words(losses: &[Loss]) -> String {
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
        let mut ledger = Ledger::new("a.csv");
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
