//! Long work: without the interpreter's lock, ended by an interrupt between its stages, and never by a panic.

use std::any::Any;
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::{Mutex, MutexGuard, PoisonError};

use pyo3::prelude::*;

use crate::error::{LacunaError, raised};

/// Bytes between two looks for an interrupt while files are read.
const BYTES: u64 = 4 << 20;

/// Where the last panic was, which counts only if nobody catches it: readers catch those of libraries on damaged files.
static LAST_PANIC: Mutex<Option<String>> = Mutex::new(None);

fn last_panic() -> MutexGuard<'static, Option<String>> {
    // A panic while the message is stored leaves it as good as it was.
    LAST_PANIC.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Keeps the panics of this library, and of no other, off standard error.
pub(crate) fn quiet_panics() {
    std::panic::set_hook(Box::new(|info| {
        let what = info.payload_as_str().unwrap_or("no message");
        let place = info.location().map_or(String::new(), |l| format!(" at {}:{}", l.file(), l.line()));
        *last_panic() = Some(format!("{place}: {what}"));
    }));
}

/// Why work ended early: an exception of Python's.
struct Stopped(PyErr);

/// Runs work without the interpreter's lock. Its failures, and defects in it, become exceptions.
pub(crate) fn run<T: Send>(py: Python<'_>, work: impl FnOnce() -> anyhow::Result<T> + Send) -> PyResult<T> {
    // Nothing of what the work held is used after it broke off.
    match py.detach(|| catch_unwind(AssertUnwindSafe(work))) {
        Ok(done) => done.map_err(|e| raised(&e)),
        Err(payload) => Err(broken(payload)),
    }
}

fn broken(payload: Box<dyn Any + Send>) -> PyErr {
    if let Ok(stopped) = payload.downcast::<Stopped>() {
        return stopped.0;
    }
    let what = last_panic().take().unwrap_or_default();
    LacunaError::new_err(format!("defect in lacuna{what}; please report it together with the input"))
}

/// Whether an interrupt has come.
fn interrupted() -> PyResult<()> {
    Python::attach(|py| {
        py.check_signals()?;
        Ok(())
    })
}

/// Ends the work: it knows no way to end early, so it is unwound.
fn end_if(ended: PyResult<()>) {
    if let Err(error) = ended {
        // Not `panic_any`: that would count as a defect.
        resume_unwind(Box::new(Stopped(error)));
    }
}

/// Whom work tells how far it is.
pub(crate) struct Listener {
    /// A callable that takes the stage that begins.
    progress: Option<Py<PyAny>>,
    bytes: Cell<u64>,
}

impl Listener {
    pub(crate) fn new(progress: Option<Py<PyAny>>) -> Self {
        Self { progress, bytes: Cell::new(0) }
    }

    /// A stage begins: the place to end the work, where an interrupt has come or the callable raises.
    pub(crate) fn stage(&self, what: &str) {
        end_if(interrupted().and_then(|()| {
            let call = |progress: &Py<PyAny>| Python::attach(|py| progress.call1(py, (what,)).map(drop));
            self.progress.as_ref().map_or(Ok(()), call)
        }));
    }

    /// So many bytes were read.
    pub(crate) fn read(&self, done: u64) {
        if done / BYTES != self.bytes.replace(done) / BYTES {
            end_if(interrupted());
        }
    }
}
