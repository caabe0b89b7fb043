//! All units, on all cores, in memory that does not grow with their number.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use anyhow::{Context, Result};

use super::Settings;
use super::one::{diagnose, prepare};
use super::queue::{Job, Queue};
use super::row::{Outcome, Row};
use super::store::{Index, Store};
use super::unit::Unit;

/// What happens while a batch runs.
#[derive(Debug)]
pub enum Event<'a> {
    /// A robot was prepared in this time; its name as it was given.
    Prepared(&'a str, Duration),
    /// A unit is finished, after this time.
    Finished(&'a Row, Duration),
}

/// What became of the units.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct Ran {
    /// Units with an answer.
    pub done: usize,
    /// Units without.
    pub failed: usize,
    /// Units of which some input was lost.
    pub lost: usize,
}

/// Diagnoses units and keeps every answer as soon as it is there; `listener` hears of each from the thread that worked on it.
///
/// Every thread works on a unit of its own, by itself: nobody waits for others inside a diagnosis, and no more units are
/// held than there are threads. Where there are fewer units than threads, each gets several.
///
/// # Errors
/// When an answer cannot be kept. A unit that fails is no error but a row.
pub fn run(
    units: Vec<Unit>,
    store: &Store,
    settings: &Settings,
    listener: &(dyn Fn(&Event<'_>) + Sync),
) -> Result<Ran> {
    let threads = settings.threads.max(1);
    let workers = threads.min(units.len()).max(1);
    let index = store.index()?;
    let queue = Queue::new(units);
    let counts: [AtomicUsize; 3] = Default::default();
    let failure: Mutex<Option<anyhow::Error>> = Mutex::new(None);
    let work = || {
        let done = (|| -> Result<()> {
            let pool = rayon::ThreadPoolBuilder::new().num_threads((threads / workers).max(1)).build();
            let pool = pool.context("cannot start threads")?;
            pool.install(|| {
                while let Some(job) = queue.next() {
                    one(job, &queue, &index, store, settings, &counts, listener)?;
                }
                Ok(())
            })
        })();
        if let Err(error) = done {
            queue.stop();
            failure.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(work);
        }
    });
    if let Some(error) = failure.into_inner().unwrap_or_else(PoisonError::into_inner) {
        return Err(error);
    }
    let [done, failed, lost] = counts.map(AtomicUsize::into_inner);
    Ok(Ran { done, failed, lost })
}

/// One job of a thread.
fn one(
    job: Job,
    queue: &Queue,
    index: &Index,
    store: &Store,
    settings: &Settings,
    [done, failed, lost]: &[AtomicUsize; 3],
    listener: &(dyn Fn(&Event<'_>) + Sync),
) -> Result<()> {
    let start = Instant::now();
    match job {
        Job::Prepare(number, setup) => {
            queue.prepared(number, &prepare(&setup, settings));
            listener(&Event::Prepared(&setup.robot, start.elapsed()));
        }
        Job::Diagnose(unit, ready) => {
            let (mut row, envelope) = diagnose(&unit, &ready, settings);
            store.keep(&mut row, envelope.as_ref())?;
            store.forget(index.of(&row.id), &Store::name(&row.id, &row.key))?;
            let count = if row.outcome == Outcome::Done { done } else { failed };
            count.fetch_add(1, Ordering::Relaxed);
            lost.fetch_add(usize::from(!row.lost.is_empty()), Ordering::Relaxed);
            listener(&Event::Finished(&row, start.elapsed()));
        }
    }
    Ok(())
}
