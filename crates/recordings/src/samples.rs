//! Rows become samples: the one way in which CSV lines, messages of a topic and rows of Parquet do.

use bags::{HEADER_STAMP, Ledger, Loss, LossKind, Place, in_words};

use crate::cell::CellError;
use crate::column::{Column, Keep, SORTED_WITHIN_NS};
use crate::error::RecordingError;
use crate::input::Policy;
use crate::mapping::{ColumnMapping, TimeMapping};
use crate::row::Row;

/// A mapped column and where it is in a row.
#[derive(Clone, Copy)]
pub(crate) struct PlacedColumn<'a> {
    pub(crate) position: usize,
    pub(crate) mapped: &'a ColumnMapping,
}

/// What a table is read by, and the samples read so far.
pub(crate) struct Samples<'a, K> {
    file: &'a str,
    place: Place,
    policy: Policy,
    time: &'a TimeMapping,
    /// Position of the time; without one, rows are counted.
    time_at: Option<usize>,
    /// What stands before a column's name in messages: the topic.
    prefix: String,
    /// A stamp of 0 is one that was never set.
    zero_is_unset: bool,
    columns: Vec<PlacedColumn<'a>>,
    kept: Vec<K>,
    /// The latest stamp of all rows so far.
    latest_ns: Option<i64>,
    ledger: Ledger<'a>,
}

impl<'a, K: Keep> Samples<'a, K> {
    /// No samples yet of these columns, whose samples go to clones of `keep`.
    pub(crate) fn new(
        keep: &K,
        file: &'a str,
        place: Place,
        policy: Policy,
        time: (&'a TimeMapping, Option<usize>),
        columns: Vec<PlacedColumn<'a>>,
    ) -> Self {
        let kept = columns.iter().map(|found| keep.of(found.mapped)).collect();
        let ledger = Ledger::new(file, place);
        let (time, time_at) = time;
        let (prefix, zero_is_unset) = (String::new(), false);
        Self { file, place, policy, time, time_at, prefix, zero_is_unset, columns, kept, latest_ns: None, ledger }
    }

    /// The same, of a topic.
    pub(crate) fn of_topic(mut self, topic: &str) -> Self {
        self.prefix = format!("{topic}.");
        let is_header = |column: &str| column == HEADER_STAMP || column.ends_with(".header.stamp");
        self.zero_is_unset = self.time.column.as_deref().is_some_and(is_header);
        self
    }

    /// Adds a row's samples, or counts why not; `number` is the row's from 0, lost ones counted.
    pub(crate) fn take(&mut self, row: &impl Row, number: u64) -> Result<(), RecordingError> {
        let Some(now_ns) = self.instant(row, number)? else {
            return Ok(());
        };
        if let Some(before_ns) = self.latest_ns.filter(|&before_ns| now_ns < before_ns) {
            let overtaken = before_ns.saturating_sub(now_ns) <= SORTED_WITHIN_NS;
            let (kind, go_on) = if overtaken {
                (LossKind::OutOfOrder, self.unless_strict())
            } else {
                (LossKind::TimeBackwards, self.if_tolerant())
            };
            self.lose(row, kind, None, go_on, |of, line| {
                let (file, place, column) = (of.file.to_owned(), of.place, of.time_column());
                let (before_s, now_s) = (seconds(before_ns), seconds(now_ns));
                RecordingError::TimeBackwards { file, place, line, column, before_s, now_s }
            })?;
            if !overtaken {
                return Ok(());
            }
        }
        self.latest_ns = self.latest_ns.max(Some(now_ns));
        let mut repeated = false;
        for index in 0..self.columns.len() {
            let Some(value) = self.value(row, self.columns[index])? else {
                continue;
            };
            repeated |= !self.kept[index].add(now_ns, value);
        }
        if !repeated {
            return Ok(());
        }
        self.lose(row, LossKind::DuplicateStamp, None, self.unless_strict(), |of, line| {
            let (file, place, column) = (of.file.to_owned(), of.place, of.time_column());
            RecordingError::DuplicateStamp { file, place, line, column, now_s: seconds(now_ns) }
        })
    }

    /// Counts a row that is no row, and goes on unless reading is strict.
    pub(crate) fn lose_row(
        &mut self,
        kind: LossKind,
        line: impl Fn() -> u64,
        error: impl FnOnce() -> RecordingError,
    ) -> Result<(), RecordingError> {
        if !self.unless_strict() {
            return Err(error());
        }
        self.ledger.add(kind, None, || Some(line()));
        Ok(())
    }

    /// The columns that hold samples, on clock `clock`. The losses go to `losses`.
    pub(crate) fn finish(
        mut self,
        clock: usize,
        losses: &mut Vec<Loss>,
    ) -> Result<Vec<Column<K::Kept>>, RecordingError> {
        let (mut columns, mut empty) = (Vec::new(), Vec::new());
        for (found, samples) in self.columns.iter().zip(std::mem::take(&mut self.kept)) {
            let mapped = found.mapped;
            let Some(kept) = samples.finish() else {
                empty.push(mapped);
                continue;
            };
            let source = format!("{}{}", self.prefix, mapped.column);
            columns.push(Column { signal: mapped.signal, source, clock, attributes: mapped.attributes, kept });
        }
        if columns.is_empty() {
            let losses = self.ledger.losses();
            if !losses.is_empty() && losses.iter().all(|loss| loss.kind == LossKind::UnsetStamp) {
                return Err(self.unset_stamp("every message".to_owned()));
            }
            let losses = in_words(losses);
            return Err(RecordingError::NoSamples { file: self.file.to_owned(), losses });
        }
        for mapped in empty.iter().filter(|mapped| !mapped.optional) {
            self.ledger.add(LossKind::EmptyColumn, Some(&format!("{}{}", self.prefix, mapped.column)), || None);
        }
        losses.extend(self.ledger.into_losses());
        Ok(columns)
    }

    /// When the row was taken; `None` when that is lost.
    fn instant(&mut self, row: &impl Row, number: u64) -> Result<Option<i64>, RecordingError> {
        let TimeMapping { ns_per_unit, rate_hz, .. } = *self.time;
        let Some(position) = self.time_at else {
            let period_ns = 1e9 / rate_hz.unwrap_or(1.0);
            return Ok(crate::cell::rounded_ns(number as f64 * period_ns));
        };
        let lost = match row.instant_ns(position, ns_per_unit) {
            Ok(Some(0)) if self.zero_is_unset => {
                self.lose(row, LossKind::UnsetStamp, None, self.unless_strict(), |of, line| {
                    of.unset_stamp(format!("message {line}"))
                })
            }
            Ok(Some(now_ns)) => return Ok(Some(now_ns)),
            Ok(None) => self.lose(row, LossKind::NoTime, None, self.unless_strict(), |of, line| {
                let (file, place, column) = (of.file.to_owned(), of.place, of.time_column());
                RecordingError::NoTime { file, place, line, column }
            }),
            Err(problem) => self.lose(row, LossKind::BadTime, None, self.if_tolerant(), |of, line| {
                of.cell_error(problem, line, of.time_column(), row.text(position))
            }),
        };
        lost.map(|()| None)
    }

    /// The sample of a mapped column in SI; `None` for a gap.
    fn value(&mut self, row: &impl Row, found: PlacedColumn<'a>) -> Result<Option<f64>, RecordingError> {
        let PlacedColumn { position, mapped } = found;
        let column = || format!("{}{}", self.prefix, mapped.column);
        let problem = match row.number(position) {
            Ok(None) => return Ok(None),
            Ok(Some(value)) if value < 0.0 && mapped.attributes.magnitude_only => {
                let (column, tolerant) = (column(), self.if_tolerant());
                let lost = self.lose(row, LossKind::NegativeMagnitude, Some(&column), tolerant, |of, line| {
                    let (file, place, column) = (of.file.to_owned(), of.place, column.clone());
                    RecordingError::NegativeMagnitude { file, place, line, column, text: row.text(position) }
                });
                return lost.map(|()| None);
            }
            Ok(Some(value)) => {
                let in_si = value * mapped.factor;
                if in_si.is_finite() {
                    return Ok(Some(in_si));
                }
                CellError::NotFinite
            }
            Err(problem) => problem,
        };
        let (column, tolerant) = (column(), self.if_tolerant());
        let lost = self.lose(row, LossKind::BadCell, Some(&column), tolerant, |of, line| {
            of.cell_error(problem, line, column.clone(), row.text(position))
        });
        lost.map(|()| None)
    }

    /// Counts a loss where the policy lets the reading go on, and ends it otherwise.
    fn lose(
        &mut self,
        row: &impl Row,
        kind: LossKind,
        column: Option<&str>,
        go_on: bool,
        error: impl FnOnce(&Self, u64) -> RecordingError,
    ) -> Result<(), RecordingError> {
        if !go_on {
            return Err(error(self, row.place()));
        }
        self.ledger.add(kind, column, || Some(row.place()));
        Ok(())
    }

    fn unless_strict(&self) -> bool {
        self.policy != Policy::Strict
    }

    fn if_tolerant(&self) -> bool {
        self.policy == Policy::Tolerant
    }

    fn cell_error(&self, problem: CellError, line: u64, column: String, text: String) -> RecordingError {
        let (file, place) = (self.file.to_owned(), self.place);
        match problem {
            CellError::NotANumber => RecordingError::NotANumber { file, place, line, column, text },
            CellError::NotFinite => RecordingError::NotFinite { file, place, line, column, text },
        }
    }

    /// The error about stamps that are 0 in `messages`.
    fn unset_stamp(&self, messages: String) -> RecordingError {
        let topic = self.prefix.strip_suffix('.').unwrap_or_default().to_owned();
        RecordingError::UnsetStamp { file: self.file.to_owned(), topic, messages }
    }

    fn time_column(&self) -> String {
        let column = self.time.column.as_deref();
        column.map_or_else(|| "(row number)".to_owned(), |column| format!("{}{column}", self.prefix))
    }
}

fn seconds(ns: i64) -> f64 {
    ns as f64 / 1e9
}
