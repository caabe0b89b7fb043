//! One row below the header: its instant and its samples, or why not.

use csv::ByteRecord;

use crate::cell::{self, CellError};
use crate::error::RecordingError;
use crate::header::Header;
use crate::loss::{Ledger, LossKind};
use crate::mapping::{FileMapping, TimeMapping};
use crate::read::{Input, Policy};

/// The samples of one mapped column while they are gathered.
#[derive(Default)]
pub(crate) struct Gathered {
    pub(crate) t_ns: Vec<i64>,
    pub(crate) values: Vec<f64>,
}

/// One row with all that is needed to judge it.
pub(crate) struct Row<'r, 'l> {
    pub(crate) input: &'r Input<'r>,
    pub(crate) header: &'r Header<'r>,
    pub(crate) file: &'r FileMapping,
    pub(crate) policy: Policy,
    pub(crate) record: &'r ByteRecord,
    /// Number of the row from 0, lost ones counted.
    pub(crate) number: u64,
    /// Byte in the body at which the row starts.
    pub(crate) offset: u64,
    pub(crate) ledger: &'r mut Ledger<'l>,
}

impl Row<'_, '_> {
    /// Adds the row's samples, or counts why not.
    pub(crate) fn take(&mut self, last_ns: &mut Option<i64>, gathered: &mut [Gathered]) -> Result<(), RecordingError> {
        if self.record.len() != self.header.width {
            return self.lose(LossKind::FieldCount, None, self.unless_strict(), |row| {
                RecordingError::WrongFieldCount {
                    file: row.file_name(),
                    line: row.line(),
                    found: row.record.len(),
                    expected: row.header.width,
                }
            });
        }
        let Some(now_ns) = self.instant()? else {
            return Ok(());
        };
        if let Some(before_ns) = last_ns.filter(|&before_ns| now_ns < before_ns) {
            return self.lose(LossKind::TimeBackwards, None, self.if_tolerant(), |row| RecordingError::TimeBackwards {
                file: row.file_name(),
                line: row.line(),
                column: row.time_column(),
                before_s: seconds(before_ns),
                now_s: seconds(now_ns),
            });
        }
        *last_ns = Some(now_ns);
        let mut repeated = false;
        for (index, into) in gathered.iter_mut().enumerate() {
            let Some(value) = self.value(index)? else {
                continue;
            };
            if into.t_ns.last() == Some(&now_ns) {
                repeated = true;
            } else {
                into.t_ns.push(now_ns);
                into.values.push(value);
            }
        }
        if !repeated {
            return Ok(());
        }
        self.lose(LossKind::DuplicateStamp, None, self.unless_strict(), |row| RecordingError::DuplicateStamp {
            file: row.file_name(),
            line: row.line(),
            column: row.time_column(),
            now_s: seconds(now_ns),
        })
    }

    /// When the row was taken; `None` when that is lost.
    fn instant(&mut self) -> Result<Option<i64>, RecordingError> {
        let TimeMapping { ns_per_unit, rate_hz, .. } = self.file.time;
        let Some(position) = self.header.time else {
            let period_ns = 1e9 / rate_hz.unwrap_or(1.0);
            return Ok(cell::rounded_ns(self.number as f64 * period_ns));
        };
        let lost = match cell::instant_ns(&self.record[position], ns_per_unit) {
            Ok(Some(now_ns)) => return Ok(Some(now_ns)),
            Ok(None) => self.lose(LossKind::NoTime, None, self.unless_strict(), |row| RecordingError::NoTime {
                file: row.file_name(),
                line: row.line(),
                column: row.time_column(),
            }),
            Err(problem) => self.lose(LossKind::BadTime, None, self.if_tolerant(), |row| {
                row.cell_error(problem, position, row.time_column())
            }),
        };
        lost.map(|()| None)
    }

    /// The sample of a mapped column in SI; `None` for a gap.
    fn value(&mut self, index: usize) -> Result<Option<f64>, RecordingError> {
        let header = self.header;
        let (position, mapped) = (header.columns[index].position, header.columns[index].mapped);
        let problem = match cell::number(&self.record[position]) {
            Ok(None) => return Ok(None),
            Ok(Some(value)) if value < 0.0 && mapped.attributes.magnitude_only => {
                let column = Some(mapped.column.as_str());
                let lost = self.lose(LossKind::NegativeMagnitude, column, self.if_tolerant(), |row| {
                    RecordingError::NegativeMagnitude {
                        file: row.file_name(),
                        line: row.line(),
                        column: mapped.column.clone(),
                        text: row.text(position),
                    }
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
        let lost = self.lose(LossKind::BadCell, Some(&mapped.column), self.if_tolerant(), |row| {
            row.cell_error(problem, position, mapped.column.clone())
        });
        lost.map(|()| None)
    }

    /// Counts a loss where the policy lets the reading go on, and ends it otherwise.
    fn lose(
        &mut self,
        kind: LossKind,
        column: Option<&str>,
        go_on: bool,
        error: impl FnOnce(&Self) -> RecordingError,
    ) -> Result<(), RecordingError> {
        if !go_on {
            return Err(error(self));
        }
        let (header, offset) = (self.header, self.offset);
        self.ledger.add(kind, column, || Some(header.line_at(offset)));
        Ok(())
    }

    fn unless_strict(&self) -> bool {
        self.policy != Policy::Strict
    }

    fn if_tolerant(&self) -> bool {
        self.policy == Policy::Tolerant
    }

    fn cell_error(&self, problem: CellError, position: usize, column: String) -> RecordingError {
        let (file, line, text) = (self.file_name(), self.line(), self.text(position));
        match problem {
            CellError::NotANumber => RecordingError::NotANumber { file, line, column, text },
            CellError::NotFinite => RecordingError::NotFinite { file, line, column, text },
        }
    }

    fn file_name(&self) -> String {
        self.input.name.to_owned()
    }

    fn line(&self) -> u64 {
        self.header.line_at(self.offset)
    }

    fn time_column(&self) -> String {
        self.file.time.column.clone().unwrap_or_else(|| "(row number)".to_owned())
    }

    /// A cell as a message shows it: its first characters, none that a terminal would obey.
    fn text(&self, position: usize) -> String {
        /// Characters shown of a cell.
        const SHOWN: usize = 40;
        let text = String::from_utf8_lossy(cell::bare(&self.record[position])).into_owned();
        let mut shown: String = text.chars().take(SHOWN).flat_map(char::escape_debug).collect();
        if text.chars().count() > SHOWN {
            shown.push('…');
        }
        shown
    }
}

fn seconds(ns: i64) -> f64 {
    ns as f64 / 1e9
}
