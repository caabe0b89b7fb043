//! A run of any length in pieces of equal time, in one pass.

use std::cell::RefCell;
use std::rc::Rc;

use bags::Loss;

use crate::channel::{Attributes, Channel};
use crate::column::{Keep, SORTED_WITHIN_NS};
use crate::column_samples::ColumnSamples;
use crate::error::RecordingError;
use crate::input::{Opened, ReadOptions};
use crate::mapping::{ColumnMapping, Mapping};
use crate::read::{Gathered, Source, UnusedColumn, gather};
use crate::recording::{Clock, Recording};
use crate::signal::Signal;

/// What was told of a run whose samples were given piece by piece.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Passage {
    /// What stamped the samples. Pieces are cut by stamps, whichever clock they are of: with more than one clock here,
    /// channels of a piece need not belong together.
    pub clocks: Vec<Clock>,
    /// What could not be read.
    pub losses: Vec<Loss>,
    /// The files, in the order of the mapping's entries.
    pub sources: Vec<Source>,
    /// Columns and topics that the mapping does not use: no loss, worth telling.
    pub unused: Vec<UnusedColumn>,
}

/// As [`read_from`](crate::read_from), but gives the run to `each` in pieces of `length_ns`, counted from its first stamp,
/// and forgets them: CSV and MCAP of any length need little memory. Pieces without a sample are left out. All channels of
/// a piece are on one clock, which has the run's name.
///
/// # Errors
/// As [`read_from`](crate::read_from), and what `each` returns.
pub fn pieces_from(
    mapping: &Mapping,
    run: &str,
    inputs: &mut [Opened<'_>],
    options: &ReadOptions,
    length_ns: i64,
    each: &mut dyn FnMut(Recording) -> Result<(), RecordingError>,
) -> Result<Passage, RecordingError> {
    let cutter = Cutter {
        run,
        length_ns: length_ns.max(1),
        columns: Vec::new(),
        start_ns: None,
        due_ns: i64::MAX,
        each,
        stopped: Ok(()),
    };
    let keep = ColumnPieces { cutter: Rc::new(RefCell::new(cutter)), column: 0 };
    let gathered = gather(mapping, run, inputs, options.policy, (&keep, false));
    let mut cutter = keep.cutter.borrow_mut();
    while cutter.stopped.is_ok() && cutter.cut().is_some() {}
    std::mem::replace(&mut cutter.stopped, Ok(()))?;
    let Gathered { clocks, losses, sources, unused, .. } = gathered?;
    Ok(Passage { clocks, losses, sources, unused })
}

/// The samples of a column that wait for their piece.
struct Waiting {
    signal: Signal,
    attributes: Attributes,
    source: String,
    samples: ColumnSamples,
}

/// Cuts all columns at the same instants.
struct Cutter<'e> {
    run: &'e str,
    length_ns: i64,
    columns: Vec<Waiting>,
    /// The first stamp.
    start_ns: Option<i64>,
    /// From which stamp on nothing of the present piece can come any more.
    due_ns: i64,
    each: &'e mut dyn FnMut(Recording) -> Result<(), RecordingError>,
    stopped: Result<(), RecordingError>,
}

impl Cutter<'_> {
    /// Gives the present piece away; where the next one ends, ns, or `None` when nothing waits.
    fn cut(&mut self) -> Option<i64> {
        let first_ns = self.columns.iter().filter_map(|column| column.samples.first_ns()).min();
        let (first_ns, start_ns) = first_ns.zip(self.start_ns)?;
        // Nothing may have been recorded for hours.
        let before = first_ns.saturating_sub(start_ns).div_euclid(self.length_ns);
        let end_ns = start_ns.saturating_add(before.saturating_add(1).saturating_mul(self.length_ns));
        let channels = self.columns.iter_mut().filter_map(|column| {
            let (t_ns, values) = column.samples.take_until(end_ns);
            let channel = (!t_ns.is_empty()).then(|| Channel::new(column.signal, 0, t_ns, values))?;
            Some(channel.map(|c| c.with_attributes(column.attributes).with_column(column.source.clone())))
        });
        let clock = Clock { name: self.run.to_owned(), nominal_rate_hz: None };
        let piece = channels.collect::<Result<Vec<_>, _>>().and_then(|c| Recording::new(self.run, vec![clock], c));
        self.stopped = piece.and_then(&mut *self.each);
        Some(end_ns.saturating_add(self.length_ns))
    }

    fn add(&mut self, column: usize, now_ns: i64, value: f64) -> bool {
        let new = self.columns[column].samples.add(now_ns, value);
        if self.start_ns.is_none() {
            self.start_ns = Some(now_ns);
            self.due_ns = now_ns.saturating_add(self.length_ns).saturating_add(SORTED_WITHIN_NS);
        }
        if now_ns >= self.due_ns
            && self.stopped.is_ok()
            && let Some(end_ns) = self.cut()
        {
            self.due_ns = end_ns.saturating_add(SORTED_WITHIN_NS);
        }
        new
    }
}

/// One column of the run that is cut.
#[derive(Clone)]
struct ColumnPieces<'e> {
    cutter: Rc<RefCell<Cutter<'e>>>,
    column: usize,
}

impl Keep for ColumnPieces<'_> {
    type Kept = ();
    const HOLDS_ALL: bool = false;

    fn of(&self, column: &ColumnMapping) -> Self {
        let mut cutter = self.cutter.borrow_mut();
        cutter.columns.push(Waiting {
            signal: column.signal,
            attributes: column.attributes,
            source: column.column.clone(),
            samples: ColumnSamples::default(),
        });
        Self { cutter: Rc::clone(&self.cutter), column: cutter.columns.len() - 1 }
    }

    fn add(&mut self, now_ns: i64, value: f64) -> bool {
        self.cutter.borrow_mut().add(self.column, now_ns, value)
    }

    fn finish(self) -> Option<()> {
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;
    use std::io::Cursor;

    use super::*;
    use crate::input::Input;
    use crate::read::read;

    /// A quarter of an hour of two columns, one of them with gaps; late rows, and an hour in which nothing is recorded.
    fn table() -> String {
        let mut text = "time_s,gyro_z_rad_s,accel_x_m_s2\n".to_owned();
        for k in 0..9_000_i64 {
            let late = if k % 500 == 250 { -0.3 } else { 0.0 };
            let hour = if k > 6_000 { 3600.0 } else { 0.0 };
            let accel = if k % 3 == 0 { String::new() } else { format!("{}", k % 17) };
            let _ = writeln!(text, "{:.4},{},{accel}", k as f64 * 0.1 + hour + late - 1e-4, k % 13);
        }
        text
    }

    fn pieces(text: &str, length_ns: i64) -> (Vec<Recording>, Passage) {
        let mapping = Mapping::built_in("skid-steer-columns").expect("built in");
        let mut source = Cursor::new(text.as_bytes());
        let mut files = [Opened { name: "run.csv", source: &mut source }];
        let mut out = Vec::new();
        let passage = pieces_from(&mapping, "run", &mut files, &ReadOptions::default(), length_ns, &mut |piece| {
            out.push(piece);
            Ok(())
        });
        (out, passage.expect("reads"))
    }

    #[test]
    fn pieces_joined_are_the_recording() {
        let text = table();
        let mapping = Mapping::built_in("skid-steer-columns").expect("built in");
        let inputs = [Input { name: "run.csv", bytes: text.as_bytes() }];
        let whole = read(&mapping, "run", &inputs, &ReadOptions::default()).expect("reads");
        for seconds in [7, 60, 100_000] {
            let (pieces, passage) = pieces(&text, seconds * 1_000_000_000);
            assert_eq!((&passage.losses, &passage.sources), (&whole.losses, &whole.sources));
            for channel in whole.recording.channels() {
                let joined = |of: fn(&Channel) -> Vec<i64>| {
                    pieces.iter().filter_map(|p| p.get(channel.signal())).flat_map(of).collect::<Vec<_>>()
                };
                assert_eq!(joined(|c| c.t_ns().to_vec()), channel.t_ns());
                let bits = |c: &Channel| c.values().iter().map(|v| v.to_bits().cast_signed()).collect();
                assert_eq!(joined(bits), bits(channel));
            }
            for piece in &pieces {
                let (from, to) = piece.span_ns(0).expect("samples");
                assert!(to - from < seconds * 1_000_000_000);
            }
        }
    }

    #[test]
    fn whoever_takes_the_pieces_may_stop() {
        let mapping = Mapping::built_in("skid-steer-columns").expect("built in");
        let text = table();
        let mut source = Cursor::new(text.as_bytes());
        let mut files = [Opened { name: "run.csv", source: &mut source }];
        let mut count = 0;
        let stopped = pieces_from(&mapping, "run", &mut files, &ReadOptions::default(), 60_000_000_000, &mut |_| {
            count += 1;
            Err(RecordingError::EmptyFile { file: "stop".to_owned() })
        });
        assert!(matches!(stopped, Err(RecordingError::EmptyFile { .. })));
        assert_eq!(count, 1);
    }
}
