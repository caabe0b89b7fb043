//! The samples of one column, measured as they arrive: memory does not grow with their number.

use std::cell::Cell;
use std::rc::Rc;
use std::sync::mpsc::{Receiver, Sender, SyncSender, channel, sync_channel};
use std::thread;

use crate::column::{Keep, SORTED_WITHIN_NS, Series};
use crate::column_samples::ColumnSamples;
use crate::fingerprint::{Fingerprint, FingerprintBuilder};
use crate::quality::{Quality, QualityMeter};

/// Samples of a column that are measured together.
const BATCH: usize = 4096;
/// Samples that wait for their order at most. Within the second in which rows may overtake each other there are more
/// only where stamps are damaged; then order is left to the measurement, which counts what is out of it.
const MOST_WAITING: usize = 1 << 20;
/// Batches that wait for their measurement at most, 64 KiB each.
const MOST_BATCHES: usize = 64;

/// What was measured of a column.
pub(crate) type Measured = (Quality, Fingerprint);

/// The measurement of a column.
#[derive(Clone, Default)]
struct Meters {
    quality: QualityMeter,
    fingerprint: FingerprintBuilder,
}

impl Meters {
    fn take(&mut self, (t_ns, values): &Series) {
        for (&t_ns, &value) in t_ns.iter().zip(values) {
            self.quality.push(t_ns, value);
            self.fingerprint.push(t_ns, value);
        }
    }

    fn finish(self) -> Measured {
        (self.quality.finish(), self.fingerprint.finish())
    }
}

/// What is asked of the thread that measures.
enum Job {
    /// Samples of the column of this number.
    Take(usize, Series),
    /// The end of a column, and where to send what was measured.
    Finish(usize, Sender<Measured>),
}

/// Where samples are measured.
#[derive(Clone)]
enum Place {
    /// By a thread of its own.
    There {
        jobs: SyncSender<Job>,
        /// Columns so far, over all clones.
        columns: Rc<Cell<usize>>,
        /// The number of this one, once it has samples.
        number: Option<usize>,
    },
    /// Where no thread could be started.
    Here(Box<Meters>),
}

/// Brings the samples of a column into order and has them measured.
#[derive(Clone)]
pub(crate) struct ColumnMeter {
    place: Place,
    waiting: ColumnSamples,
    /// Waiting samples from which on it is worth looking which are in order.
    full: usize,
}

impl ColumnMeter {
    /// Gives a meter to `work`, while a thread measures.
    pub(crate) fn with<T>(work: impl FnOnce(&Self) -> T) -> T {
        thread::scope(|scope| {
            let (jobs, asked) = sync_channel(MOST_BATCHES);
            let measuring = thread::Builder::new().name("measure".to_owned());
            let place = match measuring.spawn_scoped(scope, move || measure(&asked)) {
                Ok(_) => Place::There { jobs, columns: Rc::new(Cell::new(0)), number: None },
                Err(_) => Place::Here(Box::default()),
            };
            work(&Self { place, waiting: ColumnSamples::default(), full: BATCH })
        })
    }
}

impl Keep for ColumnMeter {
    type Kept = Measured;
    const HOLDS_ALL: bool = false;

    fn add(&mut self, now_ns: i64, value: f64) -> bool {
        let new = self.waiting.add(now_ns, value);
        if self.waiting.len() >= self.full {
            let sorted = self.waiting.take_before(SORTED_WITHIN_NS, MOST_WAITING / 2);
            if !sorted.0.is_empty() {
                self.place.take(sorted);
            }
            self.full = BATCH.max(2 * self.waiting.len());
        }
        new
    }

    fn finish(mut self) -> Option<Measured> {
        if let Some(rest) = std::mem::take(&mut self.waiting).finish() {
            self.place.take(rest);
        }
        self.place.finish()
    }
}

impl Place {
    fn take(&mut self, series: Series) {
        match self {
            Self::Here(meters) => meters.take(&series),
            Self::There { jobs, columns, number } => {
                let number = *number.get_or_insert_with(|| {
                    let number = columns.get();
                    columns.set(number + 1);
                    number
                });
                // The other end waits as long as there is a meter.
                let _ = jobs.send(Job::Take(number, series));
            }
        }
    }

    /// `None` without a sample.
    fn finish(self) -> Option<Measured> {
        match self {
            Self::Here(meters) => Some(meters.finish()).filter(|(quality, _)| quality.timing.samples > 0),
            Self::There { jobs, number, .. } => {
                let (give, given) = channel();
                jobs.send(Job::Finish(number?, give)).ok()?;
                given.recv().ok()
            }
        }
    }
}

/// Measures until nobody can ask any more.
fn measure(asked: &Receiver<Job>) {
    let mut columns: Vec<Meters> = Vec::new();
    while let Ok(job) = asked.recv() {
        let (Job::Take(number, _) | Job::Finish(number, _)) = job;
        if columns.len() <= number {
            columns.resize_with(number + 1, Meters::default);
        }
        match job {
            Job::Take(_, series) => columns[number].take(&series),
            // Who asked and did not wait wants nothing.
            Job::Finish(_, give) => drop(give.send(std::mem::take(&mut columns[number]).finish())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Samples of 1 kHz, one in a hundred overtaken by half a second, one in a thousand twice.
    fn rows() -> Vec<(i64, f64)> {
        let mut rows: Vec<(i64, f64)> = (0..50_000).map(|i| (i * 1_000_000, (i % 977) as f64)).collect();
        for i in (100..49_000).step_by(100) {
            let late = rows.remove(i);
            rows.insert(i + 500, late);
        }
        for i in (1000..49_000).step_by(1000) {
            rows.insert(i + 3, rows[i]);
        }
        rows
    }

    #[test]
    fn what_is_measured_on_the_way_is_what_is_measured_of_all() {
        let mut gathered = ColumnSamples::default();
        let new: Vec<bool> = rows().iter().map(|&(t_ns, value)| gathered.add(t_ns, value)).collect();
        let (t_ns, values) = gathered.finish().unwrap();
        let whole = (Quality::measure(&t_ns, &values), Fingerprint::of_samples(&t_ns, &values));
        for here in [false, true] {
            let measured = ColumnMeter::with(|meter| {
                let mut meter = meter.clone();
                if here {
                    meter.place = Place::Here(Box::default());
                }
                let also: Vec<bool> = rows().iter().map(|&(t_ns, value)| meter.add(t_ns, value)).collect();
                assert_eq!(also, new);
                assert!(meter.waiting.len() <= BATCH);
                meter.finish()
            });
            assert_eq!(measured, Some(whole.clone()));
        }
        assert_eq!(whole.0.timing.samples, 50_000);
        assert_eq!(ColumnMeter::with(|meter| meter.clone().finish()), None);
    }

    #[test]
    fn stamps_that_all_lie_within_a_second_do_not_gather() {
        ColumnMeter::with(|meter| {
            let mut meter = meter.clone();
            let count = 3 * i64::try_from(MOST_WAITING).unwrap();
            for i in 0..count {
                // Every other one comes late.
                meter.add(if i % 2 == 0 { i } else { i - 2 }, 0.0);
                assert!(meter.waiting.len() <= MOST_WAITING);
            }
            assert_eq!(meter.finish().unwrap().0.timing.span_ns, Some((-1, count - 2)));
        });
    }
}
